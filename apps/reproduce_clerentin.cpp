// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/clerentin_pictures.hpp"
#include "apps/clerentin_report.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/reproduce.hpp"
#include "apps/terminal.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

struct ClerentinOptions {
  ClerentinParams params;
  std::string out;       ///< empty: nothing is written
  std::string pictures;  ///< empty: none
  bool force = false;
  OutputFormat format;
};

/// The top of a folder of results, which says that Credo wrote it and of what.
std::string config_text(const ClerentinParams& params) {
  std::string text =
      "# The parameters of both methods are their defaults.\nformat: credo-results/1\ncredo: " CREDO_VERSION
      "\nreproduces: clerentin\n";
  text += "seed: " + std::to_string(params.seed) + "\nseeds: " + std::to_string(params.seeds) + "\nways:\n";
  for (const std::string& way : params.ways) text += "  - " + nlohmann::json(way).dump() + "\n";
  return text;
}

ClerentinExperiment reproduce(const ClerentinParams& params) {
  Progress progress("reproducing clerentin");
  return reproduce_clerentin(params, [&](double share) {
    Interruptible::check();
    progress.update(share);
  });
}

/// Leaves report.txt, report.json, config.yaml and the pictures, all or nothing.
ClerentinExperiment reproduce_into_folder(const ClerentinOptions& o) {
  datasets::StagedFolder folder = results::stage_results(o.out, o.force);
  std::optional<PictureFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, o.out, folder.path(), o.force);
  ClerentinExperiment experiment = reproduce(o.params);
  results::write_text(folder.path() / "config.yaml", config_text(o.params));
  results::write_text(folder.path() / "report.txt", to_text(experiment));
  results::write_text(folder.path() / "report.json", to_json(experiment).dump(1) + "\n");
  if (pictures) draw_pictures(experiment, pictures->path());
  Interruptible::check();
  if (pictures) pictures->publish();
  folder.commit();
  return experiment;
}

void execute(const ClerentinOptions& o) {
  const Interruptible interruptible;
  const ClerentinExperiment experiment = o.out.empty() ? reproduce(o.params) : reproduce_into_folder(o);
  if (o.format.json()) {
    print(to_json(experiment));
    return;
  }
  std::printf("%s", to_text(experiment).c_str());
  if (!o.out.empty()) std::printf("results: %s\n", o.out.c_str());
  if (!o.pictures.empty()) std::printf("pictures: %s\n", o.pictures.c_str());
}

}  // namespace

void add_reproduce_clerentin(CLI::App& reproduce) {
  CLI::App* command = reproduce.add_subcommand(
      "clerentin", "Clerentin et al., An uncertainty propagation architecture for the localization problem.");
  command->footer(
      "  credo reproduce clerentin                                        the table, ten random seeds\n"
      "  credo reproduce clerentin --seeds 1 --pictures results/clerentin/pictures --out results/clerentin\n"
      "  credo reproduce clerentin --ways corridor_end,corridor_end_2     a second way that turns on the spot");
  auto o = std::make_shared<ClerentinOptions>();
  command->add_option("--seed", o->params.seed, "of the first simulation")->check(any_seed())->capture_default_str();
  command->add_option("--seeds", o->params.seeds, "how many simulations, each with a seed of its own")
      ->check(number_in(1, 1000))
      ->capture_default_str();
  command->add_option("--ways", o->params.ways, "the worlds that the ways are in: files, or names that come with credo")
      ->delimiter(',')
      ->check(a_path())
      ->capture_default_str();
  CLI::Option* out =
      command->add_option("-o,--out", o->out, "folder for the report; without it, it is printed only")->check(a_path());
  command->add_option("--pictures", o->pictures, "folder for pictures of ways, beliefs and tracks; goes with --out")
      ->check(a_path())
      ->needs(out);
  command->add_flag("-f,--force", o->force, "replace results that are already there");
  add_format_option(*command, o->format);
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
