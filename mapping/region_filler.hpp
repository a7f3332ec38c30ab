// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/cell_kernels.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

/// Adds evidence to all cells whose centres lie in regions of the plane, row by row. A region is a class, given by
/// closed contours; a cell is inside if the contours wind around it. Where regions overlap the higher class counts:
/// every cell is updated once.
class RegionFiller {
 public:
  static constexpr int kClasses = 64;

  void clear() { crossings_.clear(); }

  /// A closed contour of a class, in cells: cell (i, j) spans [i, i+1) x [j, j+1). The last corner is joined to the
  /// first.
  void add_contour(std::span<const Eigen::Vector2d> corners, int region_class);

  /// Adds increments[class] to every cell inside, then forgets the contours.
  /// \throws std::length_error if the grid may not grow as far; a part of the cells may have been filled.
  void fill(grids::EvidentialGrid& grid, std::span<const evidence::FixedLogCommonality> increments);

 private:
  struct Crossing {
    std::int32_t row;
    std::int32_t column;  ///< the first cell whose centre is not left of the edge
    std::int16_t region_class;
    std::int16_t direction;  ///< +1: the edge goes up
  };
  struct Winding;

  void add_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::int32_t row_from, std::int32_t row_to,
                std::int16_t region_class);
  void sort_by_row();
  void stretch_row(std::span<Crossing> row);

  std::vector<Crossing> crossings_;
  std::vector<Crossing> sorted_;
  std::vector<std::uint32_t> row_begin_;
  std::int32_t first_row_ = 0;
  std::vector<Stretch> stretches_;
  TileWindow window_;
};

}  // namespace credo::mapping
