// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/map_region.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "datasets/floor_plan_file.hpp"
#include "datasets/grid_file.hpp"
#include "datasets/map_server.hpp"
#include "grids/wall_extraction.hpp"
#include "results/map_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct PlanOptions {
  std::string source;
  OutputFile out{.path = "floor_plan.yaml"};
  std::vector<double> region;  ///< two corners [m]; empty: the whole map
  grids::WallParams params;
  OutputFormat format;
};

/// An occupancy map as evidence: its percentages as masses, which leave some ignorance, in the frame of its own corner.
grids::EvidentialGrid to_evidence(const datasets::OccupancyMap& map) {
  constexpr double kReliability = 0.95;
  grids::EvidentialGrid grid(grids::Georeference{.resolution_m = map.resolution_m});
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double occupied = map.at(x, y) / 100.0;
      if (occupied >= 0.0)
        grid.add({x, y}, evidence::fixed_increment(evidence::GridMass::from(1.0 - occupied, occupied), kReliability));
    }
  return grid;
}

geometry::FloorPlan plan_of_occupancy(const fs::path& yaml, const grids::WallParams& params) {
  const datasets::OccupancyMap map = datasets::read_map(yaml);
  const geometry::Pose2 T_map_corner{map.origin_x_m, map.origin_y_m, map.origin_yaw_rad};
  geometry::FloorPlan plan = grids::extract_walls(to_evidence(map), params);
  for (geometry::Segment& wall : plan.walls) wall = T_map_corner * wall;
  return plan;
}

geometry::FloorPlan plan_of(const PlanOptions& o) {
  const fs::path source = o.source;
  if (!o.region.empty()) return grids::extract_walls(read_map_region(o.source, o.region), o.params);
  if (fs::is_directory(source)) return grids::extract_walls(results::read_map_folder(source), o.params);
  if (source.extension() == ".yaml") return plan_of_occupancy(source, o.params);
  return grids::extract_walls(datasets::GridFile(source).read(), o.params);
}

void execute(const PlanOptions& o) {
  require_writable(o.out);
  const geometry::FloorPlan plan = about(o.source, [&] { return plan_of(o); });
  if (plan.walls.empty())
    throw std::runtime_error(fmt::format("{}: no wall of {:g} m or more is in this map: try a lower --shortest",
                                         o.source, o.params.shortest_m));
  datasets::write_floor_plan(o.out.path, plan);
  double length_m = 0.0;
  for (const geometry::Segment& wall : plan.walls) length_m += wall.length();
  if (o.format.json()) {
    print(nlohmann::ordered_json{{"floor_plan", o.out.path}, {"walls", plan.walls.size()}, {"length_m", length_m}});
    return;
  }
  std::printf("floor plan: %s (%zu walls, %.1f m)\n", o.out.path.c_str(), plan.walls.size(), length_m);
}

}  // namespace

void add_plan(CLI::App& app) {
  CLI::App* command = app.add_subcommand("plan", "Makes a floor plan from a grid map: its walls as straight pieces.");
  command->footer(
      "  credo plan results/office_map --out floor_plan.yaml       the map of credo map or credo run\n"
      "  credo plan truth_map.yaml --out plan.yaml --shortest 0.5  any map_server map\n"
      "  credo plan site/map.cgrid --region 100 40 160 90          a part of a map that is too large for pictures");
  auto o = std::make_shared<PlanOptions>();
  command->add_option("MAP", o->source, "a results folder, a map.cgrid, or a map_server YAML")
      ->check(a_path())
      ->required();
  command->add_option("-o,--out", o->out.path, "the floor plan")->check(a_path())->capture_default_str();
  command->add_option("--shortest", o->params.shortest_m, "what is shorter is clutter [m]")
      ->check(number_in(0, 1000))
      ->capture_default_str();
  command->add_option("--bridge", o->params.bridged_m, "longest gap that is closed where nobody saw through [m]")
      ->check(number_in(0, 1000))
      ->capture_default_str();
  add_region_option(*command, o->region);
  add_force_option(*command, o->out, "a floor plan");
  add_format_option(*command, o->format);
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
