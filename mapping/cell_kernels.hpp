// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>

#include "grids/evidential_grid.hpp"
#include "grids/instructions.hpp"

// The inner loops of the painters: evidence added to stretches of cells.
namespace credo::mapping {

/// Cells that follow one another in the arrays of a tile: `count` from `place` on.
struct Stretch {
  std::int16_t place = 0;
  std::int16_t count = 0;         ///< 1 to Tile::kCells
  std::int32_t region_class = 0;  ///< of all its cells
};

/// Adds increments[region_class] to every cell of every stretch.
void add_by_class(grids::Tile& tile, std::span<const Stretch> stretches,
                  std::span<const evidence::FixedLogCommonality> increments,
                  grids::Instructions instructions = grids::best_instructions());

/// Up to eight neighbouring cells of a row of one tile; the centre of the first from the apex of a fan, in cells.
struct FanBlock {
  grids::Tile* tile = nullptr;
  std::int16_t place = 0;
  std::int16_t count = 0;  ///< 1 to kLanes
  float x = 0.0F;
  float y = 0.0F;
};

/// An increment, filled up to the next power of two, so that it is loaded at once.
struct alignas(16) TableEntry {
  evidence::FixedLogCommonality increment;
  std::int32_t unused = 0;
};

/// Increments by distance from the apex, a row of kAngleBins entries each, and by the squared sine of the angle to the
/// axis. Rows are wide at first and fine near the reading: the row of a distance, in cells, is the higher of
/// distance * rows_per_cell and distance * fine_rows_per_cell + first_fine_row.
struct FanTable {
  static constexpr int kAngleBins = 16;  ///< from the axis to the edge

  std::span<const TableEntry> entries;  ///< after the last row comes a vacuous one
  float axis_x = 1.0F;                  ///< unit vector
  float axis_y = 0.0F;
  float rows_per_cell = 1.0F;
  float fine_rows_per_cell = 1.0F;
  float first_fine_row = 0.0F;  ///< below 0; -inf: no row is fine
  float angle_bins = 1.0F;      ///< per squared sine
};

/// Adds to every cell of every block what the table holds for its distance and angle.
void add_from_table(std::span<const FanBlock> blocks, const FanTable& table,
                    grids::Instructions instructions = grids::best_instructions());

}  // namespace credo::mapping
