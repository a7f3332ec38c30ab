// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/clutter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/segment.hpp"
#include "sim/building.hpp"
#include "sim/free_space.hpp"
#include "sim/passage.hpp"
#include "sim/random.hpp"

namespace credo::sim {
namespace {

using geometry::Segment;
using Point = Eigen::Vector2d;

constexpr double kOffWay_m = 0.12;    // between the robot's side and a thing
constexpr double kOffWall_m = 0.02;   // behind a thing; posters and frames fit in between
constexpr double kOffThings_m = 0.1;  // between two things
constexpr double kLookedAtFrom_m = 0.45;
constexpr double kPart_m = 0.25;       // of a wall, looked at as a whole
constexpr double kRoomAround_m = 0.4;  // a place for what stands free
constexpr double kFreeStandingShare = 0.25;
constexpr int kMostAttempts = 4000;
constexpr double kShortestWall_m = 0.6;

/// A thing on the floor.
struct Thing {
  Point centre;
  Point size;
  double turn_rad;

  [[nodiscard]] std::array<Segment, 4> outline() const {
    const geometry::Pose2 T_map_thing{centre.x(), centre.y(), turn_rad};
    const Point h = 0.5 * size;
    const Point corners[] = {T_map_thing * Point(-h.x(), -h.y()), T_map_thing * Point(h.x(), -h.y()),
                             T_map_thing * Point(h.x(), h.y()), T_map_thing * Point(-h.x(), h.y())};
    return {{{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[3]}, {corners[3], corners[0]}}};
  }
};

/// Least distance of two segments; 0 where they cross.
double gap(const Segment& s, const Segment& t) {
  const auto parts = [](const Segment& line, const Segment& ends) {
    const Point along = line.b - line.a;
    return geometry::cross(along, ends.a - line.a) * geometry::cross(along, ends.b - line.a) < 0.0;
  };
  if (parts(s, t) && parts(t, s)) return 0.0;
  return std::min(
      {geometry::distance(s.a, t), geometry::distance(s.b, t), geometry::distance(t.a, s), geometry::distance(t.b, s)});
}

/// Puts things into a world, one by one.
class Clutterer {
 public:
  Clutterer(World& world, const Trajectory& way, std::uint64_t seed)
      : world_(&world),
        random_(seed, kClutterStream),
        way_(way.stretches()),
        space_(world, {world.robot_radius_m, height_of_robot(world)}, world.path.front().position) {
    const double height = world.range_finders.empty() ? height_of_robot(world) : world.range_finders[0].finder.height_m;
    lowest_top_m_ = height + 0.1;
    for (const Panel& panel : world.panels)
      if (panel.in_plan && panel.z0_m <= height && height <= panel.z1_m) {
        const Segment line{panel.a, panel.b};
        walls_m_ += length_in_sight(line);
        if (panel.z1_m >= world.ceiling_m && line.length() > kShortestWall_m) walls_.push_back(line);
      }
    free_places_ = space_.places(kRoomAround_m);
  }

  void fill() {
    const double wanted_m = world_->clutter_share * walls_m_;
    for (int i = 0; i < kMostAttempts && hidden_m_ < wanted_m; ++i) {
      const bool walls_are_full = i > kMostAttempts / 2;
      const bool free_standing = standing_free_m_ < kFreeStandingShare * hidden_m_ || (walls_are_full && i % 2 == 0);
      const std::optional<Thing> thing = free_standing ? draw_free_standing() : draw_at_wall();
      if (thing && fits(*thing, !free_standing)) put(*thing, free_standing);
    }
  }

 private:
  /// The length of the part of a wall that has a place near by from which the robot can look at it.
  [[nodiscard]] double length_in_sight(const Segment& wall) const {
    const int parts = std::max(1, static_cast<int>(wall.length() / kPart_m));
    int seen = 0;
    for (int i = 0; i < parts; ++i) {
      const Point at = wall.a + (i + 0.5) / parts * (wall.b - wall.a);
      seen +=
          space_.reaches(at + kLookedAtFrom_m * wall.normal()) || space_.reaches(at - kLookedAtFrom_m * wall.normal());
    }
    return wall.length() * seen / parts;
  }

  /// On the side of the wall on which the robot can be.
  std::optional<Thing> draw_at_wall() {
    if (walls_.empty()) return std::nullopt;
    const Segment& line = walls_[random_.bits() % walls_.size()];
    const Point size(random_.uniform(0.4, std::min(1.6, line.length() - 0.1)), random_.uniform(0.25, 0.55));
    const double at = random_.uniform(0.5 * size.x(), line.length() - 0.5 * size.x());
    const double side = random_.chance(0.5) ? 1.0 : -1.0;
    const Point foot = line.a + at * line.direction(), away = side * line.normal();
    if (!space_.reaches(foot + (size.y() + world_->robot_radius_m + 0.25) * away)) return std::nullopt;
    return Thing{foot + (kOffWall_m + 0.5 * size.y()) * away, size,
                 std::atan2(line.direction().y(), line.direction().x())};
  }

  std::optional<Thing> draw_free_standing() {
    if (free_places_.empty()) return std::nullopt;
    const Point size(random_.uniform(0.35, 0.6), random_.uniform(0.35, 0.6));
    return Thing{free_places_[random_.bits() % free_places_.size()], size, random_.uniform(0.0, std::numbers::pi)};
  }

  [[nodiscard]] bool fits(const Thing& thing, bool at_wall) const {
    const double reach = 0.5 * thing.size.norm();
    const auto outline = thing.outline();
    const auto nearer = [&](const Segment& other, double margin) {
      if (geometry::distance(thing.centre, other) > reach + margin) return false;
      return geometry::distance(thing.centre, other) < 0.5 * thing.size.minCoeff() ||
             std::any_of(outline.begin(), outline.end(), [&](const Segment& s) { return gap(s, other) < margin; });
    };
    const double off_way = world_->robot_radius_m + kOffWay_m;
    if (std::any_of(way_.begin(), way_.end(), [&](const Segment& s) { return nearer(s, off_way); })) return false;
    const double off_wall = at_wall ? 0.5 * kOffWall_m : kOffThings_m;
    return std::none_of(world_->panels.begin(), world_->panels.end(), [&](const Panel& panel) {
      const bool wall = panel.z0_m <= 0.0 && panel.z1_m >= world_->ceiling_m;
      return panel.z0_m < 2.0 && nearer({panel.a, panel.b}, wall || panel.z0_m > 0.2 ? off_wall : kOffThings_m);
    });
  }

  void put(const Thing& thing, bool free_standing) {
    static constexpr const char* kLooks[] = {"cabinet", "wood", "dark", "board", "poster", "books"};
    const double top = free_standing ? lowest_top_m_ + random_.uniform(0.0, 0.2) : random_.uniform(lowest_top_m_, 1.9);
    const std::string look = kLooks[random_.bits() % (free_standing ? 4 : 6)];
    Builder(*world_).add_box(thing.centre, thing.size, thing.turn_rad, 0.0, top, look, false);
    hidden_m_ += thing.size.x();
    if (free_standing) standing_free_m_ += thing.size.x();
  }

  World* world_;
  Random random_;
  std::vector<Segment> way_;
  FreeSpace space_;
  double lowest_top_m_ = 0.0;  ///< of what the range finder sees
  double walls_m_ = 0.0;
  double hidden_m_ = 0.0;
  double standing_free_m_ = 0.0;  ///< of it
  std::vector<Segment> walls_;    ///< from floor to ceiling
  std::vector<Point> free_places_;
};

}  // namespace

World with_clutter(World world, const Trajectory& way, std::uint64_t seed) {
  if (world.clutter_share > 0.0) Clutterer(world, way, seed).fill();
  world.clutter_share = 0.0;
  return world;
}

}  // namespace credo::sim
