// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/pose.hpp"

#include "geometry/pose.hpp"

namespace credo::evaluation {
namespace {

using grids::CellBox;
using grids::CellIndex;
using State = TrueCells::State;

constexpr double kFarthest_m = 0.5;

TrueCells::State state_of(std::int8_t cell) {
  if (cell < 0) return State::kUnknown;
  return cell >= 50 ? State::kOccupied : State::kEmpty;
}

State said(const evidence::GridMass& mass) {
  if (mass.occupied == mass.empty) return State::kUnknown;
  return mass.occupied > mass.empty ? State::kOccupied : State::kEmpty;
}

template <typename Visit>
void for_each(const CellBox& box, Visit visit) {
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) visit(CellIndex{x, y});
}

/// Distance to the nearest cell within kFarthest_m for which holds(cell); kFarthest_m without one.
template <typename Holds>
double nearest_m(CellIndex cell, double resolution_m, Holds holds) {
  const int reach = static_cast<int>(std::ceil(kFarthest_m / resolution_m));
  double nearest = kFarthest_m;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const double distance_m = resolution_m * std::hypot(dx, dy);
      if (distance_m < nearest && holds(CellIndex{cell.x + dx, cell.y + dy})) nearest = distance_m;
    }
  return nearest;
}

struct Mean {
  double sum = 0.0;
  std::int64_t count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  [[nodiscard]] double value() const {
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
};

/// \throws std::length_error beyond TrueCells::kMostCells
std::size_t count_of(const CellBox& box, double resolution_m) {
  const auto count = static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height);
  if (count <= TrueCells::kMostCells) return count;
  throw std::length_error("the true map is compared over " + std::to_string(std::lround(resolution_m * box.width)) +
                          " m x " + std::to_string(std::lround(resolution_m * box.height)) + " m, " +
                          std::to_string(count) + " cells; expected at most " + std::to_string(TrueCells::kMostCells) +
                          ": is the resolution in its .yaml file right, in metres per pixel?");
}

bool counts(const TrueCells& truth, CellIndex cell) {
  switch (truth.at(cell)) {
    case State::kEmpty: return true;
    case State::kOccupied: return truth.near(cell, State::kEmpty, kWallTolerance);  // not deep inside
    case State::kUnknown: break;
  }
  return false;
}

/// \param says_wall_near  the map says occupied within the tolerance
bool is_right(State says, State real, bool wall_near, bool says_wall_near) {
  return says == State::kOccupied ? wall_near : real == State::kEmpty || says_wall_near;
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

TrueCells::TrueCells(const datasets::OccupancyMap& truth, const grids::Georeference& georeference, const CellBox& box)
    : box_(box), states_(count_of(box, georeference.resolution_m), State::kUnknown) {
  const geometry::Pose2 T_map_truth{truth.origin_x_m, truth.origin_y_m, truth.origin_yaw_rad};
  const geometry::Pose2 T_truth_map = T_map_truth.inverse();
  for_each(box, [&](CellIndex cell) {
    const Eigen::Vector2d p = (T_truth_map * georeference.centre(cell)) / truth.resolution_m;
    const double column = std::floor(p.x()), row = std::floor(p.y());
    if (column < 0.0 || row < 0.0 || column >= truth.width || row >= truth.height) return;
    states_[place(cell)] = state_of(truth.at(static_cast<int>(column), static_cast<int>(row)));
  });
  for (int row = 0; row < truth.height; ++row)
    for (int column = 0; column < truth.width; ++column) {
      if (state_of(truth.at(column, row)) != State::kOccupied) continue;
      const Eigen::Vector2d centre(truth.resolution_m * (column + 0.5), truth.resolution_m * (row + 0.5));
      const CellIndex cell = georeference.cell_at(T_map_truth * centre);
      if (box_.contains(cell)) states_[place(cell)] = State::kOccupied;
    }
}

bool TrueCells::near(CellIndex cell, State state, int within) const {
  for (int dy = -within; dy <= within; ++dy)
    for (int dx = -within; dx <= within; ++dx)
      if (at({cell.x + dx, cell.y + dy}) == state) return true;
  return false;
}

MapScore map_score(const grids::MassMap& map, const datasets::OccupancyMap& truth) {
  const int margin = kWallTolerance + static_cast<int>(std::ceil(kFarthest_m / map.georeference.resolution_m));
  const TrueCells real(
      truth, map.georeference,
      {{map.box.min.x - margin, map.box.min.y - margin}, map.box.width + 2 * margin, map.box.height + 2 * margin});
  const auto says_wall = [&](CellIndex cell) { return map.saw(cell) && said(map.at(cell)) == State::kOccupied; };
  const auto says_wall_near = [&](CellIndex cell) {
    for (int dy = -kWallTolerance; dy <= kWallTolerance; ++dy)
      for (int dx = -kWallTolerance; dx <= kWallTolerance; ++dx)
        if (says_wall({cell.x + dx, cell.y + dy})) return true;
    return false;
  };
  MapScore score;
  Mean brier, log_loss, conflict, ignorance, contour, missed;
  for_each(map.box, [&](CellIndex cell) {
    if (!map.saw(cell) || !counts(real, cell)) return;
    ++score.cells;
    const evidence::GridMass mass = map.at(cell);
    const State says = said(mass), is = real.at(cell);
    if (says != State::kUnknown) {
      ++score.decided;
      score.right += is_right(says, is, real.near(cell, State::kOccupied, kWallTolerance), says_wall_near(cell));
    }
    conflict.add(mass.conflict);
    ignorance.add(mass.unknown);
    const auto normal = evidence::without_conflict(mass);
    const double occupied = normal ? normal->occupied + 0.5 * normal->unknown : 0.5;
    const bool wall = is == State::kOccupied;
    brier.add((occupied - wall) * (occupied - wall));
    log_loss.add(-std::log(std::max(1e-6, wall ? occupied : 1.0 - occupied)));
    if (says == State::kOccupied)
      contour.add(nearest_m(cell, map.georeference.resolution_m,
                            [&](CellIndex other) { return real.at(other) == State::kOccupied; }));
    if (wall) missed.add(nearest_m(cell, map.georeference.resolution_m, says_wall));
  });
  if (score.cells == 0)
    throw std::invalid_argument("no cell that the map saw is known to the truth: are both in the same frame?");
  score.brier = brier.value();
  score.log_loss = log_loss.value();
  score.conflict = conflict.value();
  score.ignorance = ignorance.value();
  score.contour_m = contour.value();
  score.missed_m = missed.value();
  return score;
}

}  // namespace credo::evaluation
