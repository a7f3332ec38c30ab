// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/localization_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "evaluation/consistency.hpp"
#include "evaluation/pose_error.hpp"

namespace credo::evaluation {
namespace {

using localization::Status;
using results::LocalizationRow;

/// One acquisition with its truth.
struct Sample {
  const LocalizationRow* row = nullptr;
  geometry::Pose2 truth;
  double position_m = 0.0;
  double heading_rad = 0.0;

  [[nodiscard]] bool beyond(double limit_m, double limit_deg) const {
    return position_m > limit_m || heading_rad > geometry::to_radians(limit_deg);
  }
};

std::vector<Sample> with_truth(std::span<const LocalizationRow> rows, std::span<const datasets::TimedPose> truth,
                               const ScoreParams& params) {
  std::vector<Sample> samples;
  for (const LocalizationRow& row : rows) {
    const auto pose = truth_at(truth, row.localization.time, params);
    if (!pose) continue;
    const geometry::Pose2& estimate = row.localization.estimate.pose;
    samples.push_back({.row = &row,
                       .truth = *pose,
                       .position_m = (estimate.translation() - pose->translation()).norm(),
                       .heading_rad = std::abs(geometry::angle_difference(estimate.theta, pose->theta))});
  }
  return samples;
}

template <typename Condition>
double share(const std::vector<Sample>& samples, const Condition& condition) {
  const auto count = std::count_if(samples.begin(), samples.end(), condition);
  return static_cast<double>(count) / static_cast<double>(samples.size());
}

bool inside_three_sigma(const Sample& s) {
  const geometry::PoseEstimate& estimate = s.row->localization.estimate;
  const Eigen::Vector3d error{s.truth.x - estimate.pose.x, s.truth.y - estimate.pose.y, s.heading_rad};
  for (int i = 0; i < 3; ++i) {
    if (std::abs(error[i]) > 3.0 * std::sqrt(std::max(0.0, estimate.covariance(i, i)))) return false;
  }
  return true;
}

bool within(std::span<const Interval> intervals, sensors::Timestamp time) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [time](const Interval& i) { return time >= i.first && time <= i.second; });
}

void add_errors(LocalizationScore& result, const std::vector<Sample>& samples) {
  std::vector<double> position, heading;
  for (const Sample& s : samples) {
    position.push_back(s.position_m);
    heading.push_back(s.heading_rad);
  }
  const Statistics p = statistics(position), h = statistics(heading);
  result.mean_position_m = p.mean, result.median_position_m = p.median;
  result.rmse_position_m = p.rmse, result.max_position_m = p.max;
  result.mean_heading_rad = h.mean, result.median_heading_rad = h.median;
  result.rmse_heading_rad = h.rmse, result.max_heading_rad = h.max;
}

void add_protection(LocalizationScore& result, const std::vector<Sample>& samples, const ScoreParams& params) {
  const auto monitored = [](const Sample& s) { return !std::isnan(s.row->localization.protection.position_high_m); };
  if (std::none_of(samples.begin(), samples.end(), monitored)) return;
  const auto available = [&](const Sample& s) {
    return s.row->localization.status == Status::kLocalized &&
           s.row->localization.protection.position_high_m <= params.available_level_m &&
           s.row->localization.protection.heading_high_rad <= geometry::to_radians(params.available_level_deg);
  };
  result.available = share(samples, available);
  result.misleading = share(samples, [&](const Sample& s) {
    return available(s) && (s.position_m > s.row->localization.protection.position_high_m ||
                            s.heading_rad > s.row->localization.protection.heading_high_rad);
  });
}

void add_belief_quality(LocalizationScore& result, const std::vector<Sample>& samples, const ScoreParams& params) {
  std::vector<double> all, good, bad;
  std::vector<bool> not_lost;
  for (const Sample& s : samples) {
    const double probability = s.row->localization.belief.pignistic();
    const bool lost = s.beyond(params.lost_above_m, params.lost_above_deg);
    (lost ? bad : good).push_back(probability);
    all.push_back(probability);
    not_lost.push_back(!lost);
  }
  result.lost_count = static_cast<int>(bad.size());
  result.auroc = auroc(good, bad);
  result.calibration_error = calibration_error(all, not_lost);
}

std::string row_of(const char* name, const std::string& value, const std::string& meaning) {
  char line[256];
  std::snprintf(line, sizeof line, "  %-24s %12s   %s\n", name, value.c_str(), meaning.c_str());
  return line;
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string percent(double share) { return formatted("%.1f %%", 100.0 * share); }
std::string percent(const std::optional<double>& share) { return share ? percent(*share) : "-"; }

}  // namespace

std::optional<geometry::Pose2> truth_at(std::span<const datasets::TimedPose> truth, sensors::Timestamp time,
                                        const ScoreParams& params) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), time,
                       [](const datasets::TimedPose& row, sensors::Timestamp t) { return row.time < t; });
  if (after != truth.end() && after->time == time) return after->pose;
  if (after != truth.begin() && after != truth.end()) {
    const datasets::TimedPose &a = *(after - 1), &b = *after;
    const double gap = sensors::seconds_between(a.time, b.time);
    if (gap <= params.truth_max_gap_s)
      return geometry::interpolate(a.pose, b.pose, sensors::seconds_between(a.time, time) / gap);
  }
  const datasets::TimedPose* nearest = nullptr;
  if (after != truth.begin()) nearest = &*(after - 1);
  if (after != truth.end() && (nearest == nullptr || after->time - time < time - nearest->time)) nearest = &*after;
  if (nearest == nullptr || std::abs(sensors::seconds_between(nearest->time, time)) > params.truth_max_diff_s)
    return {};
  return nearest->pose;
}

std::vector<Interval> degraded_intervals(const std::vector<datasets::Event>& events) {
  constexpr sensors::Timestamp kNever = std::numeric_limits<sensors::Timestamp>::max();
  std::vector<Interval> intervals;
  std::map<std::string, std::size_t> open;  // by the sensor's name
  for (const datasets::Event& event : events) {
    const std::size_t cut = event.name.rfind('_');
    if (cut == std::string::npos) continue;
    const std::string sensor = event.name.substr(0, cut), what = event.name.substr(cut + 1);
    if (what == "degraded" || what == "failed") {
      if (open.contains(sensor)) continue;  // it gets worse
      open[sensor] = intervals.size();
      intervals.emplace_back(event.time, kNever);
    } else if (what == "restored" && open.contains(sensor)) {
      intervals[open[sensor]].second = event.time;
      open.erase(sensor);
    }
  }
  return intervals;
}

LocalizationScore score(std::span<const LocalizationRow> rows, std::span<const datasets::TimedPose> truth,
                        const std::optional<std::vector<Interval>>& degraded, const ScoreParams& params) {
  const std::vector<Sample> samples = with_truth(rows, truth, params);
  if (samples.empty()) {
    throw std::runtime_error(
        "no acquisition has a ground truth at its time: do the result and the reference belong together?");
  }
  LocalizationScore result{.acquisitions = static_cast<int>(rows.size()),
                           .with_truth = static_cast<int>(samples.size())};
  const auto status = [](const Sample& s) { return s.row->localization.status; };
  const auto confident = [&](const Sample& s) {
    return status(s) == Status::kLocalized && s.row->localization.belief.yes > params.confident_belief;
  };
  const auto lost = [&](const Sample& s) { return s.beyond(params.lost_above_m, params.lost_above_deg); };
  const auto wrong = [&](const Sample& s) { return s.beyond(params.wrong_above_m, params.wrong_above_deg); };
  add_errors(result, samples);
  result.success = share(samples, [&](const Sample& s) {
    return s.position_m < params.success_below_m && s.heading_rad < geometry::to_radians(params.success_below_deg);
  });
  result.localized = share(samples, [&](const Sample& s) { return status(s) == Status::kLocalized; });
  result.lost = share(samples, lost);
  result.confidently_wrong = share(samples, [&](const Sample& s) { return confident(s) && wrong(s); });
  result.confidently_right = share(samples, [&](const Sample& s) { return confident(s) && !wrong(s); });
  result.alert = share(samples, [&](const Sample& s) { return status(s) != Status::kLocalized; });
  result.false_alert = share(samples, [&](const Sample& s) {
    return status(s) != Status::kLocalized && s.position_m < params.lost_above_m &&
           s.heading_rad < geometry::to_radians(params.lost_above_deg) &&
           !(degraded && within(*degraded, s.row->localization.time));
  });
  result.degradation_known = degraded.has_value();
  add_protection(result, samples, params);
  for (const Sample& s : samples) {
    result.anees += nees(s.row->localization.estimate, s.truth) / static_cast<double>(samples.size());
  }
  result.inside_3_sigma = share(samples, inside_three_sigma);
  add_belief_quality(result, samples, params);
  return result;
}

std::optional<double> auroc(std::span<const double> good, std::span<const double> bad) {
  if (good.empty() || bad.empty()) return {};
  std::vector<double> sorted(bad.begin(), bad.end());
  std::sort(sorted.begin(), sorted.end());
  double wins = 0.0;
  for (const double value : good) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
    wins += static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
  }
  return wins / (static_cast<double>(good.size()) * static_cast<double>(bad.size()));
}

double calibration_error(std::span<const double> probabilities, const std::vector<bool>& came_true, int bins) {
  const std::size_t n = probabilities.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
  double error = 0.0;
  for (int bin = 0; bin < bins; ++bin) {
    const std::size_t from = n * static_cast<std::size_t>(bin) / static_cast<std::size_t>(bins);
    const std::size_t to = n * static_cast<std::size_t>(bin + 1) / static_cast<std::size_t>(bins);
    double expected = 0.0, observed = 0.0;
    for (std::size_t k = from; k < to; ++k) {
      expected += probabilities[order[k]];
      observed += came_true[order[k]] ? 1.0 : 0.0;
    }
    error += std::abs(expected - observed);
  }
  return n > 0 ? error / static_cast<double>(n) : 0.0;
}

std::string to_text(const LocalizationScore& s, const ScoreParams& p) {
  const auto cm = [](double m) { return formatted("%.2f cm", 100.0 * m); };
  const auto deg = [](double rad) { return formatted("%.3f deg", geometry::to_degrees(rad)); };
  const auto limits = [](double m, double d, const char* word = " or ") {
    return formatted("%g m", m) + word + formatted("%g deg", d);
  };
  const std::string lost = limits(p.lost_above_m, p.lost_above_deg), wrong = limits(p.wrong_above_m, p.wrong_above_deg);
  std::string text = "Localization against ground truth: " + std::to_string(s.with_truth) + " of " +
                     std::to_string(s.acquisitions) + " acquisitions have a truth (not aligned)\n";
  text +=
      row_of("mean position error", cm(s.mean_position_m),
             "median " + cm(s.median_position_m) + ", rmse " + cm(s.rmse_position_m) + ", max " + cm(s.max_position_m));
  text += row_of(
      "mean heading error", deg(s.mean_heading_rad),
      "median " + deg(s.median_heading_rad) + ", rmse " + deg(s.rmse_heading_rad) + ", max " + deg(s.max_heading_rad));
  text +=
      row_of("success", percent(s.success), "error below " + limits(p.success_below_m, p.success_below_deg, " and "));
  text += row_of("confidently wrong", percent(s.confidently_wrong),
                 "localized, belief_yes > " + formatted("%g", p.confident_belief) + ", yet error > " + wrong);
  text += row_of("confidently right", percent(s.confidently_right), "the same words, and error within both");
  text += row_of("lost", percent(s.lost), "error > " + lost);
  text += row_of("alert", percent(s.alert), "status other than localized");
  text += row_of(
      "false alert", percent(s.false_alert),
      std::string("an alert with error below both limits of lost, ") +
          (s.degradation_known ? "no sensor degraded" : "or less: no events.csv says when sensors were degraded"));
  text +=
      row_of("available", percent(s.available),
             "localized and protection levels within " + limits(p.available_level_m, p.available_level_deg, " and ") +
                 (s.available ? "" : " (no integrity monitor)"));
  text += row_of("misleading", percent(s.misleading), "available, yet the error is above the protection level");
  text += row_of("NEES", formatted("%.2f", s.anees),
                 "mean over time of one run (3 expected); within 3 sigma: " + percent(s.inside_3_sigma));
  const bool enough = s.lost_count >= 200;
  text += row_of("AUROC", s.auroc ? formatted("%.3f", *s.auroc) : "-",
                 "BetP(YES) against lost, over " + std::to_string(s.lost_count) + " lost" +
                     (enough ? "" : " (at least 200 are asked for)"));
  text += row_of("calibration error", formatted("%.3f", s.calibration_error.value_or(0.0)),
                 "ECE of BetP(YES), 10 bins of equal count");
  return text;
}

}  // namespace credo::evaluation
