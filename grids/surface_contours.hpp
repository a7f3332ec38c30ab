// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "grids/wall_extraction.hpp"

namespace credo::grids {

/// What extract_walls() sees of a map: which cells are occupied and which are seen to be free.
class WallCells {
 public:
  /// \throws std::invalid_argument if the map is larger than a picture may be
  WallCells(const EvidentialGrid& grid, const WallParams& params);

  /// visit(CellIndex), row after row from the lowest.
  template <typename Visit>
  void for_each_cell(Visit visit) const {
    for (std::int32_t y = box_.min.y; y < box_.min.y + box_.height; ++y)
      for (std::int32_t x = box_.min.x; x < box_.min.x + box_.width; ++x) visit(CellIndex{x, y});
  }
  [[nodiscard]] bool occupied(CellIndex cell) const { return at(cell) > 0.0F; }
  [[nodiscard]] bool free(CellIndex cell) const { return at(cell) < 0.0F; }
  /// Evidence for occupied minus evidence for empty; 0 unknown, or outside. Unlike a probability it tells where of a
  /// wall most was said.
  [[nodiscard]] float at(CellIndex cell) const { return box_.contains(cell) ? balance_[place(cell)] : 0.0F; }

 private:
  [[nodiscard]] std::size_t place(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }
  /// Free space of less than so many cells becomes unknown, and so does what is nowhere three cells wide.
  void drop_small_free_regions(std::size_t least_cells);
  /// What is undecided between a free and an occupied cell becomes free, so that the face of a wall is one.
  void close_seams();

  CellBox box_;
  std::vector<float> balance_;
};

/// Points of surfaces in the order in which one meets them with the solid on the left hand. [m]
using Contour = std::vector<Eigen::Vector2d>;

/// The surfaces of a map: a point for each face between an occupied and a free cell, on the ridge of evidence behind it
/// (WallParams::ridge_cells). Occupied cells that touch at a corner are connected.
[[nodiscard]] std::vector<Contour> surface_contours(const WallCells& cells, const Georeference& georeference,
                                                    int ridge_cells);

}  // namespace credo::grids
