// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/evaluate.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/run_report.hpp"
#include "apps/terminal.hpp"
#include "evaluation/consistency.hpp"

namespace credo::apps {
namespace {

using nlohmann::ordered_json;

struct ScoreOptions {
  std::string reference, result;
  OutputFormat format;
};

/// Poses without a place in the map have no error; ones that are far off everywhere are most likely of another drive.
void check_comparable(const std::vector<results::LocalizationRow>& rows, const Truth& truth, const ScoreOptions& o) {
  constexpr double kFarOff_m = 1.0;
  double nearest = std::numeric_limits<double>::infinity();
  bool absolute = false;
  for (const results::LocalizationRow& row : rows) {
    if (row.localization.status == localization::Status::kInitializing) continue;
    absolute = true;
    const auto pose = evaluation::truth_at(truth.poses, row.localization.time);
    if (pose) nearest = std::min(nearest, (pose->translation() - row.localization.estimate.pose.translation()).norm());
  }
  if (!rows.empty() && !absolute)
    throw std::runtime_error(
        o.result +
        ": all acquisitions are initializing: their poses are relative to the start, and cannot be "
        "compared with a truth in the map frame; run with a floor plan and an initial pose, or "
        "compare the motion with credo evaluate rpe");
  if (std::isfinite(nearest) && nearest > kFarOff_m)
    say_warning(fmt::format("no pose comes nearer than {:.1f} m to the truth: is {} the truth of {}?", nearest,
                            o.reference, o.result));
}

void add_score(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("score", "Position, heading and belief of a run against the truth.");
  command->footer(
      "  credo evaluate score datasets/office results/office\n"
      "  credo evaluate score truth.tum results/office --format json");
  auto o = std::make_shared<ScoreOptions>();
  command->add_option("REF", o->reference, "a dataset folder, or a trajectory file")->check(a_path())->required();
  command->add_option("RESULT", o->result, "a results folder, or a localization.csv")->check(a_path())->required();
  add_format_option(*command, o->format);
  command->callback([o] {
    const Truth truth = read_truth(o->reference);
    const auto rows = read_rows(o->result);
    check_comparable(rows, truth, *o);
    std::optional<std::vector<evaluation::Interval>> degraded;
    if (truth.events) degraded = evaluation::degraded_intervals(*truth.events);
    const auto score = evaluation::score(rows, truth.poses, degraded);
    if (o->format.json())
      print(to_json(score));
    else
      std::printf("%s", evaluation::to_text(score).c_str());
  });
}

struct NeesOptions {
  std::vector<std::string> paths;
  OutputFormat format;
};

/// NEES of the acquisitions that have a truth and an absolute pose.
std::vector<double> nees_of(const std::string& reference, const std::string& result) {
  const Truth truth = read_truth(reference);
  std::vector<double> values;
  for (const results::LocalizationRow& row : read_rows(result)) {
    const auto pose = evaluation::truth_at(truth.poses, row.localization.time);
    if (pose && row.localization.status != localization::Status::kInitializing) {
      values.push_back(evaluation::nees(row.localization.estimate, *pose));
    }
  }
  if (values.empty())
    throw std::runtime_error(result + ": no acquisition with an absolute pose and a truth in " + reference);
  return values;
}

std::string nees_text(const evaluation::Consistency& c) {
  std::string text = fmt::format(
      "ANEES of x, y and heading over {} run{} and {} acquisitions (error and covariance in the map frame; 3 "
      "expected)\n"
      "  mean {:.3f}; 95 % bounds of one acquisition over {} run{}: {:.3f} to {:.3f}; inside: {:.1f} %\n",
      c.runs, c.runs == 1 ? "" : "s", c.anees.size(), c.mean, c.runs, c.runs == 1 ? "" : "s", c.bounds.lower,
      c.bounds.upper, 100.0 * c.share_inside);
  if (c.runs == 1) text += "  one run: its acquisitions are correlated, so this is an indication and no verdict\n";
  const char* verdict = c.met() ? "met" : c.mean > 4.0 ? "over-confident" : c.mean < 2.0 ? "pessimistic" : "not met";
  return text +
         fmt::format("  {}: asked for are 90 % of the acquisitions inside the bounds and a mean in 2 to 4\n", verdict);
}

void add_nees(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("nees", "Consistency: are the errors as large as the covariance says?");
  command->footer(
      "  credo evaluate nees datasets/office results/office\n"
      "  credo evaluate nees datasets/a results/a datasets/b results/b    independent runs of the same drive");
  auto o = std::make_shared<NeesOptions>();
  command->add_option("REF RESULT ...", o->paths, "dataset (or trajectory) and results, once for each run")
      ->check(a_path())
      ->required();
  add_format_option(*command, o->format);
  command->callback([o] {
    if (o->paths.size() % 2 != 0)
      throw CLI::ValidationError("nees", "expected REF RESULT pairs, found an odd number of paths");
    std::vector<std::vector<double>> runs;
    for (std::size_t i = 0; i < o->paths.size(); i += 2) runs.push_back(nees_of(o->paths[i], o->paths[i + 1]));
    const evaluation::Consistency c = evaluation::consistency(runs);
    if (o->format.json()) {
      print(ordered_json{{"runs", c.runs},
                         {"mean", c.mean},
                         {"lower", c.bounds.lower},
                         {"upper", c.bounds.upper},
                         {"share_inside", c.share_inside},
                         {"met", c.met()},
                         {"anees", c.anees}});
    } else {
      std::printf("%s", nees_text(c).c_str());
    }
  });
}

}  // namespace

void add_evaluate_localization(CLI::App& evaluate) {
  add_score(evaluate);
  add_nees(evaluate);
}

}  // namespace credo::apps
