// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/cell_kernels.hpp"

namespace credo::mapping {

/// Evidence of whole regions that a map has still to take in, kept as what changes where the columns of the map enter
/// and leave them: a region costs what its outline costs, not its area, and many regions are taken in at once. Evidence
/// is a sum, so the map is the same to the bit as if each had been taken in when it came.
class PendingRegions {
 public:
  /// A rectangle of tiles.
  struct TileBox {
    grids::TileIndex low, high;  ///< both included
  };

  /// Makes ready for a set of regions that do not overlap and lie in a box. The grid takes in what is pending before
  /// sums leave their range, and before there is more of it than fits the cache.
  void begin_set(grids::EvidentialGrid& grid, const TileBox& box);
  /// Where the grid might soon be full it takes the set in at once.
  /// \throws std::length_error if it is: it is unchanged then
  void end_set(grids::EvidentialGrid& grid);

  /// Evidence for all cells of a column from a row up: what a region holds where the column enters it, and the same
  /// with the other sign where it leaves it. Precondition: inside the box.
  void change(std::int32_t column, std::int32_t row, const Quad& by) { tile_at(column, row).change(column, row, by); }
  /// The tile that a cell is in. Precondition: inside the box.
  [[nodiscard]] TileChanges& tile_at(std::int32_t column, std::int32_t row) {
    std::unique_ptr<TileChanges>& tile = tiles_[place_of(grids::tile_of({column, row}))];
    if (tile == nullptr) [[unlikely]]
      tile = fresh_tile();
    return *tile;
  }

  /// The grid takes in all that is pending. It has room for it, as end_set() has seen.
  void settle(grids::EvidentialGrid& grid);

 private:
  [[nodiscard]] std::size_t place_of(grids::TileIndex tile) const {
    return static_cast<std::size_t>(tile.x * rows_ + tile.y - first_);
  }
  void reach(const TileBox& box);
  [[nodiscard, gnu::noinline]] std::unique_ptr<TileChanges> fresh_tile();
  void settle_into(grids::EvidentialGrid& grid);

  TileBox box_;
  std::int64_t rows_ = 0, first_ = 0;  // of tiles in the box; the place of its lowest, were the box at (0, 0)
  std::vector<std::unique_ptr<TileChanges>> tiles_;  // of the box, column after column; null: nothing was changed there
  std::vector<std::unique_ptr<TileChanges>> unused_;
  int sets_ = 0;
  std::size_t tiles_claimed_ = 0;  // that the grid may need at most
};

}  // namespace credo::mapping
