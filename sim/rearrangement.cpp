// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/rearrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

using geometry::Segment;
using Point = Eigen::Vector2d;

constexpr double kFarthestThing_m = 0.5;
constexpr double kHangTogether_m = 1e-3;
constexpr double kLargestThing_m = 2.5;  // larger things are parts of the building
constexpr std::size_t kFewestFaces = 3;  // of a thing: a shelf against a wall
constexpr double kHangs_m = 0.06;        // what is that near to a wall hangs on it

/// Of those panels that `counts` says yes to, within reach; as many as there are panels where there is none.
template <typename Counts>
std::size_t nearest_panel(const World& world, const Point& at, const Counts& counts) {
  std::size_t nearest = world.panels.size();
  double least = kFarthestThing_m;
  for (std::size_t i = 0; i < world.panels.size(); ++i) {
    const double distance = geometry::distance(at, {world.panels[i].a, world.panels[i].b});
    if (distance >= least || !counts(i)) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

[[noreturn]] void refuse(const std::string& what, const Point& at) {
  std::ostringstream message;
  message << what << " within " << kFarthestThing_m << " m of [" << at.x() << ", " << at.y() << "]";
  throw std::invalid_argument(message.str());
}

bool joined(const Panel& p, const Panel& q) {
  const auto meet = [](const Point& a, const Point& b) { return (a - b).norm() < kHangTogether_m; };
  return p.z0_m == q.z0_m && p.z1_m == q.z1_m && p.from_s == q.from_s && p.to_s == q.to_s &&
         (meet(p.a, q.a) || meet(p.a, q.b) || meet(p.b, q.a) || meet(p.b, q.b));
}

/// All panels that hang together with one, as tall as it is, end to end.
std::vector<std::size_t> connected(const World& world, std::size_t first) {
  std::vector<std::size_t> group{first};
  for (std::size_t next = 0; next < group.size(); ++next)
    for (std::size_t i = 0; i < world.panels.size(); ++i)
      if (joined(world.panels[group[next]], world.panels[i]) && std::find(group.begin(), group.end(), i) == group.end())
        group.push_back(i);
  return group;
}

double size_of(const World& world, const std::vector<std::size_t>& group) {
  const Panel& first = world.panels[group.front()];
  Point low = first.a, high = first.a;
  for (const std::size_t i : group) {
    low = low.cwiseMin(world.panels[i].a).cwiseMin(world.panels[i].b);
    high = high.cwiseMax(world.panels[i].a).cwiseMax(world.panels[i].b);
  }
  return (high - low).norm();
}

/// A wall and what hangs on it.
std::vector<std::size_t> with_what_hangs_on(const World& world, std::size_t wall) {
  const Segment line{world.panels[wall].a, world.panels[wall].b};
  std::vector<std::size_t> group{wall};
  for (std::size_t i = 0; i < world.panels.size(); ++i) {
    const Panel& panel = world.panels[i];
    if (i != wall && !panel.in_plan && geometry::distance(panel.a, line) < kHangs_m &&
        geometry::distance(panel.b, line) < kHangs_m)
      group.push_back(i);
  }
  return group;
}

/// The motion that turns a group of panels about its middle and then shifts it.
geometry::Pose2 motion_of(const World& world, const std::vector<std::size_t>& group, const Point& by, double turn_rad) {
  Point centre = Point::Zero();
  for (const std::size_t i : group)
    centre += 0.5 * (world.panels[i].a + world.panels[i].b) / static_cast<double>(group.size());
  const geometry::Pose2 to_centre{-centre.x(), -centre.y(), 0.0},
      back{centre.x() + by.x(), centre.y() + by.y(), turn_rad};
  return back * to_centre;
}

/// What stands on its own or against a wall; what has fewer faces hangs on one.
bool is_thing(const World& world, const std::vector<std::size_t>& group) {
  return group.size() >= kFewestFaces && size_of(world, group) <= kLargestThing_m;
}

/// The thing nearest to `at` of all that stand there at a moment and can be moved.
std::vector<std::size_t> thing_at(const World& world, double seconds, const Point& at) {
  const std::size_t nearest = nearest_panel(world, at, [&](std::size_t i) {
    return world.panels[i].is_there(seconds) && is_thing(world, connected(world, i));
  });
  if (nearest == world.panels.size()) refuse("nothing that can be moved stands", at);
  return connected(world, nearest);
}

/// From a moment on, a panel is elsewhere.
void replace(World& world, double when_s, std::size_t index, const Point& a, const Point& b) {
  Panel panel = world.panels[index];
  world.panels[index].to_s = panel.from_s = when_s;
  panel.a = a;
  panel.b = b;
  panel.in_plan = false;
  world.panels.push_back(panel);
}

}  // namespace

void move_thing(World& world, const Point& at, const Point& by, double turn_rad) {
  const std::size_t nearest = nearest_panel(world, at, [&](std::size_t i) { return world.panels[i].in_plan; });
  if (nearest == world.panels.size()) refuse("the floor plan shows nothing", at);
  std::vector<std::size_t> group = connected(world, nearest);
  if (size_of(world, group) > kLargestThing_m) group = with_what_hangs_on(world, nearest);
  const geometry::Pose2 T_now_planned = motion_of(world, group, by, turn_rad);
  for (const std::size_t i : group) {
    Panel& panel = world.panels[i];
    if (panel.in_plan) world.only_planned.push_back(panel);
    panel.a = T_now_planned * panel.a;
    panel.b = T_now_planned * panel.b;
    panel.in_plan = false;
  }
}

void appear(World& world, double when_s, std::size_t first) {
  for (std::size_t i = first; i < world.panels.size(); ++i) world.panels[i].from_s = when_s;
  world.changes.push_back({when_s, "obstacle_added"});
}

void take_away(World& world, double when_s, const Point& at) {
  for (const std::size_t i : thing_at(world, when_s, at)) world.panels[i].to_s = when_s;
  world.changes.push_back({when_s, "obstacle_removed"});
}

void shift(World& world, double when_s, const Point& at, const Point& by, double turn_rad) {
  const std::vector<std::size_t> thing = thing_at(world, when_s, at);
  const geometry::Pose2 T_after_before = motion_of(world, thing, by, turn_rad);
  for (const std::size_t i : thing)
    replace(world, when_s, i, T_after_before * world.panels[i].a, T_after_before * world.panels[i].b);
  world.changes.push_back({when_s, "obstacle_moved"});
}

void turn_leaf(World& world, double when_s, const Point& at, double leaf_rad) {
  const auto nearest =
      std::min_element(world.leaves.begin(), world.leaves.end(),
                       [&](const DoorLeaf& a, const DoorLeaf& b) { return (a.at - at).norm() < (b.at - at).norm(); });
  if (nearest == world.leaves.end() || (nearest->at - at).norm() >= kFarthestThing_m)
    refuse("there is no opening with a leaf", at);
  const Panel& before = world.panels[nearest->panel];
  const Point along = std::cos(leaf_rad) * nearest->shut + std::sin(leaf_rad) * nearest->away;
  replace(world, when_s, nearest->panel, nearest->hinge, nearest->hinge + (before.b - before.a).norm() * along);
  nearest->panel = world.panels.size() - 1;
  world.changes.push_back({when_s, leaf_rad == 0.0 ? "door_closed" : "door_opened"});
}

std::vector<double> state_times(const World& world) {
  std::vector<double> times{0.0};
  for (const Change& change : world.changes)
    if (change.when_s > times.back()) times.push_back(change.when_s);
  return times;
}

World world_at(const World& world, double seconds) {
  World now = world;
  now.changes.clear();
  for (Panel& panel : now.panels) {
    if (!panel.is_there(seconds)) panel.z0_m = panel.z1_m = -1.0;
    panel.from_s = 0.0;
    panel.to_s = std::numeric_limits<double>::infinity();
  }
  return now;
}

}  // namespace credo::sim
