// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>

#include "datasets/map_server.hpp"
#include "evaluation/true_cells.hpp"
#include "grids/mass_map.hpp"

namespace credo::evaluation {

/// A map of any rule against the truth, so that rules can be compared. Unlike map_accuracy, which judges the map that a
/// robot is given, it leaves out what is deep inside of solids, where no rule can be right. Cells count that were seen
/// and whose truth is known, but for those more than one cell inside of a solid. Decided is a cell with m(occupied) !=
/// m(empty), and right if it says occupied within one cell of a true wall, or empty where it is empty in truth or the
/// map says occupied within one cell.
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
