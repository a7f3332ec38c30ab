// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/rearrangement.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
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
constexpr double kHangs_m = 0.06;        // what is that near to a wall hangs on it

std::size_t nearest_planned(const World& world, const Point& at) {
  std::size_t nearest = world.panels.size();
  double least = kFarthestThing_m;
  for (std::size_t i = 0; i < world.panels.size(); ++i) {
    const Panel& panel = world.panels[i];
    const double distance = geometry::distance(at, {panel.a, panel.b});
    if (!panel.in_plan || distance >= least) continue;
    least = distance;
    nearest = i;
  }
  if (nearest < world.panels.size()) return nearest;
  std::ostringstream message;
  message << "the floor plan shows nothing within " << kFarthestThing_m << " m of [" << at.x() << ", " << at.y() << "]";
  throw std::invalid_argument(message.str());
}

bool joined(const Panel& p, const Panel& q) {
  const auto meet = [](const Point& a, const Point& b) { return (a - b).norm() < kHangTogether_m; };
  return p.z0_m == q.z0_m && p.z1_m == q.z1_m && (meet(p.a, q.a) || meet(p.a, q.b) || meet(p.b, q.a) || meet(p.b, q.b));
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

}  // namespace

void move_thing(World& world, const Point& at, const Point& by, double turn_rad) {
  const std::size_t nearest = nearest_planned(world, at);
  std::vector<std::size_t> group = connected(world, nearest);
  if (size_of(world, group) > kLargestThing_m) group = with_what_hangs_on(world, nearest);
  Point centre = Point::Zero();
  for (const std::size_t i : group)
    centre += 0.5 * (world.panels[i].a + world.panels[i].b) / static_cast<double>(group.size());
  const geometry::Pose2 to_centre{-centre.x(), -centre.y(), 0.0},
      back{centre.x() + by.x(), centre.y() + by.y(), turn_rad};
  const geometry::Pose2 T_now_planned = back * to_centre;
  for (const std::size_t i : group) {
    Panel& panel = world.panels[i];
    if (panel.in_plan) world.only_planned.push_back(panel);
    panel.a = T_now_planned * panel.a;
    panel.b = T_now_planned * panel.b;
    panel.in_plan = false;
  }
}

}  // namespace credo::sim
