// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "evaluation/consistency.hpp"
#include "evaluation/proportion.hpp"

namespace credo::evaluation {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct ClusteredRow {
  const CampaignRow* row;
  std::size_t cluster;
};

/// The rows of some runs, with the cluster that each is drawn with.
struct Group {
  std::span<const CampaignRun* const> runs;
  std::size_t clusters = 0;
  std::vector<ClusteredRow> rows;
  std::vector<ClusteredRow> absolute;  ///< of them, those with a pose in the map
};

Group group_of(std::span<const CampaignRun* const> runs) {
  Group group;
  group.runs = runs;
  std::map<std::pair<std::string, std::uint64_t>, std::size_t> clusters;
  for (const CampaignRun* run : runs) {
    const std::size_t cluster = clusters.try_emplace({run->key.world, run->key.seed}, clusters.size()).first->second;
    for (const CampaignRow& row : run->rows) {
      group.rows.push_back({&row, cluster});
      if (row.sample.placed()) group.absolute.push_back({&row, cluster});
    }
  }
  group.clusters = clusters.size();
  return group;
}

/// Collects measures of a group.
class Measures {
 public:
  Measures(const Group& group, const SummaryParams& params) : group_(&group), params_(&params) {}

  /// Sum of one quantity over the sum of another.
  template <typename Numerator, typename Denominator>
  void ratio(Measure measure, const std::vector<ClusteredRow>& rows, const Numerator& numerator,
             const Denominator& denominator) {
    ClusteredRatio ratio(group_->clusters);
    for (const ClusteredRow& r : rows) ratio.add(r.cluster, numerator(*r.row), denominator(*r.row));
    measure.estimate = bootstrap(group_->clusters, ratio, params_->bootstrap);
    double cases = 0.0;
    for (const double n : ratio.denominators) cases += n;
    measure.cases = static_cast<long>(cases);
    list.push_back(std::move(measure));
  }
  template <typename Value>
  void mean(Measure measure, const std::vector<ClusteredRow>& rows, const Value& value) {
    ratio(std::move(measure), rows, value, [](const CampaignRow&) { return 1.0; });
  }
  using Test = bool (*)(const Sample&, const ScoreParams&);
  void share(Measure measure, const std::vector<ClusteredRow>& rows, Test test) {
    mean(std::move(measure), rows,
         [&](const CampaignRow& row) { return test(row.sample, params_->words) ? 1.0 : 0.0; });
  }
  template <typename Statistic>
  void statistic(Measure measure, const std::vector<ClusteredRow>& rows, const Statistic& statistic) {
    measure.estimate = bootstrap(group_->clusters, statistic, params_->bootstrap);
    measure.cases = static_cast<long>(rows.size());
    list.push_back(std::move(measure));
  }
  void proportion_of(Measure measure, const Proportion& proportion) {
    if (const auto share = proportion.share()) {
      const Bounds bounds = proportion.interval();
      measure.estimate = Estimate{*share, bounds.lower, bounds.upper};
    }
    measure.cases = static_cast<long>(proportion.of);
    list.push_back(std::move(measure));
  }

  std::vector<Measure> list;

 private:
  const Group* group_;
  const SummaryParams* params_;
};

template <typename Value, typename Good>
ClusteredValues values_of(const std::vector<ClusteredRow>& rows, const Value& value, const Good& good) {
  std::vector<ClusteredValue> values;
  values.reserve(rows.size());
  for (const ClusteredRow& r : rows) values.push_back({value(*r.row), r.cluster, good(*r.row)});
  return ClusteredValues(std::move(values));
}

void add_errors(const Group& group, Measures& measures) {
  const auto position = [](const CampaignRow& row) { return row.sample.position_m(); };
  const auto heading = [](const CampaignRow& row) { return geometry::to_degrees(row.sample.heading_rad()); };
  const auto no_matter = [](const CampaignRow&) { return true; };
  const auto& rows = group.absolute;
  measures.mean({"mean_position", "m", "error of the position"}, rows, position);
  const ClusteredValues positions = values_of(rows, position, no_matter);
  measures.statistic({"p95_position", "m", "95 % of the position errors are at most this"}, rows,
                     [&](Weights weights) { return positions.quantile(0.95, weights); });
  measures.mean({"mean_heading", "deg", "error of the heading"}, rows, heading);
  const ClusteredValues headings = values_of(rows, heading, no_matter);
  measures.statistic({"p95_heading", "deg", "95 % of the heading errors are at most this"}, rows,
                     [&](Weights weights) { return headings.quantile(0.95, weights); });
}

void add_integrity(const Group& group, const SummaryParams& params, Measures& measures) {
  const ScoreParams& w = params.words;
  const std::string lost = fmt::format("error > {:g} m or > {:g} deg", w.lost_above_m, w.lost_above_deg);
  const std::string wrong = fmt::format("error > {:g} m or > {:g} deg", w.wrong_above_m, w.wrong_above_deg);
  measures.share({"lost", "", lost}, group.absolute, is_lost);
  measures.share({"available", "",
                  fmt::format("localized and upper protection level at most {:g} m and {:g} deg", w.available_level_m,
                              w.available_level_deg)},
                 group.rows, is_available);
  Proportion misleading;
  for (const ClusteredRow& r : group.rows) misleading.add(is_misleading(r.row->sample, w));
  measures.proportion_of({"misleading", "", "available, yet the error is above the protection level"}, misleading);
  measures.share({"false_alert", "", "other than localized, yet not lost and no sensor degraded"}, group.rows,
                 is_false_alert);
  measures.share(
      {"confidently_wrong", "", fmt::format("localized, belief_yes > {:g}, yet {}", w.confident_belief, wrong)},
      group.rows, [](const Sample& sample, const ScoreParams& words) {
        return is_confident(sample, words) && is_wrong(sample, words);
      });
  measures.share({"confidently_right", "", "the same words, and error within both"}, group.rows,
                 [](const Sample& sample, const ScoreParams& words) {
                   return is_confident(sample, words) && !is_wrong(sample, words);
                 });
  measures.ratio(
      {"wrong_matches", "", "of the matches that poses rest on"}, group.rows,
      [](const CampaignRow& row) { return static_cast<double>(row.matches.total().wrong); },
      [](const CampaignRow& row) { return static_cast<double>(row.matches.total().matches); });
  Proportion together;
  for (const ClusteredRow& r : group.rows)
    if (!is_alert(r.row->sample) && r.row->matches.total().matches > 0)
      together.add(r.row->matches.points().wrong >= localization::kPointsTogether);
  measures.proportion_of(
      {"points_together", "", fmt::format("of the localized: {} wrong points and more", localization::kPointsTogether)},
      together);
  const ClusteredValues beliefs = values_of(
      group.absolute, [](const CampaignRow& row) { return row.sample.localization.belief.pignistic(); },
      [&](const CampaignRow& row) { return !is_lost(row.sample, w); });
  measures.statistic({"auroc", "", "BetP(YES) against lost; over at least 200 lost acquisitions"}, group.absolute,
                     [&](Weights weights) { return beliefs.auroc(weights); });
  measures.statistic({"calibration_error", "", "ECE of BetP(YES), 10 bins of equal count"}, group.absolute,
                     [&](Weights weights) { return beliefs.calibration_error(weights); });
}

/// Whether one of the rows [at, at + within) of a run passes; nothing where none does and the run ends before.
template <typename Passes>
std::optional<bool> passes_within(const CampaignRun& run, std::size_t at, int within, const Passes& passes) {
  const std::size_t end = at + static_cast<std::size_t>(within);
  for (std::size_t i = at; i < std::min(end, run.rows.size()); ++i)
    if (passes(run.rows[i])) return true;
  return end <= run.rows.size() ? std::optional(false) : std::nullopt;
}

/// The robot is not where it was told, or thinks, that it is: kidnapped, or told a wrong start; at decidable places.
void add_displacements(const Group& group, const SummaryParams& params, Measures& measures) {
  Proportion alerted, recovered;
  const auto is_right = [&](const CampaignRow& row) {
    return !is_alert(row.sample) && !is_lost(row.sample, params.words);
  };
  for (const CampaignRun* run : group.runs) {
    for (std::size_t k = 0; k < run->rows.size(); ++k) {
      const CampaignRow& row = run->rows[k];
      if (!(row.has_event(kKidnapped) || row.has_event(kToldWrong)) || !row.decidable.value_or(true)) continue;
      const auto noticed = passes_within(*run, k, params.alert_within,
                                         [&](const CampaignRow& r) { return is_alert(r.sample) || is_right(r); });
      const auto found = passes_within(*run, k, params.recovered_within, is_right);
      if (noticed) alerted.add(*noticed);
      if (found) recovered.add(*found);
    }
  }
  measures.proportion_of({"displaced_alert", "",
                          fmt::format("of those set down or told to be elsewhere, at decidable places: an alert, or "
                                      "the right pose, within {} acquisitions",
                                      params.alert_within)},
                         alerted);
  measures.proportion_of(
      {"displaced_recovered", "",
       fmt::format("of the same: localized and not lost within {} acquisitions", params.recovered_within)},
      recovered);
}

/// Starts of which the robot is told nothing.
void add_starts(const Group& group, const SummaryParams& params, Measures& measures) {
  Proportion never_wrong, resolved, undecidable;
  for (const CampaignRun* run : group.runs) {
    const CampaignRow& start = run->rows.front();
    if (!start.has_event(kToldNothing)) continue;
    const bool wrong = std::any_of(run->rows.begin(), run->rows.end(), [&](const CampaignRow& row) {
      return !is_alert(row.sample) && is_lost(row.sample, params.words);
    });
    if (!start.decidable.value_or(true)) {
      undecidable.add(!wrong);
      continue;
    }
    never_wrong.add(!wrong);
    resolved.add(std::any_of(run->rows.begin(), run->rows.end(), [&](const CampaignRow& row) {
      return !is_alert(row.sample) && !is_lost(row.sample, params.words) && row.travelled_m <= params.resolved_within_m;
    }));
  }
  measures.proportion_of({"start_never_wrong", "", "of decidable starts that are not told: never localized and lost"},
                         never_wrong);
  measures.proportion_of(
      {"start_resolved", "",
       fmt::format("of the same: localized and not lost within {:g} m of travel", params.resolved_within_m)},
      resolved);
  measures.proportion_of({"start_undecidable_never_wrong", "", "of the others: never localized and lost"}, undecidable);
}

double nees_of(const CampaignRow& row) { return nees(row.sample.localization.estimate, row.sample.truth); }

/// ANEES by index over the runs of one world in one degradation that have a pose in the map throughout.
void add_consistency(const Group& group, Measures& measures) {
  measures.mean({"nees", "", "of x, y and heading; 3 expected, 2 to 4 asked for"}, group.absolute, nees_of);
  std::map<std::pair<std::string, std::string>, std::vector<std::vector<double>>> by_world;
  for (const CampaignRun* run : group.runs) {
    std::vector<double> values;
    for (const CampaignRow& row : run->rows)
      if (row.sample.placed()) values.push_back(nees_of(row));
    if (values.size() == run->rows.size()) by_world[{run->key.world, run->key.degradation}].push_back(values);
  }
  double inside = 0.0;
  long indices = 0;
  for (const auto& [world, runs] : by_world) {
    if (runs.size() < 2) continue;
    const Consistency c = consistency(runs);
    inside += c.share_inside * static_cast<double>(c.anees.size());
    indices += static_cast<long>(c.anees.size());
  }
  Measure measure{"anees_inside", "", "of the indices of acquisitions: mean NEES over the runs inside its 95 % bounds"};
  if (indices > 0) measure.estimate = Estimate{inside / static_cast<double>(indices), kNone, kNone};
  measure.cases = indices;
  measures.list.push_back(std::move(measure));
}

}  // namespace

bool is_wrong(const Sample& sample, const ScoreParams& words) {
  return is_beyond(sample, words.wrong_above_m, words.wrong_above_deg);
}

bool is_confident(const Sample& sample, const ScoreParams& words) {
  return !is_alert(sample) && sample.localization.belief.yes > words.confident_belief;
}

std::vector<Measure> measures_of(std::span<const CampaignRun* const> runs, const SummaryParams& params) {
  const Group group = group_of(runs);
  Measures measures(group, params);
  add_errors(group, measures);
  add_integrity(group, params, measures);
  add_displacements(group, params, measures);
  add_starts(group, params, measures);
  add_consistency(group, measures);
  return std::move(measures.list);
}

}  // namespace credo::evaluation
