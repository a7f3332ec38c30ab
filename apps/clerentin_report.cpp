// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/clerentin_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "geometry/angles.hpp"

namespace credo::apps {
namespace {

using evaluation::MassSpread;
using evaluation::ReproducedFigures;
using evaluation::Spread;
using nlohmann::ordered_json;
using perception::PrimitiveType;

// ---------------------------------------------------------------------------------------------- the figures

/// One line of the table.
struct PrintedFigure {
  const char* key;    ///< in the JSON
  const char* words;  ///< in the text
  const char* paper;  ///< as printed; "-": not reported, or in a lost picture
  int decimals;
  std::optional<double> (*of)(const ReproducedFigures&);
};

constexpr std::array kFigures{
    PrintedFigure{"mean_position_cm", "mean position error [cm]", "13", 1,
                  [](const ReproducedFigures& f) -> std::optional<double> { return 100.0 * f.mean_position_m; }},
    PrintedFigure{
        "mean_heading_deg", "mean heading error [deg]", "3", 2,
        [](const ReproducedFigures& f) -> std::optional<double> { return geometry::to_degrees(f.mean_heading_rad); }},
    PrintedFigure{"within_45_cm", "acquisitions within 45 cm", "-", 1,
                  [](const ReproducedFigures& f) -> std::optional<double> { return f.within_m.count; }},
    PrintedFigure{"mean_position_within_cm", "mean position error of these [cm]", "-", 1,
                  [](const ReproducedFigures& f) {
                    return f.within_m.count > 0 ? std::optional(100.0 * f.within_m.mean()) : std::nullopt;
                  }},
    PrintedFigure{"wrong_matches_percent", "landmarks that are matched wrongly [%]", "none", 1,
                  [](const ReproducedFigures& f) {
                    return f.wrong_matches ? std::optional(100.0 * *f.wrong_matches) : std::nullopt;
                  }},
    PrintedFigure{"mean_conflict", "mean conflict of the five criteria", "0.13", 3,
                  [](const ReproducedFigures& f) -> std::optional<double> { return f.mean_conflict; }},
    PrintedFigure{"until_lost", "acquisitions from the last sighting to the loss", "5", 1,
                  [](const ReproducedFigures& f) {
                    return f.until_lost.count > 0 ? std::optional(f.until_lost.mean()) : std::nullopt;
                  }},
    PrintedFigure{"walls_between", "tracks that were a wall in between", "1", 1,
                  [](const ReproducedFigures& f) -> std::optional<double> { return f.walls_between; }},
    PrintedFigure{"mean_belief_yes", "mean m_l(YES)", "-", 3,
                  [](const ReproducedFigures& f) -> std::optional<double> { return f.mean_belief_yes; }},
    PrintedFigure{"belief_follows_tracks", "m_l(YES) is larger with more tracks", "yes", 2,
                  [](const ReproducedFigures& f) { return f.belief_follows_tracks; }}};

/// A figure over the seeds that have one.
Spread over_seeds(const std::vector<ClerentinRun>& runs, const PrintedFigure& figure) {
  Spread spread;
  for (const ClerentinRun& run : runs)
    if (const auto value = figure.of(run.figures)) spread.add(*value);
  return spread;
}

std::string words(const Spread& spread, int decimals) {
  if (spread.count == 0) return "-";
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", spread.mean(), decimals, spread.lowest, decimals, spread.highest,
                     decimals);
}

ordered_json json_of(const Spread& spread) {
  if (spread.count == 0) return nullptr;
  return {{"mean", spread.mean()}, {"lowest", spread.lowest}, {"highest", spread.highest}, {"n", spread.count}};
}

// ---------------------------------------------------------------------------------------------- table 1

struct Range {
  double lowest, highest;
};

/// Table 1 of the paper by type: 3 edges, 2 corners, 7 walls. Two of its rows do not sum to 1.
struct PrintedMasses {
  PrimitiveType type;
  Range yes, no, unknown;
};

constexpr std::array kTable1{PrintedMasses{PrimitiveType::kEdge, {0.33, 0.72}, {0.03, 0.25}, {0.20, 0.42}},
                             PrintedMasses{PrimitiveType::kCorner, {0.64, 0.78}, {0.03, 0.16}, {0.18, 0.20}},
                             PrintedMasses{PrimitiveType::kWall, {0.07, 0.91}, {0.0, 0.0}, {0.09, 0.93}}};

void merge(const Spread& from, Spread& into) {
  into.count += from.count;
  into.sum += from.sum;
  into.lowest = std::min(into.lowest, from.lowest);
  into.highest = std::max(into.highest, from.highest);
}

/// The masses of a type over all seeds.
MassSpread masses_of(const std::vector<ClerentinRun>& runs, PrimitiveType type) {
  MassSpread all;
  for (const ClerentinRun& run : runs) {
    for (const evaluation::ReproducedDrive& drive : run.drives) {
      const MassSpread& masses = drive.masses[static_cast<std::size_t>(type)];
      merge(masses.yes, all.yes);
      merge(masses.no, all.no);
      merge(masses.unknown, all.unknown);
      all.without_no += masses.without_no;
    }
  }
  return all;
}

std::string range_words(const Spread& spread) {
  return spread.count > 0 ? fmt::format("{:.2f} to {:.2f}, mean {:.2f}", spread.lowest, spread.highest, spread.mean())
                          : "-";
}

std::string without_no_words(const MassSpread& masses) {
  return masses.no.count > 0 ? fmt::format("{:.0f} %", 100.0 * masses.without_no / masses.no.count) : "-";
}

constexpr const char* kLine = "{:<50}{:<14}{:<26}{}\n";

std::string table_1_text(const ClerentinExperiment& experiment) {
  std::string text = fmt::format(kLine, "masses of the primitives", "table 1", "--method paper", "default");
  for (const PrintedMasses& printed : kTable1) {
    const char* const type = perception::to_string(printed.type);
    const MassSpread paper = masses_of(experiment.paper, printed.type);
    const MassSpread standard = masses_of(experiment.standard, printed.type);
    const auto line = [&](const char* what, const Range& range, const Spread& a, const Spread& b) {
      text += fmt::format(kLine, fmt::format("{}: m({})", type, what),
                          fmt::format("{:.2f} to {:.2f}", range.lowest, range.highest), range_words(a), range_words(b));
    };
    line("YES", printed.yes, paper.yes, standard.yes);
    line("NO", printed.no, paper.no, standard.no);
    line("unknown", printed.unknown, paper.unknown, standard.unknown);
    text += fmt::format(kLine, fmt::format("{}: of them with m(NO) = 0", type),
                        printed.no.highest > 0.0 ? "none" : "all", without_no_words(paper), without_no_words(standard));
  }
  return text;
}

ordered_json table_1_json(const std::vector<ClerentinRun>& runs) {
  ordered_json table;
  for (const PrintedMasses& printed : kTable1) {
    const MassSpread masses = masses_of(runs, printed.type);
    table[perception::to_string(printed.type)] = {{"yes", json_of(masses.yes)},
                                                  {"no", json_of(masses.no)},
                                                  {"unknown", json_of(masses.unknown)},
                                                  {"without_no", masses.without_no}};
  }
  return table;
}

// ---------------------------------------------------------------------------------------------- series

/// A row of one cell for each acquisition.
template <class Values, class Cell>
std::string row(const char* name, const Values& values, const Cell& cell) {
  std::string text = fmt::format("  {:<12}", name);
  for (const auto& value : values) text += fmt::format("{:>5}", cell(value));
  return text + "\n";
}

std::string two_decimals(double value) { return fmt::format("{:.2f}", value); }

/// The acquisitions of a life, and the one that it was lost in.
std::string life_text(const char* method, const std::optional<LifeExample>& example) {
  if (!example) return fmt::format("{}: no such track\n", method);
  const evaluation::TrackLife& life = example->life;
  std::string text = fmt::format("{}: track {} of {}, seed {}\n", method, life.id, example->way, example->seed);
  const std::vector<results::TrackSample> samples = life.with_loss();
  std::vector<std::size_t> numbers(samples.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = life.first + i + 1;
  text += row("acquisition", numbers, [](std::size_t n) { return n; });
  text += row("m(YES)", samples, [](const auto& s) { return two_decimals(s.existence.yes); });
  text += row("m(NO)", samples, [](const auto& s) { return two_decimals(s.existence.no); });
  text += row("seen as", samples, [&](const auto& s) -> std::string {
    if (&s == &samples.back() && life.lost_with) return "lost";
    if (s.state != tracking::TrackState::kTracked) return "-";
    return std::string(perception::to_string(s.type)).substr(0, 4);
  });
  return text;
}

std::string belief_text(const ClerentinExperiment& experiment) {
  std::string text;
  for (std::size_t w = 0; w < experiment.params.ways.size(); ++w) {
    for (const bool paper : {true, false}) {
      const results::History& history = (paper ? experiment.paper : experiment.standard).front().drives[w].history;
      text += fmt::format("{}: {}, seed {}\n", paper ? "--method paper" : "default", experiment.params.ways[w],
                          experiment.params.seed);
      text += row("m_l(YES)", history, [](const auto& m) { return two_decimals(m.localization.belief.yes); });
      text += row("landmarks", history, [](const auto& m) { return evaluation::landmarks_tracked(m); });
      text += row("error [cm]", history, [](const auto& m) {
        const auto& pose = m.localization.estimate.pose;
        return fmt::format("{:.0f}", 100.0 * (pose.translation() - m.truth->translation()).norm());
      });
    }
  }
  return text;
}

ordered_json json_of(const std::optional<LifeExample>& example) {
  if (!example) return nullptr;
  ordered_json samples = ordered_json::array();
  const std::vector<results::TrackSample> life = example->life.with_loss();
  for (std::size_t i = 0; i < life.size(); ++i) {
    const results::TrackSample& sample = life[i];
    samples.push_back({{"acquisition", example->life.first + i + 1},
                       {"type", perception::to_string(sample.type)},
                       {"state", tracking::to_string(sample.state)},
                       {"yes", sample.existence.yes},
                       {"no", sample.existence.no}});
  }
  return {{"seed", example->seed},
          {"way", example->way},
          {"track", example->life.id},
          {"lost", example->life.lost_with.has_value()},
          {"samples", samples}};
}

ordered_json acquisitions_json(const ClerentinExperiment& experiment, const std::vector<ClerentinRun>& runs) {
  ordered_json all = ordered_json::array();
  for (std::size_t s = 0; s < runs.size(); ++s) {
    for (std::size_t w = 0; w < runs[s].drives.size(); ++w) {
      const results::History& history = runs[s].drives[w].history;
      for (std::size_t i = 0; i < history.size(); ++i) {
        const localization::Localization& fix = history[i].localization;
        const geometry::Pose2 &pose = fix.estimate.pose, &truth = history[i].truth.value();
        all.push_back({{"seed", experiment.params.seed + s},
                       {"way", experiment.params.ways[w]},
                       {"acquisition", i + 1},
                       {"pose", {pose.x, pose.y, pose.theta}},
                       {"truth", {truth.x, truth.y, truth.theta}},
                       {"belief_yes", fix.belief.yes},
                       {"belief_no", fix.belief.no},
                       {"landmarks", evaluation::landmarks_tracked(history[i])}});
      }
    }
  }
  return all;
}

ordered_json method_json(const ClerentinExperiment& experiment, const std::vector<ClerentinRun>& runs) {
  ordered_json figures;
  for (const PrintedFigure& figure : kFigures) figures[figure.key] = json_of(over_seeds(runs, figure));
  return {{"figures", figures},
          {"table_1", table_1_json(runs)},
          {"figure_21", json_of(life_of_an_edge(experiment.params, runs))},
          {"figure_22", json_of(life_with_a_wall_between(experiment.params, runs))},
          {"acquisitions", acquisitions_json(experiment, runs)}};
}

}  // namespace

std::string to_text(const ClerentinExperiment& experiment) {
  const ClerentinParams& params = experiment.params;
  std::string ways;
  for (const std::string& way : params.ways) ways += (ways.empty() ? "" : ", ") + way;
  std::string text = fmt::format(
      "Clerentin et al., sec. 5, simulated: {} acquisitions on the way{} {}; both methods on the same readings.\n"
      "{} random seed{} from {} on: the mean of what each gives (lowest to highest).\n\n",
      experiment.paper.front().figures.acquisitions, params.ways.size() == 1 ? "" : "s", ways, params.seeds,
      params.seeds == 1 ? "" : "s", params.seed);
  text += fmt::format(kLine, "", "the paper", "--method paper", "default");
  for (const PrintedFigure& figure : kFigures)
    text += fmt::format(kLine, figure.words, figure.paper, words(over_seeds(experiment.paper, figure), figure.decimals),
                        words(over_seeds(experiment.standard, figure), figure.decimals));
  text += "\n" + table_1_text(experiment);
  text +=
      "\nAn edge that is seen for some time and then lost (fig. 21: seen in 1 to 7 from (.5, 0, .5) on, lost at 12)\n";
  text += life_text("--method paper", life_of_an_edge(params, experiment.paper));
  text += life_text("default", life_of_an_edge(params, experiment.standard));
  text += "\nOne track while an edge is seen as a wall for some time (fig. 22: edge until 32, wall, edge from 37 on)\n";
  text += life_text("--method paper", life_with_a_wall_between(params, experiment.paper));
  text += life_text("default", life_with_a_wall_between(params, experiment.standard));
  text += "\nBelief in the localization (fig. 23: high, falls with the number of tracks, rises with new ones)\n";
  text += belief_text(experiment);
  return text + "\nWhat explains the differences: docs/reproduce.md.\n";
}

nlohmann::ordered_json to_json(const ClerentinExperiment& experiment) {
  ordered_json printed;
  for (const PrintedFigure& figure : kFigures) printed[figure.key] = figure.paper;
  return {{"paper", "clerentin"},
          {"ways", experiment.params.ways},
          {"seed", experiment.params.seed},
          {"seeds", experiment.params.seeds},
          {"acquisitions_per_seed", experiment.paper.front().figures.acquisitions},
          {"printed", printed},
          {"method_paper", method_json(experiment, experiment.paper)},
          {"method_default", method_json(experiment, experiment.standard)}};
}

}  // namespace credo::apps
