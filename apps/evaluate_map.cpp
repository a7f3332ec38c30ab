// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/evaluate.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "datasets/floor_plan_file.hpp"
#include "evaluation/map_accuracy.hpp"
#include "results/map_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct MapScoreOptions {
  std::string truth, result;
  evaluation::MapAccuracyParams params;
  OutputFormat format;
};

/// A dataset's true map, else its floor plan; a map_server YAML; or a floor plan.
evaluation::MapAccuracy accuracy_of(const MapScoreOptions& o) {
  const grids::EvidentialGrid map = results::read_map_folder(o.result);
  const auto against_map = [&](const fs::path& yaml) {
    return evaluation::map_accuracy(map, datasets::read_map(yaml), o.params);
  };
  const auto against_plan = [&](const fs::path& yaml) {
    return evaluation::map_accuracy(map, datasets::read_floor_plan(yaml), o.params);
  };
  const fs::path truth = o.truth;
  if (fs::is_directory(truth)) {
    if (fs::exists(truth / "truth_map.yaml")) return against_map(truth / "truth_map.yaml");
    if (fs::exists(truth / "floor_plan.yaml")) return against_plan(truth / "floor_plan.yaml");
    throw std::runtime_error(truth.string() + ": has neither truth_map.yaml nor floor_plan.yaml");
  }
  return truth.filename() == "floor_plan.yaml" ? against_plan(truth) : against_map(truth);
}

}  // namespace

void add_evaluate_map(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand("map", "Map accuracy: the share of observed cells that are right.");
  command->footer(
      "  credo evaluate map datasets/office results/office\n"
      "  credo evaluate map truth_map.yaml results/office --tolerance 2");
  auto o = std::make_shared<MapScoreOptions>();
  command->add_option("TRUTH", o->truth, "a dataset folder, a map_server YAML, or a floor_plan.yaml")
      ->check(a_path())
      ->required();
  command->add_option("RESULT", o->result, "a folder with map.yaml and map_belief.tiff")->check(a_path())->required();
  command->add_option("--tolerance", o->params.tolerance_cells, "at walls, in cells")
      ->check(number_in(0, 100))
      ->capture_default_str();
  add_format_option(*command, o->format);
  command->callback([o] {
    const evaluation::MapAccuracy a = about(o->truth + " and " + o->result, [&] { return accuracy_of(*o); });
    if (o->format.json()) {
      print(nlohmann::ordered_json{{"accuracy", a.accuracy()},
                                   {"observed", a.observed},
                                   {"correct", a.correct},
                                   {"undecided", a.undecided},
                                   {"wrongly_empty", a.wrongly_empty},
                                   {"wrongly_occupied", a.wrongly_occupied},
                                   {"withheld", a.withheld},
                                   {"surface", a.surface},
                                   {"surface_found", a.surface_found},
                                   {"surface_recall", a.surface_recall()}});
      return;
    }
    std::ostringstream text;
    text << a;
    std::printf("%s\n", text.str().c_str());
  });
}

}  // namespace credo::apps
