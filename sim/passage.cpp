// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/passage.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "geometry/segment.hpp"
#include "sim/rearrangement.hpp"

namespace credo::sim {
namespace {

using geometry::cross;
using geometry::Segment;
using Point = Eigen::Vector2d;

std::string text_of(const Point& p) {
  char text[64];
  std::snprintf(text, sizeof text, "[%.4g, %.4g]", p.x(), p.y());
  return text;
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", value);
  return text;
}

bool cross_each_other(const Segment& s, const Segment& t) {
  const auto parts = [](const Segment& line, const Segment& ends) {
    const Point along = line.b - line.a;
    return cross(along, ends.a - line.a) * cross(along, ends.b - line.a) < 0.0;
  };
  return parts(s, t) && parts(t, s);
}

/// How near two segments come to each other, and where on the second one.
struct Approach {
  double distance_m = std::numeric_limits<double>::infinity();
  Point at = Point::Zero();
};
Approach approach(const Segment& way, const Segment& panel) {
  if (cross_each_other(way, panel)) {
    const Point along = way.b - way.a, across = panel.b - panel.a;
    return {0.0, panel.a + cross(way.a - panel.a, along) / cross(across, along) * across};
  }
  Approach nearest;
  const auto take = [&](double distance, const Point& at) {
    if (distance < nearest.distance_m) nearest = {distance, at};
  };
  take(geometry::distance(panel.a, way), panel.a);
  take(geometry::distance(panel.b, way), panel.b);
  const Point across = panel.b - panel.a;
  for (const Point& end : {way.a, way.b}) {
    const double along = std::clamp((end - panel.a).dot(across) / std::max(across.squaredNorm(), 1e-18), 0.0, 1.0);
    take(geometry::distance(end, panel), panel.a + along * across);
  }
  return nearest;
}

/// Whether the boxes around two segments are further apart than `margin_m`.
bool far_apart(const Segment& s, const Segment& t, double margin_m) {
  const auto gap = [](double a, double b, double c, double d) {
    return std::max(std::min(a, b) - std::max(c, d), std::min(c, d) - std::max(a, b));
  };
  return gap(s.a.x(), s.b.x(), t.a.x(), t.b.x()) > margin_m || gap(s.a.y(), s.b.y(), t.a.y(), t.b.y()) > margin_m;
}

/// Inside of a polygon, or at most `margin_m` outside.
bool within(const std::vector<Point>& polygon, const Point& p, double margin_m) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (geometry::distance(p, {a, b}) <= margin_m) return true;
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// In a room, or at most `margin_m` outside of one; in a world without rooms, in the rectangle around its walls.
bool in_building(const World& world, const Point& p, double margin_m) {
  if (!world.areas.empty())
    return std::any_of(world.areas.begin(), world.areas.end(),
                       [&](const std::vector<Point>& area) { return within(area, p, margin_m); });
  Eigen::AlignedBox2d box;
  for (const Panel& panel : world.panels) box.extend(panel.a).extend(panel.b);
  return box.contains(p);
}

/// The waypoint that the robot is on its way to at a place of its path.
std::size_t waypoint_after(const std::vector<Waypoint>& path, const Point& at) {
  std::size_t nearest = 0;
  double least = (at - path.front().position).norm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point& from = path[path[i].carried_here ? i : i - 1].position;
    const double distance = geometry::distance(at, {from, path[i].position});
    if (distance >= least - 1e-9) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

/// Waypoints may lie in the doorway of a usual wall; on its way the robot may pass one of the thickest.
std::optional<Obstruction> find_place_outside(const World& world, const Trajectory& way) {
  constexpr double kHalfWall_m = 0.2, kHalfThickestWall_m = 0.5, kStep_m = 0.1;
  for (std::size_t i = 0; i < world.path.size(); ++i)
    if (const Point& at = world.path[i].position; !in_building(world, at, kHalfWall_m))
      return Obstruction{i, "waypoint " + text_of(at) + " is outside of the building: move it into a room"};
  for (const Segment& stretch : way.stretches()) {
    const int steps = static_cast<int>(std::ceil(stretch.length() / kStep_m));
    for (int k = 1; k < steps; ++k) {
      const Point at = stretch.a + (stretch.b - stretch.a) * (static_cast<double>(k) / steps);
      if (in_building(world, at, kHalfThickestWall_m)) continue;
      const std::size_t waypoint = waypoint_after(world.path, stretch.b);
      return Obstruction{waypoint, "the robot is outside of the building at " + text_of(at) +
                                       " on its way to waypoint " + text_of(world.path[waypoint].position) +
                                       ": lead the path through rooms"};
    }
  }
  return std::nullopt;
}

/// What the robot touches on a stretch of its way, of all that is there at a moment: what it comes nearest to.
std::optional<Obstruction> find_touch(const World& world, double seconds, const Segment& stretch) {
  constexpr double kTouch_m = 1e-6;
  const double height = height_of_robot(world), radius = world.robot_radius_m;
  Approach nearest;
  const Panel* touched = nullptr;
  for (const Panel& panel : world.panels) {
    if (!panel.is_there(seconds) || panel.z0_m > height || panel.z1_m <= 0.0) continue;
    if (far_apart(stretch, {panel.a, panel.b}, radius)) continue;
    const Approach met = approach(stretch, {panel.a, panel.b});
    if (met.distance_m >= std::min(radius, nearest.distance_m) - kTouch_m) continue;
    nearest = met;
    touched = &panel;
  }
  if (touched == nullptr) return std::nullopt;
  const std::size_t waypoint = waypoint_after(world.path, stretch.b);
  const std::string thing = "'" + world.materials[static_cast<std::size_t>(touched->material)].name + "' at " +
                            text_of(nearest.at) + " on its way to waypoint " + text_of(world.path[waypoint].position);
  if (nearest.distance_m < kTouch_m)
    return Obstruction{waypoint,
                       "the robot drives through " + thing + ": lead the path around it, or through an opening"};
  return Obstruction{waypoint, "the robot, of radius " + metres(radius) + ", comes within " +
                                   metres(nearest.distance_m) + " of " + thing +
                                   ": keep the path further away, or make 'robot_radius' smaller"};
}

}  // namespace

double height_of_robot(const World& world) {
  double height = 0.0;
  if (world.camera) height = world.camera->camera.height_m;
  for (const RangeFinderSetup& setup : world.range_finders) height = std::max(height, setup.finder.height_m);
  for (const SonarSetup& setup : world.sonars) height = std::max(height, setup.ring.height_m);
  return height;
}

std::optional<Obstruction> find_obstruction(const World& world, const Trajectory& way) {
  if (auto outside = find_place_outside(world, way)) return outside;
  const std::vector<double> states = state_times(world);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double until_s = i + 1 < states.size() ? states[i + 1] : std::numeric_limits<double>::infinity();
    for (const Segment& stretch : way.stretches(states[i], until_s))
      if (auto touch = find_touch(world, states[i], stretch)) return touch;
  }
  return std::nullopt;
}

}  // namespace credo::sim
