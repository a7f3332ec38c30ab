// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/about.hpp"
#include "apps/evaluate.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "datasets/floor_plan_file.hpp"
#include "evaluation/map_accuracy.hpp"
#include "evaluation/plan_accuracy.hpp"
#include "evaluation/wall_continuity.hpp"
#include "grids/wall_extraction.hpp"
#include "results/map_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct MapScoreOptions {
  std::string truth, result;
  evaluation::MapAccuracyParams params;
  OutputFormat format;
};

struct MapScores {
  evaluation::MapAccuracy accuracy;
  std::optional<evaluation::WallContinuity> continuity;  ///< against a true map
  std::optional<evaluation::PlanAccuracy> plan;          ///< of the walls in it, against a floor plan
};

/// A dataset's true map and floor plan, of which one may be missing; a map_server YAML; or a floor plan.
MapScores scores_of(const MapScoreOptions& o) {
  const grids::EvidentialGrid map = results::read_map_folder(o.result);
  fs::path true_map = o.truth, true_plan;
  if (fs::is_directory(o.truth)) {
    true_map = fs::path(o.truth) / "truth_map.yaml";
    true_plan = fs::path(o.truth) / "floor_plan.yaml";
    if (!fs::exists(true_map)) true_map.clear();
    if (!fs::exists(true_plan)) true_plan.clear();
  } else if (true_map.filename() == "floor_plan.yaml") {
    std::swap(true_map, true_plan);
  }
  if (true_map.empty() && true_plan.empty())
    throw std::runtime_error(o.truth + ": has neither truth_map.yaml nor floor_plan.yaml");
  MapScores scores;
  if (!true_plan.empty()) {
    const geometry::FloorPlan plan = datasets::read_floor_plan(true_plan);
    scores.plan = evaluation::plan_accuracy(grids::extract_walls(map), plan, map);
    if (true_map.empty()) scores.accuracy = evaluation::map_accuracy(map, plan, o.params);
  }
  if (!true_map.empty()) {
    const datasets::OccupancyMap truth = datasets::read_map(true_map);
    scores.accuracy = evaluation::map_accuracy(map, truth, o.params);
    scores.continuity = evaluation::wall_continuity(grids::mass_map(map, grids::ReadOut::kDempster), truth,
                                                    {.tolerance_cells = o.params.tolerance_cells});
  }
  return scores;
}

nlohmann::ordered_json to_json(const MapScores& scores) {
  const evaluation::MapAccuracy& a = scores.accuracy;
  nlohmann::ordered_json json{{"accuracy", a.accuracy()},
                              {"observed", a.observed},
                              {"correct", a.correct},
                              {"undecided", a.undecided},
                              {"wrongly_empty", a.wrongly_empty},
                              {"wrongly_occupied", a.wrongly_occupied},
                              {"withheld", a.withheld},
                              {"surface", a.surface},
                              {"surface_found", a.surface_found},
                              {"surface_recall", a.surface_recall()}};
  if (scores.continuity)
    json["walls"] = {{"torn", scores.continuity->torn},
                     {"torn_m", scores.continuity->torn_m},
                     {"falsely_joined", scores.continuity->joined},
                     {"reached_m", scores.continuity->surface_m}};
  if (scores.plan)
    json["plan"] = {{"precision", scores.plan->precision()},
                    {"recall", scores.plan->recall()},
                    {"mean_distance_m", scores.plan->mean_distance_m},
                    {"extracted_m", scores.plan->extracted_m},
                    {"seen_m", scores.plan->seen_m}};
  return json;
}

std::string number_or_dash(double value) { return std::isfinite(value) ? fmt::format("{:.3f}", value) : "-"; }

void print_text(const MapScores& scores) {
  std::ostringstream text;
  text << scores.accuracy;
  std::printf("%s\n", text.str().c_str());
  if (const auto& walls = scores.continuity)
    std::printf("walls: %d torn (%.1f m of %.1f m that were reached), %d falsely joined\n", walls->torn, walls->torn_m,
                walls->surface_m, walls->joined);
  if (const auto& plan = scores.plan)
    std::printf("walls as a plan: precision %s of %.1f m, recall %s of %.1f m seen, mean distance %s m\n",
                number_or_dash(plan->precision()).c_str(), plan->extracted_m, number_or_dash(plan->recall()).c_str(),
                plan->seen_m, number_or_dash(plan->mean_distance_m).c_str());
}

}  // namespace

void add_evaluate_map(CLI::App& evaluate) {
  CLI::App* command = evaluate.add_subcommand(
      "map", "Map accuracy: the share of observed cells that are right, and whether walls hold.");
  command->footer(
      "  credo evaluate map datasets/office results/office\n"
      "  credo evaluate map truth_map.yaml results/office --tolerance 2");
  auto o = std::make_shared<MapScoreOptions>();
  command->add_option("TRUTH", o->truth, "a dataset folder, a map_server YAML, or a floor_plan.yaml")
      ->check(a_path())
      ->required();
  command->add_option("RESULT", o->result, "a folder with a map.cgrid, or with map.yaml and map_belief.tiff")
      ->check(a_path())
      ->required();
  command->add_option("--tolerance", o->params.tolerance_cells, "at walls, in cells")
      ->check(number_in(0, 100))
      ->capture_default_str();
  add_format_option(*command, o->format);
  command->callback([o] {
    const MapScores scores = about(o->truth + " and " + o->result, [&] { return scores_of(*o); });
    if (o->format.json())
      print(to_json(scores));
    else
      print_text(scores);
  });
}

}  // namespace credo::apps
