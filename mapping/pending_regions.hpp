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

  /// Writes changes down, until the next set begins. Evidence for all cells of a column from a row up: what a region
  /// holds where the column enters it, and the same with the other sign where it leaves it. Cells must be inside the
  /// box.
  class Writer {
   public:
    /// Of a cell, its tile in the box and its place in there.
    template <typename Numbers>
    struct Spot {
      Numbers tile, place;
    };
    /// Of one cell, or of many at a time.
    template <typename Numbers>
    [[nodiscard, gnu::always_inline]] Spot<Numbers> spot(const Numbers& column, const Numbers& row) const {
      constexpr int kShift = grids::Tile::kShift, kMask = grids::Tile::kSide - 1;
      return {((column >> kShift) - low_.x) * rows_ + (row >> kShift) - low_.y,
              (row & kMask) << kShift | (column & kMask)};
    }
    [[gnu::always_inline]] void change(const Spot<std::int32_t>& spot, const Quad& by) const {
      std::unique_ptr<TileChanges>& tile = tiles_[spot.tile];
      if (tile == nullptr) [[unlikely]]
        tile = pending_->fresh_tile();
      tile->change(spot.place, by);
    }

   private:
    friend class PendingRegions;
    explicit Writer(PendingRegions& pending)
        : tiles_(pending.tiles_.data()), low_(pending.box_.low), rows_(pending.rows_), pending_(&pending) {}

    std::unique_ptr<TileChanges>* tiles_;
    grids::TileIndex low_;
    std::int32_t rows_;
    PendingRegions* pending_;
  };
  [[nodiscard]] Writer writer() { return Writer(*this); }

  /// The grid takes in all that is pending. It has room for it, as end_set() has seen.
  void settle(grids::EvidentialGrid& grid);

 private:
  [[nodiscard]] std::size_t place_of(grids::TileIndex tile) const {
    return static_cast<std::size_t>((tile.x - box_.low.x) * rows_ + tile.y - box_.low.y);
  }
  void reach(const TileBox& box);
  [[nodiscard, gnu::noinline]] std::unique_ptr<TileChanges> fresh_tile();
  void settle_into(grids::EvidentialGrid& grid);

  TileBox box_;
  std::int32_t rows_ = 0;                            // of tiles in the box
  std::vector<std::unique_ptr<TileChanges>> tiles_;  // of the box, column after column; null: nothing was changed there
  std::vector<std::unique_ptr<TileChanges>> unused_;
  int sets_ = 0;
  std::size_t tiles_claimed_ = 0;  // that the grid may need at most
};

}  // namespace credo::mapping
