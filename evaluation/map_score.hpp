// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "datasets/map_server.hpp"
#include "grids/mass_map.hpp"

namespace credo::evaluation {

/// Cells that a wall may be off, diagonals included, and still be right.
inline constexpr int kWallTolerance = 1;

/// All cells of a true map, turned or not.
[[nodiscard]] grids::CellBox box_of(const datasets::OccupancyMap& truth, const grids::Georeference& georeference);

/// The states of the true cells under a map, at its resolution.
class TrueCells {
 public:
  enum class State : std::uint8_t { kUnknown, kEmpty, kOccupied };
  static constexpr std::size_t kMostCells = std::size_t{1} << 26;  ///< a square of 400 m with cells of 5 cm

  /// \param truth  of any resolution and origin, turned or not. A cell is what its centre is in truth, and a wall where
  ///               a true wall cell's centre lies in it.
  TrueCells(const datasets::OccupancyMap& truth, const grids::Georeference& georeference, const grids::CellBox& box);

  [[nodiscard]] State at(grids::CellIndex cell) const { return box_.contains(cell) ? states_[place(cell)] : State{}; }
  /// Whether a cell within so many, diagonals included, is in a state.
  [[nodiscard]] bool near(grids::CellIndex cell, State state, int within) const;
  [[nodiscard]] const grids::CellBox& box() const { return box_; }

 private:
  [[nodiscard]] std::size_t place(grids::CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  grids::CellBox box_;
  std::vector<State> states_;
};

/// A map of any rule against the truth. Cells count that were seen and whose truth is known, but for those more than
/// one cell inside of a solid. Decided is a cell with m(occupied) != m(empty), and right if it says occupied within one
/// cell of a true wall, or empty where it is empty in truth or the map says occupied within one cell.
struct MapScore {
  std::int64_t cells = 0;    ///< that count
  std::int64_t decided = 0;  ///< of them
  std::int64_t right = 0;    ///< of the decided
  double brier = 0.0;        ///< mean square of BetP(occupied) minus the truth (0, 1), all cells that count
  double log_loss = 0.0;     ///< mean -ln of BetP of the truth, at least 1e-6; all cells that count
  double conflict = 0.0;     ///< mean mass of the conflict
  double ignorance = 0.0;    ///< mean mass of the ignorance
  double contour_m = 0.0;    ///< mean distance of the cells said to be occupied from the nearest true wall cell, each
                             ///< at most 0.5 m; nan where none is said to be
  double missed_m = 0.0;  ///< mean distance of the true wall cells beside what was seen from the nearest cell said to
                          ///< be occupied, each at most 0.5 m; nan where there is none

  [[nodiscard]] double decided_share() const { return cells > 0 ? double(decided) / double(cells) : 0.0; }
  [[nodiscard]] double accuracy_of_decided() const { return decided > 0 ? double(right) / double(decided) : 0.0; }
  /// Undecided is wrong.
  [[nodiscard]] double accuracy() const { return cells > 0 ? double(right) / double(cells) : 0.0; }
};

/// \throws std::invalid_argument if no cell that the map saw is known to the truth.
[[nodiscard]] MapScore map_score(const grids::MassMap& map, const datasets::OccupancyMap& truth);

}  // namespace credo::evaluation
