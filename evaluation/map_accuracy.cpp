// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_accuracy.hpp"

#include <ostream>
#include <stdexcept>

#include "evaluation/true_cells.hpp"

namespace credo::evaluation {
namespace {

using evidence::FixedLogCommonality;
using grids::CellBox;
using grids::CellIndex;
using grids::EvidentialGrid;
using State = TrueCells::State;

CellBox checked_box(const EvidentialGrid& map, const MapAccuracyParams& params) {
  if (params.tolerance_cells < 0) throw std::invalid_argument("map accuracy: tolerance_cells must not be negative");
  if (map.bounding_box().empty())
    throw std::invalid_argument("the map holds no evidence: nothing can be compared with the truth");
  return grids::picture_box(map);
}

bool observed(const EvidentialGrid& map, CellIndex cell) { return map.at(cell) != FixedLogCommonality{}; }

/// q(occupied) > q(empty) if and only if m(occupied) > m(empty), normalised or not.
State said_by(const EvidentialGrid& map, CellIndex index) {
  const FixedLogCommonality cell = map.at(index);
  if (cell.occupied == cell.empty) return State::kUnknown;
  return cell.occupied > cell.empty ? State::kOccupied : State::kEmpty;
}

MapAccuracy compare(const EvidentialGrid& map, const CellBox& box, const TrueCells& truth,
                    const MapAccuracyParams& params) {
  const int tolerance = params.tolerance_cells;
  const auto says_wall_near = [&](CellIndex cell) {
    return any_within(cell, tolerance, [&](CellIndex other) { return said_by(map, other) == State::kOccupied; });
  };
  MapAccuracy result;
  for_each_cell(box, [&](CellIndex cell) {
    const State real = truth.at(cell);
    if (!observed(map, cell) || real == State::kUnknown) return;
    ++result.observed;
    const grids::CellState state = grids::decide(map.at(cell), params.decision);
    result.withheld += state == grids::CellState::kUnknown || state == grids::CellState::kContested;
    switch (said_by(map, cell)) {
      case State::kUnknown: ++result.undecided; break;
      case State::kOccupied:
        ++(truth.near(cell, State::kOccupied, tolerance) ? result.correct : result.wrongly_occupied);
        break;
      case State::kEmpty:
        ++(real == State::kEmpty || says_wall_near(cell) ? result.correct : result.wrongly_empty);
        break;
    }
  });
  for_each_cell(truth.box(), [&](CellIndex cell) {
    if (truth.at(cell) != State::kOccupied) return;
    if (!any_within(cell, tolerance, [&](CellIndex other) { return observed(map, other); })) return;
    ++result.surface;
    result.surface_found += says_wall_near(cell);
  });
  if (result.observed == 0)
    throw std::invalid_argument("no cell that the map observed is known to the truth: are both in the same frame?");
  return result;
}

}  // namespace

MapAccuracy map_accuracy(const EvidentialGrid& map, const datasets::OccupancyMap& truth,
                         const MapAccuracyParams& params) {
  const CellBox box = checked_box(map, params);
  return compare(map, box, {truth, map.georeference(), widened(box, params.tolerance_cells)}, params);
}

MapAccuracy map_accuracy(const EvidentialGrid& map, const geometry::FloorPlan& plan, const MapAccuracyParams& params) {
  if (plan.walls.empty()) throw std::invalid_argument("the floor plan has no wall to compare the map with");
  const CellBox box = checked_box(map, params);
  const int margin = params.tolerance_cells;
  return compare(map, box, {plan, map.georeference(), widened(box, margin), margin}, params);
}

std::ostream& operator<<(std::ostream& out, const MapAccuracy& a) {
  return out << "accuracy " << a.accuracy() << " of " << a.observed << " observed cells; undecided "
             << a.undecided_share() << ", withheld " << a.withheld_share() << "; wrongly empty " << a.wrongly_empty
             << ", wrongly occupied " << a.wrongly_occupied << "; walls found " << a.surface_found << " of "
             << a.surface;
}

}  // namespace credo::evaluation
