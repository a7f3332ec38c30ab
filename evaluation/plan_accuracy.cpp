// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/plan_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "grids/readout.hpp"

namespace credo::evaluation {
namespace {

using Point = Eigen::Vector2d;

double distance_m(const Point& p, const geometry::FloorPlan& plan) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const geometry::Segment& wall : plan.walls) nearest = std::min(nearest, geometry::distance(p, wall));
  return nearest;
}

/// visit(point, length that it stands for) along all walls.
template <typename Visit>
void for_each_point(const geometry::FloorPlan& plan, double step_m, Visit visit) {
  for (const geometry::Segment& wall : plan.walls) {
    const int steps = std::max(1, static_cast<int>(std::lround(wall.length() / step_m)));
    for (int i = 0; i < steps; ++i) visit(Point(wall.a + (i + 0.5) / steps * (wall.b - wall.a)), wall.length() / steps);
  }
}

/// Whether the map is sure of free space beside a point: what is behind a wall was not seen.
bool free_near(const grids::EvidentialGrid& map, const Point& p, double within_m) {
  const grids::CellIndex low = map.georeference().cell_at(p - Point::Constant(within_m)),
                         high = map.georeference().cell_at(p + Point::Constant(within_m));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (grids::decide(map.at({x, y})) == grids::CellState::kEmpty) return true;
  return false;
}

}  // namespace

PlanAccuracy plan_accuracy(const geometry::FloorPlan& extracted, const geometry::FloorPlan& truth,
                           const grids::EvidentialGrid& map, const PlanAccuracyParams& params) {
  if (truth.walls.empty()) throw std::invalid_argument("the floor plan has no wall to compare with");
  PlanAccuracy result;
  double distances = 0.0;
  for_each_point(extracted, params.step_m, [&](const Point& p, double length_m) {
    const double off_m = distance_m(p, truth);
    result.extracted_m += length_m;
    if (off_m > params.tolerance_m) return;
    result.right_m += length_m;
    distances += off_m * length_m;
  });
  for_each_point(truth, params.step_m, [&](const Point& p, double length_m) {
    if (!free_near(map, p, params.tolerance_m)) return;
    result.seen_m += length_m;
    if (distance_m(p, extracted) <= params.tolerance_m) result.found_m += length_m;
  });
  if (result.seen_m == 0.0)
    throw std::invalid_argument("the map saw no wall of the floor plan: are both in the same frame?");
  result.mean_distance_m = distances / result.right_m;
  return result;
}

}  // namespace credo::evaluation
