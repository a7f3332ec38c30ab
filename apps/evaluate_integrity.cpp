// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/evaluate.hpp"
#include "apps/gates.hpp"
#include "apps/integrity_json.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/run_list.hpp"
#include "datasets/staged_folder.hpp"
#include "evaluation/consistency.hpp"
#include "evaluation/integrity.hpp"
#include "evaluation/integrity_pictures.hpp"
#include "results/pictures.hpp"

namespace credo::apps {
namespace {

using nlohmann::ordered_json;

struct PoolOptions {
  RunPaths paths;
  std::string pictures;  ///< empty: none
  Gates gates;
  OutputFormat format;
};

void add_picture_option(CLI::App& command, PoolOptions& o) {
  command.add_option("--pictures", o.pictures, "a new folder for pictures of it")->check(a_path());
}

/// All of them, or none and no folder.
template <typename Draw>
void write_pictures(const std::string& target, const Draw& draw) {
  if (target.empty()) return;
  datasets::StagedFolder folder(target, refuse_older_pictures);
  draw(folder.path());
  folder.commit();
}

std::vector<GatedValue> figures_of(const evaluation::Integrity& integrity) {
  std::vector<GatedValue> result;
  for (const auto& [name, value] : evaluation::figures(integrity)) result.push_back({name, value});
  return result;
}

std::vector<std::string> names_of(const std::vector<GatedValue>& figures) {
  std::vector<std::string> names;
  for (const GatedValue& figure : figures) names.push_back(figure.name);
  return names;
}

void draw(const evaluation::Integrity& integrity, const std::filesystem::path& folder) {
  results::write_png(folder / "detection.png", evaluation::detection_picture(integrity));
  results::write_png(folder / "calibration.png", evaluation::calibration_picture(integrity));
  results::write_png(folder / "risk.png", evaluation::risk_picture(integrity));
  if (integrity.available) results::write_png(folder / "protection.png", evaluation::protection_picture(integrity));
  if (!integrity.episodes.empty() || !integrity.kidnaps.empty())
    results::write_png(folder / "timing.png", evaluation::timing_picture(integrity));
}

void run_integrity(const PoolOptions& o) {
  std::vector<evaluation::EvaluatedRun> runs;
  for (const RunFiles& files : run_files(o.paths, "integrity")) {
    const Truth truth = read_truth(files.reference);
    runs.push_back(about(files.result, [&] {
      return evaluation::evaluated_run(files.result, read_rows(files.result), truth.poses, truth.events);
    }));
  }
  const evaluation::Integrity integrity = about(runs.front().name, [&] { return evaluation::integrity(runs); });
  write_pictures(o.pictures, [&](const auto& folder) { draw(integrity, folder); });
  if (o.format.json())
    print(to_json(integrity));
  else
    std::printf("%s", evaluation::to_text(integrity).c_str());
  require_passed(o.gates, figures_of(integrity));
}

void add_integrity(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("integrity", "Does it know when it is lost? Over one or many runs.");
  command->footer(
      "  credo evaluate integrity datasets/office results/office --pictures office_integrity\n"
      "  credo evaluate integrity --runs runs.txt --format json\n"
      "  credo evaluate integrity --runs runs.txt --fail_above misleading=0 --fail_below auroc=0.95");
  auto o = std::make_shared<PoolOptions>();
  add_run_options(*command, o->paths);
  add_picture_option(*command, *o);
  const std::vector<std::string> names = names_of(figures_of({}));
  add_fail_above(*command, o->gates, names, "misleading=0");
  add_fail_below(*command, o->gates, names, "auroc=0.95");
  add_format_option(*command, o->format);
  command->callback([o] { run_integrity(*o); });
}

/// NEES of each acquisition of each run, with nan where there is no error to take it of.
struct NeesOfRuns {
  std::vector<std::vector<double>> pose, position, heading;
};

void add_nees(NeesOfRuns& nees, const std::vector<results::LocalizationRow>& rows, const Truth& truth) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (auto* of : {&nees.pose, &nees.position, &nees.heading}) of->emplace_back(rows.size(), kNone);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto pose = evaluation::truth_at(truth.poses, rows[i].localization.time);
    if (!pose || rows[i].localization.status == localization::Status::kInitializing) continue;
    const geometry::PoseEstimate& estimate = rows[i].localization.estimate;
    nees.pose.back()[i] = evaluation::nees(estimate, *pose);
    nees.position.back()[i] = evaluation::position_nees(estimate, *pose);
    nees.heading.back()[i] = evaluation::heading_nees(estimate, *pose);
  }
}

/// For the picture of the errors in 3 sigma.
results::History history_of(const std::vector<results::LocalizationRow>& rows, const Truth& truth) {
  results::History history;
  for (const results::LocalizationRow& row : rows) {
    if (row.localization.status == localization::Status::kInitializing) continue;
    history.push_back({.localization = row.localization,
                       .tracks = {},
                       .truth = evaluation::truth_at(truth.poses, row.localization.time)});
  }
  return history;
}

/// Of pose, position and heading.
using Consistencies = std::array<evaluation::Consistency, 3>;

std::string nees_text(const Consistencies& all) {
  const evaluation::Consistency& pose = all.front();
  const char* const plural = pose.runs == 1 ? "" : "s";
  std::string text = fmt::format(
      "ANEES over {} run{} and {} acquisitions (e = truth - estimate, e and covariance in the map frame)\n"
      "                 mean  expected   95 % bounds of one acquisition over {} run{}   inside\n",
      pose.runs, plural, pose.anees.size(), pose.runs, plural);
  for (const auto& [name, c] : {std::pair{"pose", &all[0]}, {"position", &all[1]}, {"heading", &all[2]}})
    text += fmt::format("  {:<10} {:>8.3f} {:>9} {:>18.3f} to {:<6.3f} {:>25.1f} %\n", name, c->mean, c->dimension,
                        c->bounds.lower, c->bounds.upper, 100.0 * c->share_inside);
  if (pose.runs == 1) text += "  one run: its acquisitions are correlated, so this is an indication and no verdict\n";
  const char* const verdict = pose.met()        ? "met"
                              : pose.mean > 4.0 ? "over-confident"
                              : pose.mean < 2.0 ? "pessimistic"
                                                : "not met";
  return text +
         fmt::format(
             "  {}: asked for are 90 % of the acquisitions inside the bounds and a mean in 2 to 4, of the pose\n",
             verdict);
}

ordered_json nees_json(const Consistencies& all) {
  const auto one = [](const evaluation::Consistency& c) {
    return ordered_json{
        {"mean", c.mean}, {"lower", c.bounds.lower}, {"upper", c.bounds.upper}, {"share_inside", c.share_inside}};
  };
  ordered_json result{{"runs", all[0].runs}};
  result.update(one(all[0]));
  result.update({{"met", all[0].met()},
                 {"position", one(all[1])},
                 {"heading", one(all[2])},
                 {"acquisitions", all[0].indices},
                 {"anees", all[0].anees}});
  return result;
}

void run_nees(const PoolOptions& o) {
  NeesOfRuns nees;
  results::History history;
  for (const RunFiles& files : run_files(o.paths, "nees")) {
    const Truth truth = read_truth(files.reference);
    const auto rows = read_rows(files.result);
    add_nees(nees, rows, truth);
    history = history_of(rows, truth);
    about(files.result, [&] { return evaluation::consistency(std::span(nees.pose).last(1)); });
  }
  const Consistencies all{evaluation::consistency(nees.pose, 3), evaluation::consistency(nees.position, 2),
                          evaluation::consistency(nees.heading, 1)};
  write_pictures(o.pictures, [&](const auto& folder) {
    results::write_png(folder / "anees.png", evaluation::consistency_picture(all));
    if (all[0].runs == 1) results::write_png(folder / "errors.png", results::error_picture(history));
  });
  if (o.format.json())
    print(nees_json(all));
  else
    std::printf("%s", nees_text(all).c_str());
  require_passed(o.gates, {{"mean", all[0].mean}, {"share_inside", all[0].share_inside}});
}

void add_nees(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("nees", "Consistency: are the errors as large as the covariance says?");
  command->footer(
      "  credo evaluate nees datasets/office results/office --pictures office_nees\n"
      "  credo evaluate nees datasets/a results/a datasets/b results/b    independent runs of the same drive\n"
      "  credo evaluate nees --runs runs.txt --fail_above mean=4 --fail_below share_inside=0.9");
  auto o = std::make_shared<PoolOptions>();
  add_run_options(*command, o->paths);
  add_picture_option(*command, *o);
  add_fail_above(*command, o->gates, {"mean", "share_inside"}, "mean=4");
  add_fail_below(*command, o->gates, {"mean", "share_inside"}, "share_inside=0.9");
  add_format_option(*command, o->format);
  command->callback([o] { run_nees(*o); });
}

}  // namespace

void add_evaluate_integrity(CLI::App& evaluate) {
  add_integrity(evaluate);
  add_nees(evaluate);
}

}  // namespace credo::apps
