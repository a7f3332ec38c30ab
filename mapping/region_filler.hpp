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

/// Adds evidence to all cells whose centres lie in regions of the plane, row by row. A region is a class, given by the
/// chains of corners that bound it; a cell is inside if they wind around it. Where regions overlap the higher class
/// counts: every cell is updated once.
class RegionFiller {
 public:
  static constexpr int kClasses = 64;
  static constexpr int kOutside = kClasses;  ///< what lies beside a chain that bounds one region only

  /// The classes to the left and to the right of a chain, seen along it.
  struct Sides {
    int left = kOutside;
    int right = kOutside;
  };

  /// In cells: cell (i, j) spans [i, i+1) x [j, j+1).
  struct Corner {
    double x = 0.0;
    double y = 0.0;
  };

  void clear();

  /// More corners of the chain at hand.
  void add_corner(const Corner& corner);
  void add_corners(std::span<const double> x, std::span<const double> y);
  /// Ends the chain at hand. All the chains of a class together must bound it: each corner is entered as often as left.
  void end_chain(Sides sides);
  /// A chain of two corners.
  void add_edge(const Corner& from, const Corner& to, Sides sides);
  /// A closed chain around a class: the last corner is joined to the first.
  void add_contour(std::span<const Eigen::Vector2d> corners, int region_class);

  /// Adds increments[class] to every cell inside, then forgets the chains.
  /// \throws std::length_error if the grid may not grow as far; a part of the cells may have been filled.
  void fill(grids::EvidentialGrid& grid, std::span<const evidence::FixedLogCommonality> increments);

 private:
  struct Chain {
    std::size_t begin, end;  ///< of its corners
    Sides sides;
  };
  /// From left to right across an edge: the class before it and the one behind it.
  struct Passage {
    std::int16_t leave, enter;
  };
  /// An edge that crosses rows: from corner `from` to the next.
  struct Edge {
    std::uint32_t from;
    Passage passage;
  };
  /// Where a row crosses an edge.
  struct Crossing {
    std::int32_t column;  ///< the first cell whose centre is not left of the edge
    Passage passage;
  };
  struct Winding;

  void measure();
  [[nodiscard]] std::span<const Edge> select_edges();
  void cross_rows(std::span<const Edge> edges);
  [[gnu::always_inline]] static inline void sort(std::span<Crossing> crossings);
  [[gnu::always_inline]] static inline void resolve(std::span<Crossing> crossings);
  void find_stretches(std::int32_t row, std::span<Crossing> crossings);
  void add_stretches(grids::EvidentialGrid& grid, std::int32_t tile_row,
                     std::span<const evidence::FixedLogCommonality> increments);

  std::vector<double> x_, y_;  // the corners
  std::vector<Chain> chains_;
  std::size_t chain_begin_ = 0;

  std::vector<std::int32_t> rows_;             // first_centre of the heights of the corners
  std::vector<double> slopes_;                 // of the edges that begin there, along a row for each row
  std::vector<std::int32_t> first_columns_;    // and where they cross their lowest row
  std::int32_t first_row_ = 0, last_row_ = 0;  // of all corners
  std::int32_t first_tile_column_ = 0, last_tile_column_ = 0;
  std::vector<Edge> edges_;
  std::vector<Crossing> crossings_;  // by row
  std::vector<std::uint32_t> row_end_;
  std::vector<std::vector<Stretch>> stretches_;  // of a row of tiles, by their column
};

}  // namespace credo::mapping
