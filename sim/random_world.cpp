// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/random_world.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "geometry/segment.hpp"
#include "sim/free_space.hpp"
#include "sim/passage.hpp"
#include "sim/presets.hpp"
#include "sim/random.hpp"
#include "sim/random_building.hpp"

namespace credo::sim {
namespace {

using Point = Eigen::Vector2d;

constexpr int kMostBuildings = 200;
constexpr int kMostWays = 8;               // tried in one building
constexpr int kMostLegs = 40;              // of a way
constexpr double kOffWallsOnWay_m = 0.05;  // of the robot's side, on its way
constexpr double kStoppingRoom_m = 0.45;

constexpr std::array<std::pair<BuildingKind, std::string_view>, 8> kNames{
    {{BuildingKind::kCorridor, "corridor"},
     {BuildingKind::kOffices, "offices"},
     {BuildingKind::kHall, "hall"},
     {BuildingKind::kTwoHalls, "two_halls"},
     {BuildingKind::kLShape, "l_shape"},
     {BuildingKind::kTShape, "t_shape"},
     {BuildingKind::kModules, "modules"},
     {BuildingKind::kSymmetricRoom, "symmetric_room"}}};
constexpr std::uint64_t kUnambiguous = 6;  // the first ones of them

void add_sensors(const RandomWorldParams& params, Random& random, World& world) {
  static constexpr const char* kSold[] = {"opensimple", "rplidar-a1", "lds-neato"};
  const bool continuous = params.mode ? *params.mode == Drive::Mode::kContinuous : random.chance(0.4);
  const std::string drawn = kSold[random.bits() % 3];
  world.drive.mode = continuous ? Drive::Mode::kContinuous : Drive::Mode::kStopAndGo;
  world.drive.turn_radius_m = 0.35;
  world.camera = camera_preset("conic-640");
  world.camera->camera.azimuth_zero_rad = random.uniform(-3.0, 3.0);
  world.camera->rate_hz = continuous ? 1.5 : 0.0;
  RangeFinderSetup range = range_finder_preset(params.range_preset.value_or(drawn));
  range.finder.T_base_sensor.x = random.uniform(0.0, 0.08);
  range.rate_hz = continuous ? std::min(5.0, 1.0 / range.finder.scan_time_s) : 0.0;
  world.drive.pause_s = std::max(0.6, range.finder.scan_time_s + 0.2);
  world.range_finders = {range};
  world.odometry = OdometrySetup{.noise = {}, .rate_hz = 20.0};
  state_accuracy(world);
}

void add_light(Random& random, World& world) {
  world.materials = common_materials();
  world.ceiling_m = random.uniform(2.5, 2.9);
  world.light_rad = random.uniform(0.0, 1.5);
  world.floor_albedo = random.uniform(0.3, 0.5);
  world.floor_tile_m = random.chance(0.4) ? 0.5 : 0.0;
  world.lamps.spacing_m = random.uniform(2.2, 3.0);
}

double length_of(const std::vector<Point>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

bool is_inside(const std::vector<Point>& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// The places with room around them, room by room; rooms that cannot be entered are left out.
std::vector<std::vector<Point>> places_by_room(const Layout& layout, const FreeSpace& space) {
  std::vector<std::vector<Point>> rooms;
  const std::vector<Point> places = space.places(kStoppingRoom_m);
  for (const Room& room : layout.rooms) {
    std::vector<Point> inside;
    std::copy_if(places.begin(), places.end(), std::back_inserter(inside),
                 [&](const Point& place) { return is_inside(room.outline, place); });
    if (!inside.empty()) rooms.push_back(std::move(inside));
  }
  return rooms;
}

/// The first part of a way.
std::vector<Point> first_part(const std::vector<Point>& way, double length_m) {
  std::vector<Point> part{way.front()};
  for (std::size_t i = 1; i < way.size() && length_m > 1e-6; ++i) {
    const double leg = (way[i] - way[i - 1]).norm();
    part.push_back(way[i - 1] + std::min(1.0, length_m / leg) * (way[i] - way[i - 1]));
    length_m -= leg;
  }
  return part;
}

/// How many rooms a way goes through.
std::size_t rooms_on(const std::vector<Point>& way, const Layout& layout) {
  constexpr int kLooks = 8;  // at every leg
  return static_cast<std::size_t>(std::count_if(layout.rooms.begin(), layout.rooms.end(), [&](const Room& room) {
    for (std::size_t i = 1; i < way.size(); ++i)
      for (int k = 0; k <= kLooks; ++k)
        if (is_inside(room.outline, way[i - 1] + (way[i] - way[i - 1]) * (static_cast<double>(k) / kLooks)))
          return true;
    return false;
  }));
}

/// From room to room, each time into another one, until it is long enough; empty where no way leads on.
std::vector<Point> draw_way(const std::vector<std::vector<Point>>& rooms, const FreeSpace& space, double length_m,
                            Random& random) {
  const auto draw = [&](const std::vector<Point>& places) { return places[random.bits() % places.size()]; };
  std::size_t room = random.bits() % rooms.size();
  std::vector<Point> way{draw(rooms[room])};
  for (int i = 0; i < kMostLegs && length_of(way) < length_m; ++i) {
    if (rooms.size() > 1) room = (room + 1 + random.bits() % (rooms.size() - 1)) % rooms.size();
    const std::vector<Point> legs = space.route(way.back(), draw(rooms[room]));
    if (!legs.empty()) way.insert(way.end(), legs.begin() + 1, legs.end());
  }
  return length_of(way) < length_m ? std::vector<Point>{} : first_part(way, length_m);
}

/// Somewhere in the room that the others are entered from.
std::optional<Point> draw_start(const Layout& layout, Random& random) {
  const std::vector<Point>& outline = layout.rooms.front().outline;
  const std::size_t corner = random.bits() % outline.size();
  const geometry::Segment wall{outline[corner], outline[(corner + 1) % outline.size()]};
  const Point start = wall.centre() + 0.6 * wall.normal();
  return is_inside(outline, start) ? std::optional(start) : std::nullopt;
}

bool give_way(const Layout& layout, const RandomWorldParams& params, Random& random, World& world) {
  const std::optional<Point> start = draw_start(layout, random);
  if (!start) return false;
  const FreeSpace space(world, {world.robot_radius_m + kOffWallsOnWay_m, height_of_robot(world)}, *start);
  const auto rooms = places_by_room(layout, space);
  const std::size_t several = std::min<std::size_t>(layout.rooms.size(), 3);
  if (rooms.size() < several) return false;
  for (int i = 0; i < kMostWays; ++i) {
    world.path.clear();
    const double length = random.uniform(params.shortest_way_m, params.longest_way_m);
    const std::vector<Point> way = draw_way(rooms, space, length, random);
    if (rooms_on(way, layout) < several) continue;
    for (const Point& place : way) world.path.push_back({place});
    if (!find_obstruction(world, Trajectory(world.path, world.drive))) return true;
  }
  return false;
}

}  // namespace

World random_world(std::uint64_t seed, const RandomWorldParams& params) {
  for (std::uint64_t attempt = 0; attempt < kMostBuildings; ++attempt) {
    Random random(seed, kBuildingStream, attempt);
    const BuildingKind drawn = kNames[random.bits() % kUnambiguous].first;
    const BuildingKind kind = params.kind.value_or(drawn);
    World world;
    world.name = "random_" + std::string(name_of(kind)) + "_" + std::to_string(seed);
    world.description = "A building drawn at random: " + std::string(name_of(kind)) + " (simulated)";
    add_light(random, world);
    add_sensors(params, random, world);
    const Layout layout = draw_layout(kind, random);
    try {
      build(layout, kind, random, world);
    } catch (const std::invalid_argument&) {
      continue;  // a door does not fit: another building
    }
    if (give_way(layout, params, random, world)) return world;
  }
  throw std::invalid_argument("no building has room for a way of " + std::to_string(params.shortest_way_m) + " to " +
                              std::to_string(params.longest_way_m) + " m");
}

std::string_view name_of(BuildingKind kind) {
  for (const auto& [known, name] : kNames)
    if (known == kind) return name;
  return "";
}

BuildingKind building_kind(std::string_view name) {
  std::string all;
  for (const auto& [kind, known] : kNames) {
    if (known == name) return kind;
    all += " " + std::string(known);
  }
  throw std::invalid_argument("unknown kind of building '" + std::string(name) + "': one of" + all);
}

const std::vector<BuildingKind>& building_kinds() {
  static const std::vector<BuildingKind> kinds = [] {
    std::vector<BuildingKind> all;
    for (const auto& entry : kNames) all.push_back(entry.first);
    return all;
  }();
  return kinds;
}

}  // namespace credo::sim
