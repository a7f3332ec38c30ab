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

#include "apps/about.hpp"
#include "apps/evaluate.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/run_report.hpp"
#include "apps/terminal.hpp"

namespace credo::apps {
namespace {

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
    const auto score = about(o->result, [&] { return evaluation::score(rows, truth.poses, degraded); });
    if (o->format.json())
      print(to_json(score));
    else
      std::printf("%s", evaluation::to_text(score).c_str());
  });
}

}  // namespace

void add_evaluate_localization(CLI::App& evaluate) { add_score(evaluate); }

}  // namespace credo::apps
