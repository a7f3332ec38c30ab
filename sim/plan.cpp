// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "sim/random.hpp"

namespace credo::sim {
namespace {

constexpr double kMargin_m = 0.5;   // of the map around the building
constexpr int kLargestMap = 20000;  // cells per side

/// Junctions by their place to the millimetre, with the place that the plan shows.
class Junctions {
 public:
  Junctions(double sigma_m, std::uint64_t seed) : sigma_m_(sigma_m), random_(seed, kPlanStream) {}
  Eigen::Vector2d drawn(const Eigen::Vector2d& p) {
    const std::pair key(std::llround(p.x() * 1e3), std::llround(p.y() * 1e3));
    const auto found = places_.find(key);
    if (found != places_.end()) return found->second;
    const double dx = random_.normal(sigma_m_), dy = random_.normal(sigma_m_);
    return places_.emplace(key, p + Eigen::Vector2d(dx, dy)).first->second;
  }

 private:
  double sigma_m_;
  Random random_;
  std::map<std::pair<long long, long long>, Eigen::Vector2d> places_;
};

bool spans(const Panel& panel, double height_m) { return panel.z0_m <= height_m && height_m <= panel.z1_m; }

std::vector<double> heights_of_sensors(const World& world) {
  std::vector<double> heights;
  for (const RangeFinderSetup& setup : world.range_finders) heights.push_back(setup.finder.height_m);
  for (const SonarSetup& setup : world.sonars) heights.push_back(setup.ring.height_m);
  if (heights.empty()) heights.push_back(world.camera.value().camera.height_m);
  return heights;
}

TruthMap empty_map(const World& world, double resolution_m) {
  if (!(resolution_m > 0.0)) throw std::invalid_argument("the resolution of the map must be larger than 0");
  Eigen::Vector2d low = world.panels.front().a, high = low;
  for (const Panel& panel : world.panels) {
    low = low.cwiseMin(panel.a).cwiseMin(panel.b);
    high = high.cwiseMax(panel.a).cwiseMax(panel.b);
  }
  TruthMap map;
  map.resolution_m = resolution_m;
  const auto whole = [&](double v) { return std::floor(v / resolution_m); };
  map.origin = resolution_m * Eigen::Vector2d(whole(low.x() - kMargin_m), whole(low.y() - kMargin_m));
  const Eigen::Vector2d size = (high - map.origin).array() + kMargin_m;
  if (size.maxCoeff() / resolution_m > kLargestMap)
    throw std::invalid_argument("the map has too many cells: choose a coarser resolution");
  map.width = static_cast<int>(std::ceil(size.x() / resolution_m));
  map.height = static_cast<int>(std::ceil(size.y() / resolution_m));
  map.cells.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
                   TruthMap::Cell::kUnknown);
  return map;
}

/// Every cell that the panel's line crosses, in steps well below a cell.
void draw_line(const Panel& panel, TruthMap& map) {
  const double length = (panel.b - panel.a).norm();
  const int steps = static_cast<int>(std::ceil(length / (0.1 * map.resolution_m)));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p =
        panel.a + (panel.b - panel.a) * (static_cast<double>(i) / std::max(steps, 1)) - map.origin;
    const auto column = static_cast<std::size_t>(p.x() / map.resolution_m),
               row = static_cast<std::size_t>(p.y() / map.resolution_m);
    map.cells[row * static_cast<std::size_t>(map.width) + column] = TruthMap::Cell::kOccupied;
  }
}

/// Free is what is connected to a waypoint.
void flood(const Eigen::Vector2d& start, TruthMap& map) {
  const Eigen::Vector2d p = (start - map.origin) / map.resolution_m;
  if (p.x() < 0.0 || p.y() < 0.0 || p.x() >= map.width || p.y() >= map.height) return;
  std::vector<std::pair<int, int>> open{{static_cast<int>(p.x()), static_cast<int>(p.y())}};
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    if (column < 0 || row < 0 || column >= map.width || row >= map.height) continue;
    auto& cell = map.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(column)];
    if (cell != TruthMap::Cell::kUnknown) continue;
    cell = TruthMap::Cell::kFree;
    open.insert(open.end(), {{column + 1, row}, {column - 1, row}, {column, row + 1}, {column, row - 1}});
  }
}

}  // namespace

geometry::FloorPlan draw_floor_plan(const World& world, double height_m, std::uint64_t seed) {
  Junctions junctions(world.plan_uncertainty_m, seed);
  geometry::FloorPlan plan;
  plan.uncertainty_m = world.plan_uncertainty_m;
  const auto draw = [&](const Panel& panel) {
    if (!panel.in_plan || !spans(panel, height_m)) return;
    const Eigen::Vector2d a = junctions.drawn(panel.a);
    plan.walls.push_back({a, junctions.drawn(panel.b)});
  };
  std::for_each(world.panels.begin(), world.panels.end(), draw);
  std::for_each(world.only_planned.begin(), world.only_planned.end(), draw);
  for (const Eigen::Vector2d& mark : world.marks) plan.verticals.push_back(junctions.drawn(mark));
  return plan;
}

TruthMap draw_truth_map(const World& world, double resolution_m) {
  const std::vector<double> heights = heights_of_sensors(world);
  TruthMap map = empty_map(world, resolution_m);
  for (const Panel& panel : world.panels)
    if (std::any_of(heights.begin(), heights.end(), [&](double height) { return spans(panel, height); }))
      draw_line(panel, map);
  for (const Waypoint& waypoint : world.path) flood(waypoint.position, map);
  return map;
}

}  // namespace credo::sim
