// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <vector>

#include "grids/evidential_grid.hpp"

namespace credo::mapping {

/// The first column, or row, whose centre is not below a coordinate in cells.
template <std::floating_point Real>
[[nodiscard]] std::int32_t first_centre(Real coordinate) {
  const Real centre = coordinate - Real{0.5};
  const auto towards_zero = static_cast<std::int32_t>(centre);
  return towards_zero + (static_cast<Real>(towards_zero) < centre
                             ? 1
                             : 0);  // the ceiling, without a call where SSE 4.1 is not assumed
}

/// The tiles of a grid under a rectangle of cells, looked up once each and made when first written to.
class TileWindow {
 public:
  /// Points the window at another rectangle; keeps its memory.
  void open(grids::EvidentialGrid& grid, const grids::CellBox& box) {
    grid_ = &grid;
    low_ = grids::tile_of(box.min);
    const grids::TileIndex high = grids::tile_of({box.min.x + box.width - 1, box.min.y + box.height - 1});
    columns_ = high.x - low_.x + 1;
    tiles_.assign(static_cast<std::size_t>(columns_) * (high.y - low_.y + 1), nullptr);
  }

  /// Calls write(tile, place, count) for each stretch of the cells [begin, end) of a row that lies in one tile: `count`
  /// neighbouring cells from `place` in the tile's arrays. The cells must be inside the rectangle.
  template <typename Write>
  void for_run(int row, int begin, int end, Write write) {
    const std::size_t line = static_cast<std::size_t>((row >> grids::Tile::kShift) - low_.y) * columns_;
    while (begin < end) {
      const int column = begin >> grids::Tile::kShift;
      const int stop = std::min(end, (column + 1) << grids::Tile::kShift);
      grids::Tile*& tile = tiles_[line + (column - low_.x)];
      if (tile == nullptr) tile = &grid_->tile({row >> grids::Tile::kShift, column});
      write(*tile, grids::place_in_tile({begin, row}), stop - begin);
      begin = stop;
    }
  }

 private:
  grids::EvidentialGrid* grid_ = nullptr;
  grids::TileIndex low_;
  int columns_ = 0;
  std::vector<grids::Tile*> tiles_;
};

}  // namespace credo::mapping
