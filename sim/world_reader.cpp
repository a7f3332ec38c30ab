// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/building_reader.hpp"
#include "sim/change_reader.hpp"
#include "sim/failures.hpp"
#include "sim/lanes.hpp"
#include "sim/passage.hpp"
#include "sim/presets.hpp"
#include "sim/sensor_reader.hpp"
#include "sim/world.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {
namespace {

Drive read_drive(YamlMap map) {
  Drive drive;
  const std::string mode = map.text("mode", "stop_and_go");
  if (mode != "stop_and_go" && mode != "continuous") map.fail("mode", "'mode' must be stop_and_go or continuous");
  drive.mode = mode == "continuous" ? Drive::Mode::kContinuous : Drive::Mode::kStopAndGo;
  drive.step_m = positive(map, "step", drive.step_m, 0.01);
  drive.pause_s = map.number_within("pause", drive.pause_s, 0.01, 3600.0);
  drive.speed_mps = positive(map, "speed", drive.speed_mps, 0.01);
  drive.acceleration_mps2 = positive(map, "acceleration", drive.acceleration_mps2, 0.01);
  drive.turn_speed_radps = positive(map, "turn_speed", drive.turn_speed_radps, 0.01);
  drive.turn_radius_m = positive(map, "turn_radius", drive.turn_radius_m);
  if (map.has("duration")) drive.duration_s = map.number_within("duration", 0.0, 0.01, YamlMap::kLargest);
  map.close();
  return drive;
}

/// What can be read only where all else is known; a world that extends another may replace it as a whole.
struct Pending {
  std::vector<std::string> waypoints;  ///< "file:line" of each
  std::optional<YamlMap> lanes;        ///< instead of waypoints
  std::vector<YamlMap> changes;
};

/// Waypoints [x, y], or {carried_to: [x, y], turn: rad} where the robot is set down; or {lanes: ...}.
void read_path(YamlMap& top, World& world, const std::string& file, Pending& pending) {
  world.path.clear();
  pending.waypoints.clear();
  pending.lanes.reset();
  const YAML::Node path = top.child("path");
  if (path.IsDefined() && path.IsMap()) {
    YamlMap map(path, file, "the path");
    pending.lanes = map.map("lanes");
    return map.close();
  }
  if (!path.IsDefined() || !path.IsSequence() || path.size() < 2)
    top.fail("path", "'path' must be a list of at least two waypoints [x, y], or {lanes: ...}");
  for (const YAML::Node& item : path) {
    pending.waypoints.push_back(file + ":" + std::to_string(item.Mark().line + 1));
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

void replace_building(YamlMap& top, World& world) {
  world.panels.clear();
  world.only_planned.clear();
  world.marks.clear();
  world.areas.clear();
  world.leaves.clear();
  read_building(top.map("building"), world);
}

void replace_sensors(YamlMap& top, World& world) {
  world.camera.reset();
  world.range_finders.clear();
  world.sonars.clear();
  world.odometry.reset();
  read_sensors(top.map("sensors"), world);
  if (!world.camera && world.range_finders.empty() && world.sonars.empty())
    top.fail("sensors", "the robot needs a camera, a range finder or a sonar ring");
}

void read_initial_pose(YamlMap& top, World& world) {
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
}

void read_world(const std::filesystem::path& file, World& world, Pending& pending, std::set<std::string>& seen) {
  if (!seen.insert(std::filesystem::weakly_canonical(file).string()).second)
    throw std::runtime_error(file.string() + ":1: a world cannot extend itself");
  YamlMap top(load_file(file), file.string(), "the world");
  if (top.text("format", "") != "credo-world/1") top.fail("format", "'format' must be credo-world/1");
  const bool extends = top.has("extends");
  if (extends) read_world(file.parent_path() / top.text("extends", ""), world, pending, seen);
  world.name = top.text("name", file.stem().string());
  world.description = top.text("description", world.description);
  if (!extends || top.has("building")) replace_building(top, world);
  world.plan_uncertainty_m = not_negative(top, "plan_uncertainty", world.plan_uncertainty_m);
  world.clutter_share = share(top, "clutter", world.clutter_share);
  world.people = top.integer_within("people", world.people, 0, 100);
  world.robot_radius_m = positive(top, "robot_radius", world.robot_radius_m);
  if (top.has("drive")) world.drive = read_drive(top.map("drive"));
  if (!extends || top.has("path")) read_path(top, world, file.string(), pending);
  if (top.has("changes")) pending.changes = top.maps("changes");
  read_initial_pose(top, world);
  if (!extends || top.has("sensors")) replace_sensors(top, world);
  if (top.has("nuisances")) read_nuisances(top.map("nuisances"), world.nuisances);
  if (top.has("failures")) read_failures(top, world);
  top.close();
}

std::vector<Waypoint> read_lanes(YamlMap map, const World& world) {
  Lanes lanes;
  lanes.start = map.point("start");
  lanes.heading_rad = map.number("heading", lanes.heading_rad);
  lanes.spacing_m = positive(map, "spacing", lanes.spacing_m, 0.1);
  lanes.margin_m = not_negative(map, "margin", lanes.margin_m);
  map.close();
  std::vector<Waypoint> path;
  placed(map, "start", [&] { path = sweep_in_lanes(world, lanes); });
  return path;
}

void check_path(const World& world, const Pending& pending) {
  std::optional<Obstruction> obstruction;
  try {
    obstruction = find_obstruction(world, Trajectory(world.path, world.drive));
  } catch (const std::invalid_argument& error) {
    obstruction = {0, error.what()};
  }
  if (!obstruction) return;
  if (pending.lanes) pending.lanes->fail("start", obstruction->what + ", or the 'margin' of the lanes larger");
  throw std::runtime_error(pending.waypoints[obstruction->waypoint] + ": " + obstruction->what);
}

/// What changes after the drive is over, nobody sees.
void check_changes(const World& world, const Pending& pending) {
  const double duration_s = Trajectory(world.path, world.drive).duration_s();
  for (std::size_t i = 0; i < world.changes.size(); ++i)
    if (world.changes[i].when_s >= duration_s)
      pending.changes[i].fail("when",
                              "the drive is over after " + std::to_string(duration_s) + " s: let things change before");
}

}  // namespace

World load_world(const std::filesystem::path& file) {
  World world;
  Pending pending;
  std::set<std::string> seen;
  read_world(file, world, pending, seen);
  read_changes(pending.changes, world);
  if (pending.lanes) world.path = read_lanes(*pending.lanes, world);
  check_path(world, pending);
  check_changes(world, pending);
  state_accuracy(world);
  return world;
}

}  // namespace credo::sim
