// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/interrupt.hpp"
#include "apps/map_report.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/reproduce.hpp"
#include "apps/terminal.hpp"
#include "results/map_sheet.hpp"
#include "results/pictures.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

struct MapExperiment {
  const char* name;
  const char* what;
  MapReport (*reproduce)(const ExperimentParams&, const Report&);
};

constexpr std::array kMapExperiments{
    MapExperiment{"sonar-laser", "Li X. 2006: sonar and laser, discounted, by DSmT.", reproduce_li2006},
    MapExperiment{"sonar", "Li X. 2007: sonar by DSmT against DST.", reproduce_li2007},
    MapExperiment{"multi-robot", "Li P.: two robots against one, by PCR2.", reproduce_lip},
    MapExperiment{"improved-ds", "Zhu: self-adaptive approximation against a fixed one.", reproduce_zhu}};

struct MapExperimentOptions {
  ExperimentParams params;
  std::string out;       ///< empty: nothing is written
  std::string pictures;  ///< empty: none
  bool force = false;
  OutputFormat format;
};

MapReport reproduce(const MapExperiment& experiment, const ExperimentParams& params) {
  Progress progress(std::string("reproducing ") + experiment.name);
  return experiment.reproduce(params, [&](int made, int of) {
    Interruptible::check();
    progress.update(static_cast<double>(made) / of);
  });
}

void draw_sheet(const std::filesystem::path& file, const MapReport& report) {
  std::vector<results::SheetMap> maps;
  for (const ShownMap& shown : report.maps) maps.push_back({shown.title, shown.caption, &shown.map});
  results::write_png(file, results::map_sheet(maps));
}

/// Leaves report.txt, report.json, config.yaml and the picture, all or nothing.
MapReport reproduce_into_folder(const MapExperiment& experiment, const MapExperimentOptions& o) {
  datasets::StagedFolder folder = results::stage_results(o.out, o.force);
  std::optional<PictureFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, o.out, folder.path(), o.force);
  MapReport report = reproduce(experiment, o.params);
  results::write_text(folder.path() / "config.yaml",
                      std::string("format: credo-results/1\ncredo: " CREDO_VERSION "\nreproduces: ") + experiment.name +
                          "\nseed: " + std::to_string(o.params.seed) + "\nseeds: " + std::to_string(o.params.seeds) +
                          "\n");
  results::write_text(folder.path() / "report.txt", to_text(report));
  results::write_text(folder.path() / "report.json", to_json(report).dump(1) + "\n");
  if (pictures) draw_sheet(pictures->path() / "maps.png", report);
  Interruptible::check();
  if (pictures) pictures->publish();
  folder.commit();
  return report;
}

void execute(const MapExperiment& experiment, const MapExperimentOptions& o) {
  const Interruptible interruptible;
  const MapReport report = o.out.empty() ? reproduce(experiment, o.params) : reproduce_into_folder(experiment, o);
  if (o.format.json()) {
    print(to_json(report));
    return;
  }
  std::printf("%s", to_text(report).c_str());
  if (!o.out.empty()) std::printf("results: %s\n", o.out.c_str());
  if (!o.pictures.empty()) std::printf("pictures: %s\n", o.pictures.c_str());
}

void add_experiment(CLI::App& reproduce, const MapExperiment& experiment) {
  CLI::App* command = reproduce.add_subcommand(experiment.name, experiment.what);
  const std::string name = experiment.name;
  command->footer("  credo reproduce " + name + "\n  credo reproduce " + name + " --seeds 1 --out results/" + name +
                  " --pictures results/" + name + "/pictures");
  auto o = std::make_shared<MapExperimentOptions>();
  command->add_option("--seed", o->params.seed, "of the first simulation")->check(any_seed())->capture_default_str();
  command->add_option("--seeds", o->params.seeds, "how many simulations, each with a seed of its own")
      ->check(number_in(1, 1000))
      ->capture_default_str();
  CLI::Option* out =
      command->add_option("-o,--out", o->out, "folder for the report; without it, it is printed only")->check(a_path());
  command->add_option("--pictures", o->pictures, "folder for maps.png, the maps of the first seed; goes with --out")
      ->check(a_path())
      ->needs(out);
  command->add_flag("-f,--force", o->force, "replace results that are already there");
  add_format_option(*command, o->format);
  command->callback([o, &experiment] { execute(experiment, *o); });
}

}  // namespace

void add_reproduce_maps(CLI::App& reproduce) {
  for (const MapExperiment& experiment : kMapExperiments) add_experiment(reproduce, experiment);
}

}  // namespace credo::apps
