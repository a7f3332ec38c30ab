// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_extent.hpp"
#include "apps/map_saturation.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/run_pictures.hpp"
#include "apps/run_report.hpp"
#include "apps/terminal.hpp"
#include "results/calibration_file.hpp"
#include "results/config.hpp"
#include "results/results_writer.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

PipelineParams params_of(const RunOptions& options) {
  PipelineParams params =
      PipelineParams::of(options.method == "paper" ? perception::Method::kPaper : perception::Method::kDefault);
  params.mapper.georeference.resolution_m = options.resolution_m;
  for (const auto& [seconds, x, y, theta] : options.poses_at)
    params.poses_by_hand.push_back({static_cast<sensors::Timestamp>(std::llround(1e9 * seconds)), {x, y, theta}});
  return params;
}

void print_remarks(const datasets::Dataset& dataset) {
  for (const std::string& remark : dataset.remarks) say_warning(remark);
}

void execute(const RunOptions& options, const OutputFormat& format) {
  const datasets::Dataset dataset = datasets::Dataset::open(options.dataset);
  print_remarks(dataset);
  fs::path out;
  const Outcome outcome = about(options.dataset, [&] { return run_and_write(dataset, options, out); });
  if (format.json()) {
    nlohmann::ordered_json report = to_json(outcome, dataset);
    report["results"] = out.string();
    print(report);
    return;
  }
  std::printf("%s\nresults: %s\n", to_text(outcome, dataset).c_str(), out.string().c_str());
  if (!options.pictures.empty()) std::printf("pictures: %s\n", options.pictures.c_str());
}

/// The name of a dataset as that of a folder: what could lead elsewhere becomes '_'.
std::string folder_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' '; },
      '_');
  if (name.empty() || name.front() == '.') name.insert(0, "_");
  constexpr std::size_t kLongest = 200;  // bytes; file systems take 255
  return name.substr(0, kLongest);
}

}  // namespace

Outcome run_and_write(const datasets::Dataset& dataset, const RunOptions& options, fs::path& out) {
  out = options.out.empty() ? fs::path("results") / folder_name(dataset.header.name) : fs::path(options.out);
  const PipelineParams params = params_of(options);
  const Interruptible interruptible;
  results::ResultsWriter writer(out, options.force);
  std::optional<RunPictures> pictures;
  if (!options.pictures.empty()) {
    pictures.emplace(PictureFolder(options.pictures, out, writer.working_folder(), options.force), dataset,
                     options.picture_moments);
  }
  Progress progress("running " + dataset.header.name);
  Outcome outcome = run(dataset, params, [&](const Step& step) {
    Interruptible::check();
    writer.add(step.scene, step.fix, step.localizer.tracks());
    if (pictures) pictures->draw(step);
    progress.update(static_cast<double>(step.index + 1) / static_cast<double>(step.count));
  });
  if (pictures) pictures->draw_summary(outcome);
  warn_of_saturation(outcome.map);
  if (!writer.add_map(outcome.map, {.channels = options.readout == "raw" ? results::BeliefChannels::kRaw
                                                                         : results::BeliefChannels::kNormalized}))
    warn_without_pictures(outcome.map);
  writer.add_config(results::to_yaml(results::RunConfig{.version = CREDO_VERSION,
                                                        .dataset = dataset.header.name,
                                                        .observer = params.observer,
                                                        .localizer = params.localizer,
                                                        .mapper = params.mapper}));
  writer.add_calibration(results::to_yaml(outcome.calibration, dataset.header.rig));
  Interruptible::check();
  if (pictures) pictures->publish();
  writer.finish();
  return outcome;
}

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Localizes and maps a recorded or simulated drive.");
  command->footer(
      "  credo run datasets/office                                  results in results/office\n"
      "  credo run datasets/office --out results/a --pictures results/a/pictures\n"
      "  credo run datasets/office --method paper --out results/paper\n"
      "  credo run datasets/office --pose-at 12.5 3.0 1.2 1.57          tells a robot that is lost where it is\n"
      "  credo run datasets/office --format json --force | jq .score.mean_position_m");
  auto options = std::make_shared<RunOptions>();
  auto format = std::make_shared<OutputFormat>();
  command->add_option("DATASET", options->dataset, "folder with a dataset.yaml")->check(a_path())->required();
  command->add_option("-o,--out", options->out, "folder for the results; default results/NAME")->check(a_path());
  command->add_option("--method", options->method, "the paper's method with its absolute breakpoints, or the default")
      ->check(CLI::IsMember({"default", "paper"}))
      ->capture_default_str();
  command->add_option("--pictures", options->pictures, "folder for pictures of some acquisitions and of the whole run")
      ->check(a_path());
  command->add_option("--moments", options->picture_moments, "how many acquisitions are drawn")
      ->check(number_in(0, 100'000))
      ->capture_default_str();
  command->add_option("--resolution", options->resolution_m, "side of a map cell [m]")
      ->check(any_resolution())
      ->capture_default_str();
  command
      ->add_option("--readout", options->readout,
                   "channels of map_belief.tiff: after Dempster's normalisation, or raw masses")
      ->check(CLI::IsMember({"normalized", "raw"}))
      ->capture_default_str();
  command
      ->add_option(
          "--pose-at", options->poses_at,
          "a pose set by hand: a time on the dataset's clock, as in trajectory.tum, and x y theta [s m m rad]; "
          "may be given again")
      ->type_name("T X Y THETA")
      ->allow_extra_args(false)
      ->check(number_in(-1e9, 1e10));
  command->add_flag("-f,--force", options->force, "replace results that are already there");
  add_format_option(*command, *format);
  command->callback([options, format] { execute(*options, *format); });
}

}  // namespace credo::apps
