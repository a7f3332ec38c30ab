// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "sim/building.hpp"
#include "sim/failures.hpp"
#include "sim/passage.hpp"
#include "sim/presets.hpp"
#include "sim/rearrangement.hpp"
#include "sim/world.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {
namespace {

/// Runs `build`, which knows no file, and says where its complaint belongs.
void placed(const YamlMap& map, const std::string& key, const std::function<void()>& build) {
  try {
    build();
  } catch (const std::invalid_argument& error) {
    map.fail(key, error.what());
  }
}

double not_negative(YamlMap& map, const std::string& key, double fallback) {
  return map.number_within(key, fallback, 0.0, YamlMap::kLargest);
}

double positive(YamlMap& map, const std::string& key, double fallback, double least = 1e-4) {
  return map.number_within(key, fallback, least, YamlMap::kLargest);
}

double share(YamlMap& map, const std::string& key, double fallback) {
  return map.number_within(key, fallback, 0.0, 1.0);
}

constexpr double kFastest_hz = 1000.0;
double rate(YamlMap& map, double fallback) { return map.number_within("rate", fallback, 0.0, kFastest_hz); }

void read_heights(YamlMap& map, double& z0, double& z1) {
  if (!map.has("z")) return;
  const std::vector<double> z = map.numbers("z", 2);
  if (z[0] < 0.0 || z[1] <= z[0]) map.fail("z", "'z' must be [lower, upper] in metres, 0 <= lower < upper");
  z0 = z[0];
  z1 = z[1];
}

geometry::Pose2 read_pose(YamlMap& map, const geometry::Pose2& fallback) {
  if (!map.has("pose")) return fallback;
  const std::vector<double> p = map.numbers("pose", 3);
  return {p[0], p[1], p[2]};
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

void read_boxes(YamlMap& building, const World& world, Builder& builder) {
  for (YamlMap& map : building.maps("boxes")) {
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
  read_boxes(building, world, builder);
  read_moves(building, world);
  building.close();
  check_size(building, world);
}

void read_drive(YamlMap map, Drive& drive) {
  const std::string mode = map.text("mode", "stop_and_go");
  if (mode != "stop_and_go" && mode != "continuous") map.fail("mode", "'mode' must be stop_and_go or continuous");
  drive.mode = mode == "continuous" ? Drive::Mode::kContinuous : Drive::Mode::kStopAndGo;
  drive.step_m = positive(map, "step", drive.step_m, 0.01);
  drive.pause_s = map.number_within("pause", drive.pause_s, 0.01, 3600.0);
  drive.speed_mps = positive(map, "speed", drive.speed_mps, 0.01);
  drive.acceleration_mps2 = positive(map, "acceleration", drive.acceleration_mps2, 0.01);
  drive.turn_speed_radps = positive(map, "turn_speed", drive.turn_speed_radps, 0.01);
  drive.turn_radius_m = positive(map, "turn_radius", drive.turn_radius_m);
  map.close();
}

/// Where each waypoint stands: "file:line".
using PathSource = std::vector<std::string>;

/// Waypoints [x, y], or {carried_to: [x, y], turn: rad} where the robot is set down.
PathSource read_path(YamlMap& top, World& world, const std::string& file) {
  PathSource source;
  const YAML::Node path = top.child("path");
  if (!path.IsDefined() || !path.IsSequence() || path.size() < 2)
    top.fail("path", "'path' must be a list of at least two waypoints [x, y]");
  for (const YAML::Node& item : path) {
    source.push_back(file + ":" + std::to_string(item.Mark().line + 1));
    if (item.IsSequence()) {
      const std::vector<double> p = top.numbers_of(item, 2, "path");
      world.path.push_back({{p[0], p[1]}, false});
    } else {
      YamlMap map(item, file, "a waypoint");
      Waypoint waypoint{map.point("carried_to"), true};
      if (map.has("turn")) waypoint.turn_rad = map.number("turn");
      world.path.push_back(waypoint);
      map.close();
    }
  }
  if (world.path.front().carried_here)
    top.fail("path", "the first waypoint is where the robot starts: it cannot be carried there");
  return source;
}

CameraSetup read_camera(YamlMap map) {
  CameraSetup setup;
  placed(map, "preset", [&] { setup = camera_preset(map.text("preset", "conic-640")); });
  sensors::OmniCamera& camera = setup.camera;
  camera.T_base_camera = read_pose(map, camera.T_base_camera);
  camera.height_m = positive(map, "height", camera.height_m);
  camera.azimuth_zero_rad = map.number("azimuth_zero", camera.azimuth_zero_rad);
  camera.azimuth_sign = map.integer_within("azimuth_sign", camera.azimuth_sign, -1, 1);
  if (camera.azimuth_sign == 0) map.fail("azimuth_sign", "'azimuth_sign' must be 1 or -1");
  camera.exposure_s = map.number_within("exposure", camera.exposure_s, 0.0, 60.0);
  if (map.has("center")) camera.center_px = map.point("center");
  if (!map.flag("rim_visible", true)) camera.rim_radius_px.reset();
  setup.rate_hz = rate(map, setup.rate_hz);
  setup.strut_width_px = not_negative(map, "strut_width", setup.strut_width_px);
  if (map.has("struts")) {
    const YAML::Node struts = map.child("struts");
    setup.struts_rad = map.numbers_of(struts, struts.size(), "struts");
  }
  map.close();
  return setup;
}

RangeFinderSetup read_range_finder(YamlMap& map) {
  RangeFinderSetup setup;
  placed(map, "preset", [&] { setup = range_finder_preset(map.text("preset", "opensimple")); });
  sensors::RangeFinder& finder = setup.finder;
  finder.T_base_sensor = read_pose(map, finder.T_base_sensor);
  finder.height_m = not_negative(map, "height", finder.height_m);
  finder.noise.sigma_0_m = positive(map, "sigma_0", finder.noise.sigma_0_m);
  finder.noise.k_per_m = not_negative(map, "k", finder.noise.k_per_m);
  const double field = finder.angle_increment_rad * finder.count;
  finder.count = map.integer_within("count", finder.count, 1, 100'000);
  finder.angle_increment_rad = field / finder.count;
  finder.range_min_m = not_negative(map, "range_min", finder.range_min_m);
  finder.range_max_m = positive(map, "range_max", finder.range_max_m);
  finder.scan_time_s = map.number_within("scan_time", finder.scan_time_s, 0.0, 60.0);
  setup.rate_hz = rate(map, setup.rate_hz);
  setup.spot_m = not_negative(map, "spot", setup.spot_m);
  setup.spot_rad = not_negative(map, "spot_growth", setup.spot_rad);
  setup.bias_per_m = not_negative(map, "bias", setup.bias_per_m);
  setup.outlier_share = share(map, "outlier_share", setup.outlier_share);
  setup.faintest = not_negative(map, "faintest", setup.faintest);
  map.close();
  return setup;
}

SonarSetup read_sonar(YamlMap& map) {
  SonarSetup setup;
  placed(map, "preset", [&] { setup = sonar_preset(map.text("preset", "pioneer-16")); });
  setup.ring.height_m = not_negative(map, "height", setup.ring.height_m);
  setup.ring.beam_width_rad = positive(map, "beam_width", setup.ring.beam_width_rad);
  setup.ring.range_min_m = not_negative(map, "range_min", setup.ring.range_min_m);
  setup.ring.range_max_m = positive(map, "range_max", setup.ring.range_max_m);
  setup.ring.sigma_m = not_negative(map, "sigma", setup.ring.sigma_m);
  setup.rate_hz = map.number_within("rate", setup.rate_hz, 0.01, kFastest_hz);
  setup.cross_talk_share = share(map, "cross_talk", setup.cross_talk_share);
  map.close();
  return setup;
}

void read_sensors(YamlMap sensors, World& world) {
  if (sensors.has("camera")) world.camera = read_camera(sensors.map("camera"));
  for (YamlMap& map : sensors.maps("range_finders")) world.range_finders.push_back(read_range_finder(map));
  for (YamlMap& map : sensors.maps("sonars")) world.sonars.push_back(read_sonar(map));
  if (sensors.has("odometry")) {
    YamlMap map = sensors.map("odometry");
    OdometrySetup setup;
    setup.rate_hz = rate(map, setup.rate_hz);
    setup.noise.translation_per_metre = not_negative(map, "translation_per_metre", setup.noise.translation_per_metre);
    setup.noise.rotation_per_metre = not_negative(map, "rotation_per_metre", setup.noise.rotation_per_metre);
    setup.noise.rotation_per_radian = not_negative(map, "rotation_per_radian", setup.noise.rotation_per_radian);
    map.close();
    world.odometry = setup;
  }
  sensors.close();
}

void read_nuisances(YamlMap map, Nuisances& nuisances) {
  nuisances.noise_grey = not_negative(map, "noise_grey", nuisances.noise_grey);
  nuisances.read_noise_grey = not_negative(map, "read_noise_grey", nuisances.read_noise_grey);
  nuisances.pixel_gain = not_negative(map, "pixel_gain", nuisances.pixel_gain);
  nuisances.blur_px = map.number_within("blur", nuisances.blur_px, 0.0, 100.0);
  nuisances.center_px = not_negative(map, "center", nuisances.center_px);
  nuisances.tilt_rad = not_negative(map, "tilt", nuisances.tilt_rad);
  nuisances.mounting_m = not_negative(map, "mounting", nuisances.mounting_m);
  nuisances.mounting_rad = not_negative(map, "mounting_angle", nuisances.mounting_rad);
  nuisances.dust = map.integer_within("dust", nuisances.dust, 0, 10'000);
  nuisances.glare = not_negative(map, "glare", nuisances.glare);
  map.close();
}

Failure::Kind read_failure_kind(YamlMap& map) {
  static const std::map<std::string, Failure::Kind> kKinds{
      {"blind", Failure::Kind::kBlind},        {"frozen", Failure::Kind::kFrozen},
      {"noisy", Failure::Kind::kNoisy},        {"dark", Failure::Kind::kDark},
      {"lying", Failure::Kind::kLying},        {"slipping", Failure::Kind::kSlipping},
      {"saturated", Failure::Kind::kSaturated}};
  const auto kind = kKinds.find(map.text("kind", ""));
  if (kind == kKinds.end()) map.fail("kind", "'kind' must be blind, frozen, noisy, dark, saturated, lying or slipping");
  return kind->second;
}

void read_failures(YamlMap& top, World& world) {
  world.failures.clear();
  for (YamlMap& map : top.maps("failures")) {
    Failure failure;
    failure.sensor = map.text("sensor", failure.sensor);
    failure.kind = read_failure_kind(map);
    failure.from_s = not_negative(map, "from", failure.from_s);
    if (map.has("to")) failure.to_s = not_negative(map, "to", 0.0);
    failure.scale = positive(map, "scale", failure.scale);
    failure.offset_m = map.number("offset", failure.offset_m);
    failure.turn_rad = map.number("turn", failure.turn_rad);
    map.close();
    world.failures.push_back(failure);
    placed(map, "sensor", [&] { check_failures(world); });
  }
}

YAML::Node load_file(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file))
    throw std::runtime_error(file.string() + ": is a folder; expected a world file");
  try {
    YAML::Node node = YAML::LoadFile(file.string());
    if (node.IsNull()) throw std::runtime_error(file.string() + ": is empty; expected a world file");
    return node;
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(file.string() + ": cannot read this world file: check the path");
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ":" + std::to_string(error.mark.line + 1) +
                             ": not valid YAML: " + error.msg);
  }
}

void read_world(const std::filesystem::path& file, World& world, PathSource& path, std::set<std::string>& seen) {
  if (!seen.insert(std::filesystem::weakly_canonical(file).string()).second)
    throw std::runtime_error(file.string() + ":1: a world cannot extend itself");
  YamlMap top(load_file(file), file.string(), "the world");
  if (top.text("format", "") != "credo-world/1") top.fail("format", "'format' must be credo-world/1");
  const bool extends = top.has("extends");
  if (extends) read_world(file.parent_path() / top.text("extends", ""), world, path, seen);
  world.name = top.text("name", file.stem().string());
  world.description = top.text("description", world.description);
  if (!extends || top.has("building")) {
    world.panels.clear();
    world.only_planned.clear();
    world.marks.clear();
    world.areas.clear();
    read_building(top.map("building"), world);
  }
  world.plan_uncertainty_m = not_negative(top, "plan_uncertainty", world.plan_uncertainty_m);
  world.clutter_share = share(top, "clutter", world.clutter_share);
  world.people = top.integer_within("people", world.people, 0, 100);
  world.robot_radius_m = positive(top, "robot_radius", world.robot_radius_m);
  if (top.has("drive")) read_drive(top.map("drive"), world.drive);
  if (!extends || top.has("path")) {
    world.path.clear();
    path = read_path(top, world, file.string());
  }
  world.initial_pose_known = top.flag("initial_pose_known", world.initial_pose_known);
  if (top.has("initial_pose_sigma")) {
    const std::vector<double> sigma = top.numbers("initial_pose_sigma", 3);
    if (*std::min_element(sigma.begin(), sigma.end()) <= 0.0)
      top.fail("initial_pose_sigma", "'initial_pose_sigma' must be three numbers larger than 0");
    world.initial_pose_sigma = {sigma[0], sigma[1], sigma[2]};
  }
  if (top.has("initial_pose_offset")) {
    const std::vector<double> offset = top.numbers("initial_pose_offset", 3);
    world.initial_pose_offset = {offset[0], offset[1], offset[2]};
  }
  if (!extends || top.has("sensors")) {
    world.camera.reset();
    world.range_finders.clear();
    world.sonars.clear();
    world.odometry.reset();
    read_sensors(top.map("sensors"), world);
    if (!world.camera && world.range_finders.empty() && world.sonars.empty())
      top.fail("sensors", "the robot needs a camera, a range finder or a sonar ring");
  }
  if (top.has("nuisances")) read_nuisances(top.map("nuisances"), world.nuisances);
  if (top.has("failures")) read_failures(top, world);
  top.close();
}

void check_path(const World& world, const PathSource& path) {
  std::optional<Obstruction> obstruction;
  try {
    obstruction = find_obstruction(world, Trajectory(world.path, world.drive));
  } catch (const std::invalid_argument& error) {
    obstruction = {0, error.what()};
  }
  if (obstruction) throw std::runtime_error(path[obstruction->waypoint] + ": " + obstruction->what);
}

}  // namespace

World load_world(const std::filesystem::path& file) {
  World world;
  PathSource path;
  std::set<std::string> seen;
  read_world(file, world, path, seen);
  check_path(world, path);
  state_accuracy(world);
  return world;
}

}  // namespace credo::sim
