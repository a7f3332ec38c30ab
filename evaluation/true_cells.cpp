// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/true_cells.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/pose.hpp"

namespace credo::evaluation {
namespace {

using grids::CellBox;
using grids::CellIndex;
using State = TrueCells::State;

State state_of(std::int8_t cell) {
  if (cell < 0) return State::kUnknown;
  return cell >= 50 ? State::kOccupied : State::kEmpty;
}

/// \throws std::length_error beyond TrueCells::kMostCells
std::size_t count_of(const CellBox& box, double resolution_m) {
  const auto count = static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height);
  if (count <= TrueCells::kMostCells) return count;
  throw std::length_error("the true map is compared over " + std::to_string(std::lround(resolution_m * box.width)) +
                          " m x " + std::to_string(std::lround(resolution_m * box.height)) + " m, " +
                          std::to_string(count) + " cells; expected at most " + std::to_string(TrueCells::kMostCells) +
                          ": is the resolution in its .yaml file right, in metres per pixel?");
}

}  // namespace

CellBox box_of(const datasets::OccupancyMap& truth, const grids::Georeference& georeference) {
  const geometry::Pose2 T_map_truth{truth.origin_x_m, truth.origin_y_m, truth.origin_yaw_rad};
  CellBox box;
  for (const int x : {0, truth.width})
    for (const int y : {0, truth.height})
      box = box.united(
          {georeference.cell_at(T_map_truth * Eigen::Vector2d(truth.resolution_m * x, truth.resolution_m * y)), 1, 1});
  return box;
}

CellBox widened(const CellBox& box, int margin) {
  return {{box.min.x - margin, box.min.y - margin}, box.width + 2 * margin, box.height + 2 * margin};
}

TrueCells::TrueCells(const datasets::OccupancyMap& truth, const grids::Georeference& georeference, const CellBox& box)
    : box_(box), states_(count_of(box, georeference.resolution_m), State::kUnknown) {
  const geometry::Pose2 T_map_truth{truth.origin_x_m, truth.origin_y_m, truth.origin_yaw_rad};
  const geometry::Pose2 T_truth_map = T_map_truth.inverse();
  for_each_cell(box, [&](CellIndex cell) {
    const Eigen::Vector2d p = (T_truth_map * georeference.centre(cell)) / truth.resolution_m;
    const double column = std::floor(p.x()), row = std::floor(p.y());
    if (column < 0.0 || row < 0.0 || column >= truth.width || row >= truth.height) return;
    states_[place(cell)] = state_of(truth.at(static_cast<int>(column), static_cast<int>(row)));
  });
  // A truth finer than the map: a wall thinner than its cells is a wall, even where no centre falls on it.
  for (int row = 0; row < truth.height; ++row)
    for (int column = 0; column < truth.width; ++column) {
      if (state_of(truth.at(column, row)) != State::kOccupied) continue;
      const Eigen::Vector2d centre(truth.resolution_m * (column + 0.5), truth.resolution_m * (row + 0.5));
      set(georeference.cell_at(T_map_truth * centre), State::kOccupied);
    }
}

TrueCells::TrueCells(const geometry::FloorPlan& plan, const grids::Georeference& georeference, const CellBox& box,
                     int margin)
    : box_(box), states_(count_of(box, georeference.resolution_m), State::kUnknown) {
  CellBox known;
  for (const geometry::Segment& wall : plan.walls)
    for (const Eigen::Vector2d& end : {wall.a, wall.b}) known = known.united({georeference.cell_at(end), 1, 1});
  known = widened(known, margin);
  for_each_cell(box, [&](CellIndex cell) {
    if (known.contains(cell)) set(cell, State::kEmpty);
  });
  constexpr int kStepsPerCell = 8;
  for (const geometry::Segment& wall : plan.walls) {
    const auto steps = 1 + static_cast<std::int64_t>(wall.length() / georeference.resolution_m * kStepsPerCell);
    for (std::int64_t step = 0; step <= steps; ++step)
      set(georeference.cell_at(wall.a + (wall.b - wall.a) * (static_cast<double>(step) / static_cast<double>(steps))),
          State::kOccupied);
  }
}

}  // namespace credo::evaluation
