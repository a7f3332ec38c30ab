// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace credo::evaluation {
namespace {

using grids::CellIndex;
using State = TrueCells::State;

constexpr double kFarthest_m = 0.5;

State said(const evidence::GridMass& mass) {
  if (mass.occupied == mass.empty) return State::kUnknown;
  return mass.occupied > mass.empty ? State::kOccupied : State::kEmpty;
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

MapScore map_score(const grids::MassMap& map, const datasets::OccupancyMap& truth) {
  const int margin = kWallTolerance + static_cast<int>(std::ceil(kFarthest_m / map.georeference.resolution_m));
  const TrueCells real(truth, map.georeference, widened(map.box, margin));
  const auto says_wall = [&](CellIndex cell) { return map.saw(cell) && said(map.at(cell)) == State::kOccupied; };
  const auto says_wall_near = [&](CellIndex cell) { return any_within(cell, kWallTolerance, says_wall); };
  MapScore score;
  Mean brier, log_loss, conflict, ignorance, contour, missed;
  for_each_cell(map.box, [&](CellIndex cell) {
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
