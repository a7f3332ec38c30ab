// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/degradation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/segment.hpp"
#include "sim/building.hpp"
#include "sim/free_space.hpp"
#include "sim/passage.hpp"
#include "sim/presets.hpp"
#include "sim/random.hpp"
#include "sim/random_world.hpp"
#include "sim/rearrangement.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {
namespace {

using Point = Eigen::Vector2d;
using std::numbers::pi;

constexpr int kMostDraws = 200;
constexpr double kSetDownRoom_m = 0.4;    // where the robot is set down
constexpr double kOffWallsBack_m = 0.05;  // of the robot's side, where a new way is found
constexpr double kLeastAfter_m = 6.0;     // driven after being carried

bool is_drivable(const World& world) { return !find_obstruction(world, Trajectory(world.path, world.drive)); }

double either_way(double least, double most, Random& random) {
  const double size = random.uniform(least, most);
  return random.chance(0.5) ? size : -size;
}

void clutter(World& world, Random&) { world.clutter_share = 0.3; }
void people(World& world, Random&) { world.people = 4; }

void worst_range(World& world, Random&) {
  for (RangeFinderSetup& setup : world.range_finders) {
    RangeFinderSetup worst = range_finder_preset("lab-1999");
    worst.finder.T_base_sensor = setup.finder.T_base_sensor;
    worst.finder.height_m = setup.finder.height_m;
    worst.finder.count = 128;
    worst.finder.angle_increment_rad = 2.0 * pi / worst.finder.count;
    // On the move, the head turns faster: else a scan would be smeared over half a metre.
    if (setup.rate_hz > 0.0) worst.finder.scan_time_s = std::min(worst.finder.scan_time_s, 1.0 / setup.rate_hz);
    worst.rate_hz = setup.rate_hz;
    world.drive.pause_s = std::max(world.drive.pause_s, worst.finder.scan_time_s + 0.2);
    setup = worst;
  }
  state_accuracy(world);
}

void worst(World& world, Random& random) {
  worst_range(world, random);
  clutter(world, random);
  people(world, random);
}

/// Fails for a share of the drive, from its middle part on.
Failure middle_failure(const World& world, const std::string& sensor, Failure::Kind kind, Random& random) {
  const double duration = Trajectory(world.path, world.drive).duration_s();
  const double from = random.uniform(0.3, 0.45) * duration;
  return {.sensor = sensor, .kind = kind, .from_s = from, .to_s = from + random.uniform(0.12, 0.25) * duration};
}

using Degrade = std::function<void(World&, Random&)>;

Degrade failing(const std::string& sensor, Failure::Kind kind) {
  return [sensor, kind](World& world, Random& random) {
    world.failures.push_back(middle_failure(world, sensor, kind, random));
  };
}

void both_blind(World& world, Random& random) {
  const Failure camera = middle_failure(world, "camera0", Failure::Kind::kBlind, random);
  Failure range = camera;
  range.sensor = "range0";
  world.failures.insert(world.failures.end(), {camera, range});
}

/// Too long by 8 %, turned by 5 degrees, or too long by 0.3 m.
void lying_range(World& world, Random& random) {
  Failure lie = middle_failure(world, "range0", Failure::Kind::kLying, random);
  switch (random.bits() % 3) {
    case 0: lie.scale = 1.08; break;
    case 1: lie.turn_rad = geometry::to_radians(either_way(5.0, 5.0, random)); break;
    default: lie.offset_m = 0.3; break;
  }
  world.failures.push_back(lie);
}

void lying_camera(World& world, Random& random) {
  Failure lie = middle_failure(world, "camera0", Failure::Kind::kLying, random);
  lie.turn_rad = geometry::to_radians(either_way(5.0, 5.0, random));
  world.failures.push_back(lie);
}

void odometry_slip(World& world, Random& random) {
  Failure slip = middle_failure(world, "odometry0", Failure::Kind::kSlipping, random);
  slip.to_s = slip.from_s + 2.0;
  slip.offset_m = random.uniform(0.4, 1.0);
  world.failures.push_back(slip);
}

void no_odometry(World& world, Random&) { world.odometry.reset(); }

/// Driving on, along the same way: corners as round as there is room for.
void motion_blur(World& world, Random&) {
  world.camera.value().camera.exposure_s = 0.08;
  if (world.drive.mode == Drive::Mode::kContinuous) return;
  world.drive.mode = Drive::Mode::kContinuous;
  world.camera->rate_hz = 1.5;
  for (RangeFinderSetup& setup : world.range_finders) setup.rate_hz = std::min(5.0, 1.0 / setup.finder.scan_time_s);
  while (world.drive.turn_radius_m > 0.01 && !is_drivable(world)) world.drive.turn_radius_m *= 0.5;
}

void wrong_start(World& world, Random& random) {
  const double distance = random.uniform(0.5, 2.0), direction = random.uniform(-pi, pi);
  world.initial_pose_offset = {distance * std::cos(direction), distance * std::sin(direction),
                               either_way(geometry::to_radians(15.0), geometry::to_radians(90.0), random)};
}

void unknown_start(World& world, Random&) { world.initial_pose_known = false; }

/// The way up to a place after `length_m`, which becomes its last one; and the rest of it without that place.
std::pair<std::vector<Waypoint>, std::vector<Waypoint>> cut_way(const std::vector<Waypoint>& path, double length_m) {
  std::size_t i = 1;
  for (; i + 1 < path.size(); ++i) {
    const double leg = (path[i].position - path[i - 1].position).norm();
    if (length_m < leg) break;
    length_m -= leg;
  }
  const Point& from = path[i - 1].position;
  const double leg = (path[i].position - from).norm();
  std::vector<Waypoint> before(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(i));
  before.push_back({from + std::min(1.0, length_m / leg) * (path[i].position - from)});
  return {before, {path.begin() + static_cast<std::ptrdiff_t>(i), path.end()}};
}

double length_of(const std::vector<Waypoint>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!path[i].carried_here) length += (path[i].position - path[i - 1].position).norm();
  return length;
}

/// Sets the robot down at a place that `draw` gives, from where it drives on to the rest of its way, and further where
/// that is short.
void carry(World& world, Random& random, const std::function<Waypoint(const Point& from, const FreeSpace&)>& draw) {
  const FreeSpace space(world, {world.robot_radius_m + kOffWallsBack_m, height_of_robot(world)},
                        world.path.front().position);
  const std::vector<Point> places = space.places(kSetDownRoom_m);
  const std::vector<Waypoint> path = world.path;
  for (int i = 0; i < kMostDraws && !places.empty(); ++i) {
    auto [before, rest] = cut_way(path, random.uniform(0.35, 0.6) * length_of(path));
    const Waypoint set_down = draw(before.back().position, space);
    while (length_of(rest) < kLeastAfter_m && rest.size() < 20)
      for (const Point& place : space.route(rest.back().position, places[random.bits() % places.size()]))
        rest.push_back({place});
    const std::vector<Point> back = space.route(set_down.position, rest.front().position);
    if (back.empty()) continue;
    world.path = before;
    world.path.push_back(set_down);
    for (const Point& place : back) world.path.push_back({place});
    world.path.insert(world.path.end(), rest.begin() + 1, rest.end());
    if (is_drivable(world)) return;
  }
  throw std::invalid_argument("there is nowhere in '" + world.name + "' to carry the robot to");
}

double at_least_30_degrees(Random& random) { return either_way(geometry::to_radians(30.0), pi, random); }

/// Half of the times near by, in sight of where it was; half of the times anywhere.
void kidnap(World& world, Random& random) {
  const bool near = random.chance(0.5);
  const double turn = random.chance(0.5) ? at_least_30_degrees(random) : 0.0;
  carry(world, random, [&](const Point& from, const FreeSpace& space) {
    const std::vector<Point> places = space.places(kSetDownRoom_m);
    Waypoint set_down{places[random.bits() % places.size()], true, turn};
    const auto fits = [&] {
      const double distance = (set_down.position - from).norm();
      return distance >= 1.0 && (!near || distance < 3.0);
    };
    for (int i = 0; i < kMostDraws && !fits(); ++i) set_down.position = places[random.bits() % places.size()];
    return set_down;
  });
}

void turned(World& world, Random& random) {
  const double turn = at_least_30_degrees(random);
  carry(world, random, [&](const Point& from, const FreeSpace&) { return Waypoint{from, true, turn}; });
}

/// Whether the robot comes near enough to see it well.
bool is_passed(const World& world, const Point& place) {
  constexpr double kNear_m = 3.0;
  for (std::size_t i = 1; i < world.path.size(); ++i)
    if (geometry::distance(place, {world.path[i - 1].position, world.path[i].position}) < kNear_m) return true;
  return false;
}

/// A wall between two corners of a room comes nearer by 0.2 to 0.5 m, furniture stands up to a metre off, or a new wall
/// juts out from an old one.
void moved_wall(World& world, Random& random) {
  const World before = world;
  for (int i = 0; i < kMostDraws; ++i) {
    world = before;
    const Panel& panel = before.panels[random.bits() % before.panels.size()];
    const geometry::Segment line{panel.a, panel.b};
    const Point normal = random.chance(0.5) ? line.normal() : Point(-line.normal());
    if (!panel.in_plan || !is_passed(before, line.centre())) continue;
    const bool is_wall = panel.z1_m >= before.ceiling_m && line.length() > 1.5;
    const bool is_new = is_wall && random.chance(0.3);
    if (is_new) {
      const Point foot = line.a + random.uniform(0.2, 0.8) * line.length() * line.direction();
      Builder(world).add_walls({foot, foot + random.uniform(0.8, 2.0) * normal}, false, "wall", false);
    } else {
      const double far = is_wall ? random.uniform(0.2, 0.5) : random.uniform(0.3, 1.0);
      move_thing(world, line.centre(), far * normal, is_wall ? 0.0 : random.uniform(-0.4, 0.4));
    }
    if (is_drivable(world)) return;
  }
  throw std::invalid_argument("nothing in '" + before.name + "' can be moved without standing in the robot's way");
}

/// Another building, which looks the same when turned by half a turn; where the robot starts is not told.
void symmetric(World& world, Random& random) {
  World other = random_world(random.bits() % 1'000'000, {.kind = BuildingKind::kSymmetricRoom});
  other.camera = world.camera;
  other.range_finders = world.range_finders;
  other.odometry = world.odometry;
  other.drive = world.drive;
  other.initial_pose_known = false;
  while (other.drive.turn_radius_m > 0.01 && !is_drivable(other)) other.drive.turn_radius_m *= 0.5;
  world = other;
}

const std::vector<std::pair<std::string, Degrade>>& all() {
  using Kind = Failure::Kind;
  static const std::vector<std::pair<std::string, Degrade>> degradations{
      {"nominal", [](World&, Random&) {}},
      {"clutter", clutter},
      {"people", people},
      {"worst_range", worst_range},
      {"worst", worst},
      {"moved_wall", moved_wall},
      {"low_light", failing("camera0", Kind::kDark)},
      {"motion_blur", motion_blur},
      {"saturated", failing("camera0", Kind::kSaturated)},
      {"camera_blind", failing("camera0", Kind::kBlind)},
      {"range_blind", failing("range0", Kind::kBlind)},
      {"both_blind", both_blind},
      {"lying_range", lying_range},
      {"lying_camera", lying_camera},
      {"odometry_slip", odometry_slip},
      {"no_odometry", no_odometry},
      {"wrong_start", wrong_start},
      {"unknown_start", unknown_start},
      {"kidnap", kidnap},
      {"turned", turned},
      {"symmetric", symmetric}};
  return degradations;
}

}  // namespace

const std::vector<std::string>& degradation_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> collected;
    for (const auto& entry : all()) collected.push_back(entry.first);
    return collected;
  }();
  return names;
}

World degraded(World world, std::string_view name, std::uint64_t seed) {
  for (const auto& [known, degrade] : all()) {
    if (known != name) continue;
    Random random(seed_of_world(seed, world.name), kDegradationStream);
    degrade(world, random);
    return world;
  }
  const std::string near = nearest_word(std::string(name), degradation_names());
  throw std::invalid_argument("unknown degradation '" + std::string(name) + "'" +
                              (near.empty() ? "" : ": did you mean '" + near + "'?"));
}

}  // namespace credo::sim
