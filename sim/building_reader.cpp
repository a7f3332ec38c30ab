// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/building_reader.hpp"

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sim/rearrangement.hpp"

namespace credo::sim {
namespace {

void read_heights(YamlMap& map, double& z0, double& z1) {
  if (!map.has("z")) return;
  const std::vector<double> z = map.numbers("z", 2);
  if (z[0] < 0.0 || z[1] <= z[0]) map.fail("z", "'z' must be [lower, upper] in metres, 0 <= lower < upper");
  z0 = z[0];
  z1 = z[1];
}

void read_materials(YamlMap& building, World& world) {
  for (YamlMap& map : building.maps("materials")) {
    Material material;
    material.name = map.text("name", "");
    if (material.name.empty()) map.fail("name", "a material needs a 'name'");
    material.albedo = not_negative(map, "albedo", material.albedo);
    material.emission = not_negative(map, "emission", material.emission);
    const std::string pattern = map.text("pattern", "plain");
    if (pattern != "plain" && pattern != "stripes" && pattern != "books")
      map.fail("pattern", "'pattern' must be plain, stripes or books");
    material.pattern = pattern == "stripes" ? Pattern::kStripes
                       : pattern == "books" ? Pattern::kBooks
                                            : Pattern::kPlain;
    material.period_m = positive(map, "period", material.period_m);
    material.contrast = not_negative(map, "contrast", material.contrast);
    material.skirting = map.flag("skirting", false);
    material.infrared = not_negative(map, "infrared", material.infrared);
    material.miss_share = share(map, "miss_share", 0.0);
    material.sonar_critical_rad = positive(map, "sonar_critical", material.sonar_critical_rad);
    map.close();
    // Names are found from the front: a world may redefine a common material.
    world.materials.insert(world.materials.begin(), material);
  }
}

void read_solids(YamlMap& building, World& world, Builder& builder) {
  for (YamlMap& map : building.maps("rooms")) {
    const auto outline = map.points("outline");
    if (outline.size() < 3) map.fail("outline", "a room needs at least 3 corners");
    placed(map, "outline", [&] { builder.add_walls(outline, true, map.text("material", "wall"), true); });
    map.close();
    world.areas.push_back(outline);
  }
  for (YamlMap& map : building.maps("walls")) {
    const auto points = map.points("points");
    placed(map, "points", [&] {
      builder.add_walls(points, map.flag("closed", false), map.text("material", "wall"), map.flag("in_plan", true));
    });
    map.close();
    if (!world.areas.empty() && points.size() > 2) world.areas.push_back(points);  // a yard beside the rooms
  }
  for (YamlMap& map : building.maps("pillars")) {
    placed(map, "at", [&] {
      builder.add_pillar(map.point("at"), positive(map, "radius", 0.25), map.integer_within("sides", 16, 3, 360),
                         map.number("turn", 0.0), map.text("material", "concrete"), map.flag("in_plan", true));
    });
    map.close();
  }
}

void read_doors(YamlMap& building, Builder& builder) {
  for (YamlMap& map : building.maps("doors")) {
    Door door;
    door.at = map.point("at");
    const std::string kind = map.text("kind", "closed");
    if (kind != "closed" && kind != "opening") map.fail("kind", "'kind' must be closed or opening");
    door.kind = kind == "closed" ? Door::Kind::kClosed : Door::Kind::kOpening;
    door.width_m = positive(map, "width", door.width_m);
    door.height_m = positive(map, "height", door.height_m);
    door.frame_m = not_negative(map, "frame", door.frame_m);
    door.planned_closed = map.flag("planned_closed", door.planned_closed);
    if (map.has("leaf")) door.leaf_rad = map.number("leaf");
    door.material = map.text("material", door.material);
    placed(map, "at", [&] { builder.add_door(door); });
    map.close();
  }
}

void read_overlays(YamlMap& building, const std::string& key, const Overlay& defaults, Builder& builder) {
  for (YamlMap& map : building.maps(key)) {
    Overlay overlay = defaults;
    overlay.at = map.point("at");
    overlay.width_m = positive(map, "width", overlay.width_m);
    overlay.frame_m = not_negative(map, "frame", overlay.frame_m);
    overlay.marked = map.flag("marked", overlay.marked);
    overlay.material = map.text("material", overlay.material);
    read_heights(map, overlay.z0_m, overlay.z1_m);
    placed(map, "at", [&] { builder.add_overlay(overlay); });
    map.close();
  }
}

void read_fixtures(YamlMap& building, const std::string& key, const Fixture& defaults, Builder& builder) {
  for (YamlMap& map : building.maps(key)) {
    Fixture fixture = defaults;
    fixture.at = map.point("at");
    fixture.width_m = positive(map, "width", fixture.width_m);
    fixture.depth_m = positive(map, "depth", fixture.depth_m);
    fixture.in_plan = map.flag("in_plan", fixture.in_plan);
    fixture.material = map.text("material", fixture.material);
    read_heights(map, fixture.z0_m, fixture.z1_m);
    placed(map, "at", [&] { builder.add_fixture(fixture); });
    map.close();
  }
}

void read_light(YamlMap& building, World& world) {
  world.ceiling_m = positive(building, "ceiling", world.ceiling_m);
  world.skirting_m = not_negative(building, "skirting", world.skirting_m);
  world.light_rad = building.number("light", world.light_rad);
  world.exposure_gain = positive(building, "exposure_gain", world.exposure_gain);
  if (building.has("floor")) {
    YamlMap floor = building.map("floor");
    world.floor_albedo = not_negative(floor, "albedo", world.floor_albedo);
    world.floor_tile_m = not_negative(floor, "tile", world.floor_tile_m);
    floor.close();
  }
  if (building.has("lamps")) {
    YamlMap lamps = building.map("lamps");
    world.lamps.spacing_m = not_negative(lamps, "spacing", world.lamps.spacing_m);
    world.lamps.length_m = not_negative(lamps, "length", world.lamps.length_m);
    world.lamps.width_m = not_negative(lamps, "width", world.lamps.width_m);
    world.lamps.emission = not_negative(lamps, "emission", world.lamps.emission);
    lamps.close();
  }
}

void read_moves(YamlMap& building, World& world) {
  for (YamlMap& map : building.maps("moved")) {
    const std::vector<double> by = map.has("by") ? map.numbers("by", 2) : std::vector<double>{0.0, 0.0};
    placed(map, "at", [&] { move_thing(world, map.point("at"), {by[0], by[1]}, map.number("turn", 0.0)); });
    map.close();
  }
}

void check_size(const YamlMap& building, const World& world) {
  constexpr double kLargest_m = 500.0;
  if (world.panels.empty()) building.fail("rooms", "the building has no walls: give it 'rooms' or 'walls'");
  Eigen::AlignedBox2d box;
  for (const Panel& panel : world.panels) box.extend(panel.a).extend(panel.b);
  if (!(box.sizes().maxCoeff() <= kLargest_m))
    building.fail("rooms", "the building is " + std::to_string(box.sizes().x()) + " x " +
                               std::to_string(box.sizes().y()) + " m; expected at most " + std::to_string(kLargest_m) +
                               " m in either direction");
}

}  // namespace

void read_box(YamlMap& map, const World& world, Builder& builder) {
  double z0 = 0.0, z1 = world.ceiling_m;
  read_heights(map, z0, z1);
  const std::vector<double> size = map.numbers("size", 2);
  if (size[0] <= 0.0 || size[1] <= 0.0) map.fail("size", "'size' must be two lengths larger than 0");
  placed(map, "at", [&] {
    builder.add_box(map.point("at"), {size[0], size[1]}, map.number("turn", 0.0), z0, z1,
                    map.text("material", "cabinet"), map.flag("in_plan", false));
  });
  map.close();
}

void read_building(YamlMap building, World& world) {
  world.materials = common_materials();
  read_light(building, world);
  read_materials(building, world);
  Builder builder(world);
  read_solids(building, world, builder);
  read_doors(building, builder);
  read_overlays(building, "posters", {}, builder);
  read_overlays(building, "windows",
                {.width_m = 1.3, .z0_m = 0.9, .z1_m = 2.1, .frame_m = 0.05, .marked = true, .material = "window"},
                builder);
  read_fixtures(building, "radiators", {.z0_m = 0.08, .z1_m = 0.9}, builder);
  read_fixtures(building, "shelves", {.width_m = 1.2, .depth_m = 0.3, .z1_m = 1.9, .material = "books"}, builder);
  for (YamlMap& map : building.maps("boxes")) read_box(map, world, builder);
  read_moves(building, world);
  building.close();
  check_size(building, world);
}

}  // namespace credo::sim
