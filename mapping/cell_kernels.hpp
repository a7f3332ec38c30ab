// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "grids/evidential_grid.hpp"
#include "grids/instructions.hpp"

// The inner loops of the painters: evidence added to many cells.
namespace credo::mapping {

/// The three numbers of an increment, and a fourth that makes them one register.
using Quad [[gnu::vector_size(16)]] = std::int32_t;

/// An increment, filled up to the next power of two, so that it is loaded at once.
struct alignas(16) PaddedIncrement {
  evidence::FixedLogCommonality increment;
  std::int32_t unused = 0;

  [[nodiscard]] Quad quad() const { return Quad{increment.empty, increment.occupied, increment.unknown, unused}; }
};

/// What changes, from one cell to the next one up its column, in the evidence of regions that a tile has still to take
/// in.
struct TileChanges {
  struct Change {
    Quad by{};
  };
  alignas(64) std::array<Change, grids::Tile::kCells> cells;
  alignas(64) std::array<bool, grids::Tile::kSide> rows{};  ///< whether something changes in it

  /// Evidence for all cells of a column of the grid from one at a place in this tile up.
  void change(std::int32_t place, const Quad& by) {
    cells[static_cast<std::size_t>(place)].by += by;
    rows[static_cast<std::size_t>(place) >> grids::Tile::kShift] = true;
  }
};

/// Increments of eight cells, by channel.
struct Channels {
  grids::Lanes empty{}, occupied{}, unknown{};
};

/// The evidence of regions along the columns of a tile, going up.
struct RowEvidence {
  std::array<Channels, grids::Tile::kSide / grids::kLanes> cells{};  ///< of one row
  unsigned held = 0;                                                 ///< bit i: cells[i] is not zero
};

/// A tile takes in the regions that cross it. The grid's tile is made when absent and needed.
/// \param changes   in the tile, which are zero afterwards; null: none
/// \param evidence  below the tile; afterwards, at its top
void settle_tile(grids::EvidentialGrid& grid, grids::TileIndex index, TileChanges* changes, RowEvidence& evidence,
                 grids::Instructions instructions = grids::best_instructions());

/// Up to eight neighbouring cells of a row of one tile; the centre of the first from the apex of a fan, in cells.
struct FanBlock {
  grids::Tile* tile = nullptr;
  std::int16_t place = 0;
  std::int16_t count = 0;  ///< 1 to kLanes
  float x = 0.0F;
  float y = 0.0F;
};

/// Increments by distance from the apex, a row of kAngleBins entries each, and by the squared sine of the angle to the
/// axis. Rows are wide at first and fine near the reading: the row of a distance, in cells, is the higher of
/// distance * rows_per_cell and distance * fine_rows_per_cell + first_fine_row.
struct FanTable {
  static constexpr int kAngleBins = 16;  ///< from the axis to the edge

  std::span<const PaddedIncrement> entries;  ///< after the last row comes a vacuous one
  float axis_x = 1.0F;                       ///< unit vector
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
