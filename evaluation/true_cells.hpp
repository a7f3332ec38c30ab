// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "datasets/map_server.hpp"
#include "geometry/floor_plan.hpp"
#include "grids/evidential_grid.hpp"

namespace credo::evaluation {

/// Cells that a wall may be off, diagonals included, and still be right.
inline constexpr int kWallTolerance = 1;

/// All cells of a true map, turned or not.
[[nodiscard]] grids::CellBox box_of(const datasets::OccupancyMap& truth, const grids::Georeference& georeference);

/// Whether holds(other) for a cell within so many of `cell`, diagonals included.
template <typename Holds>
[[nodiscard]] bool any_within(grids::CellIndex cell, int within, const Holds& holds) {
  for (int dy = -within; dy <= within; ++dy)
    for (int dx = -within; dx <= within; ++dx)
      if (holds(grids::CellIndex{cell.x + dx, cell.y + dy})) return true;
  return false;
}

/// The states of the true cells under a map, at its resolution.
class TrueCells {
 public:
  enum class State : std::uint8_t { kUnknown, kEmpty, kOccupied };
  static constexpr std::size_t kMostCells = std::size_t{1} << 26;  ///< a square of 400 m with cells of 5 cm

  /// \param truth  of any resolution and origin, turned or not. A cell is what its centre is in truth, and a wall where
  ///               a true wall cell's centre lies in it.
  TrueCells(const datasets::OccupancyMap& truth, const grids::Georeference& georeference, const grids::CellBox& box);
  /// A cell is a wall if one passes through it, and empty otherwise, within the rectangle around all walls, `margin`
  /// cells wider on each side. Precondition: the plan has a wall.
  TrueCells(const geometry::FloorPlan& plan, const grids::Georeference& georeference, const grids::CellBox& box,
            int margin);

  [[nodiscard]] State at(grids::CellIndex cell) const { return box_.contains(cell) ? states_[place(cell)] : State{}; }
  /// Whether a cell within so many, diagonals included, is in a state.
  [[nodiscard]] bool near(grids::CellIndex cell, State state, int within) const {
    return any_within(cell, within, [&](grids::CellIndex other) { return at(other) == state; });
  }
  [[nodiscard]] const grids::CellBox& box() const { return box_; }

 private:
  void set(grids::CellIndex cell, State state) {
    if (box_.contains(cell)) states_[place(cell)] = state;
  }
  [[nodiscard]] std::size_t place(grids::CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  grids::CellBox box_;
  std::vector<State> states_;
};

/// The box with a margin on every side.
[[nodiscard]] grids::CellBox widened(const grids::CellBox& box, int margin);

/// Calls visit(CellIndex) for each cell of a box, row by row.
template <typename Visit>
void for_each_cell(const grids::CellBox& box, const Visit& visit) {
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) visit(grids::CellIndex{x, y});
}

}  // namespace credo::evaluation
