// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace credo::evaluation {
namespace {

using evidence::FixedLogCommonality;
using grids::CellBox;
using grids::CellIndex;
using grids::EvidentialGrid;

enum class Truth : std::uint8_t { kUnknown, kEmpty, kOccupied };

/// Something known of every cell of a rectangle, and a default outside.
template <typename Value>
struct Plane {
  CellBox box;
  std::vector<Value> values;

  Plane(const CellBox& where, Value value)
      : box(where), values(static_cast<std::size_t>(where.width) * where.height, value) {}

  [[nodiscard]] std::size_t place(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box.min.y) * box.width + (cell.x - box.min.x);
  }
  [[nodiscard]] Value at(CellIndex cell) const { return box.contains(cell) ? values[place(cell)] : Value{}; }
  void set(CellIndex cell, Value value) {
    if (box.contains(cell)) values[place(cell)] = value;
  }
  /// Whether a cell within `tolerance` cells, diagonals included, has the value.
  [[nodiscard]] bool near(CellIndex cell, Value value, int tolerance) const {
    for (int dy = -tolerance; dy <= tolerance; ++dy)
      for (int dx = -tolerance; dx <= tolerance; ++dx)
        if (at({cell.x + dx, cell.y + dy}) == value) return true;
    return false;
  }
};

/// The rectangle with a margin on every side.
CellBox widened(const CellBox& box, int margin) {
  return {{box.min.x - margin, box.min.y - margin}, box.width + 2 * margin, box.height + 2 * margin};
}

CellBox checked_box(const EvidentialGrid& map, const MapAccuracyParams& params) {
  if (params.tolerance_cells < 0) throw std::invalid_argument("map accuracy: tolerance_cells must not be negative");
  if (map.bounding_box().empty())
    throw std::invalid_argument("the map holds no evidence: nothing can be compared with the truth");
  return grids::picture_box(map);
}

MapAccuracy compare(const EvidentialGrid& map, const CellBox& box, const Plane<Truth>& truth,
                    const MapAccuracyParams& params) {
  // q(occupied) > q(empty) if and only if m(occupied) > m(empty), normalised or not.
  Plane<Truth> said(box, Truth::kUnknown);
  Plane<bool> observed(box, false);
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) {
      const FixedLogCommonality cell = map.at({x, y});
      observed.set({x, y}, cell != FixedLogCommonality{});
      if (cell.occupied != cell.empty) said.set({x, y}, cell.occupied > cell.empty ? Truth::kOccupied : Truth::kEmpty);
    }
  MapAccuracy result;
  const int tolerance = params.tolerance_cells;
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) {
      const CellIndex cell{x, y};
      const Truth real = truth.at(cell);
      if (!observed.at(cell) || real == Truth::kUnknown) continue;
      ++result.observed;
      const grids::CellState state = grids::decide(map.at(cell), params.decision);
      result.withheld += state == grids::CellState::kUnknown || state == grids::CellState::kContested;
      switch (said.at(cell)) {
        case Truth::kUnknown: ++result.undecided; break;
        case Truth::kOccupied:
          ++(truth.near(cell, Truth::kOccupied, tolerance) ? result.correct : result.wrongly_occupied);
          break;
        case Truth::kEmpty:
          ++(real == Truth::kEmpty || said.near(cell, Truth::kOccupied, tolerance) ? result.correct
                                                                                   : result.wrongly_empty);
          break;
      }
    }
  for (int y = truth.box.min.y; y < truth.box.min.y + truth.box.height; ++y)
    for (int x = truth.box.min.x; x < truth.box.min.x + truth.box.width; ++x) {
      if (truth.at({x, y}) != Truth::kOccupied || !observed.near({x, y}, true, tolerance)) continue;
      ++result.surface;
      result.surface_found += said.near({x, y}, Truth::kOccupied, tolerance);
    }
  if (result.observed == 0)
    throw std::invalid_argument("no cell that the map observed is known to the truth: are both in the same frame?");
  return result;
}

Truth truth_of(std::int8_t cell) {
  if (cell < 0) return Truth::kUnknown;
  return cell >= 50 ? Truth::kOccupied : Truth::kEmpty;
}

}  // namespace

MapAccuracy map_accuracy(const EvidentialGrid& map, const datasets::OccupancyMap& truth,
                         const MapAccuracyParams& params) {
  const CellBox box = checked_box(map, params);
  const grids::Georeference& reference = map.georeference();
  const geometry::Pose2 T_map_truth{truth.origin_x_m, truth.origin_y_m, truth.origin_yaw_rad};
  const geometry::Pose2 T_truth_map = T_map_truth.inverse();
  Plane<Truth> real(widened(box, params.tolerance_cells), Truth::kUnknown);
  for (int y = real.box.min.y; y < real.box.min.y + real.box.height; ++y)
    for (int x = real.box.min.x; x < real.box.min.x + real.box.width; ++x) {
      const Eigen::Vector2d p = (T_truth_map * reference.centre({x, y})) / truth.resolution_m;
      const double column = std::floor(p.x()), row = std::floor(p.y());
      if (column < 0.0 || row < 0.0 || column >= truth.width || row >= truth.height) continue;
      real.set({x, y}, truth_of(truth.at(static_cast<int>(column), static_cast<int>(row))));
    }
  // A true map finer than ours: a wall thinner than our cells is a wall, even where no centre falls on it.
  for (int row = 0; row < truth.height; ++row)
    for (int column = 0; column < truth.width; ++column) {
      if (truth_of(truth.at(column, row)) != Truth::kOccupied) continue;
      const Eigen::Vector2d centre(truth.resolution_m * (column + 0.5), truth.resolution_m * (row + 0.5));
      real.set(reference.cell_at(T_map_truth * centre), Truth::kOccupied);
    }
  return compare(map, box, real, params);
}

MapAccuracy map_accuracy(const EvidentialGrid& map, const geometry::FloorPlan& plan, const MapAccuracyParams& params) {
  if (plan.walls.empty()) throw std::invalid_argument("the floor plan has no wall to compare the map with");
  const CellBox box = checked_box(map, params);
  const grids::Georeference& reference = map.georeference();
  CellBox known;
  for (const geometry::Segment& wall : plan.walls)
    for (const Eigen::Vector2d& end : {wall.a, wall.b}) known = known.united({reference.cell_at(end), 1, 1});
  known = widened(known, params.tolerance_cells);

  Plane<Truth> real(widened(box, params.tolerance_cells), Truth::kUnknown);
  for (int y = real.box.min.y; y < real.box.min.y + real.box.height; ++y)
    for (int x = real.box.min.x; x < real.box.min.x + real.box.width; ++x)
      if (known.contains({x, y})) real.set({x, y}, Truth::kEmpty);
  constexpr int kStepsPerCell = 8;
  for (const geometry::Segment& wall : plan.walls) {
    const auto steps = 1 + static_cast<std::int64_t>(wall.length() / reference.resolution_m * kStepsPerCell);
    for (std::int64_t step = 0; step <= steps; ++step)
      real.set(reference.cell_at(wall.a + (wall.b - wall.a) * (static_cast<double>(step) / static_cast<double>(steps))),
               Truth::kOccupied);
  }
  return compare(map, box, real, params);
}

std::ostream& operator<<(std::ostream& out, const MapAccuracy& a) {
  return out << "accuracy " << a.accuracy() << " of " << a.observed << " observed cells; undecided "
             << a.undecided_share() << ", withheld " << a.withheld_share() << "; wrongly empty " << a.wrongly_empty
             << ", wrongly occupied " << a.wrongly_occupied << "; walls found " << a.surface_found << " of "
             << a.surface;
}

}  // namespace credo::evaluation
