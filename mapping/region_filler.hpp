// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/cell_kernels.hpp"

namespace credo::mapping {

/// Adds evidence to all cells whose centres lie in regions of the plane, row by row. A region is a class, given by
/// closed contours; a cell is inside if the contours wind around it. Where regions overlap the higher class counts:
/// every cell is updated once.
class RegionFiller {
 public:
  static constexpr int kClasses = 64;

  RegionFiller() { clear(); }
  void clear();

  /// A closed contour of a class, in cells: cell (i, j) spans [i, i+1) x [j, j+1). The last corner is joined to the
  /// first.
  void add_contour(std::span<const Eigen::Vector2d> corners, int region_class);

  /// Adds increments[class] to every cell inside, then forgets the contours.
  /// \throws std::length_error if the grid may not grow as far; a part of the cells may have been filled.
  void fill(grids::EvidentialGrid& grid, std::span<const evidence::FixedLogCommonality> increments);

 private:
  /// Where a row crosses an edge.
  struct Crossing {
    std::int32_t column;  ///< the first cell whose centre is not left of the edge
    std::int16_t region_class;
    std::int16_t direction;  ///< +1: the edge goes up
  };
  struct Winding;

  void add_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::int32_t row_from, std::int32_t row_to,
                std::int16_t region_class);
  void sort_by_row();
  void find_stretches(std::int32_t row, std::span<Crossing> crossings);
  void add_stretches(grids::EvidentialGrid& grid, std::int32_t tile_row,
                     std::span<const evidence::FixedLogCommonality> increments);

  std::vector<Crossing> crossings_;
  std::vector<std::int32_t> crossing_rows_;
  std::int32_t first_row_ = 0, last_row_ = 0;  ///< of the corners
  std::vector<Crossing> sorted_;
  std::vector<std::uint32_t> row_begin_;
  std::int32_t first_tile_column_ = 0;
  std::vector<std::vector<Stretch>> stretches_;  ///< of a row of tiles, by their column
};

}  // namespace credo::mapping
