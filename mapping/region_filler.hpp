// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/pending_regions.hpp"

namespace credo::mapping {

/// Adds evidence to all cells whose centres lie in regions of the plane, column by column. A region is a class, given
/// by the chains of corners that bound it; a cell is inside if they wind around it. Where regions overlap the higher
/// class counts: every cell is updated once.
class RegionFiller {
 public:
  static constexpr int kClasses = 64;
  static constexpr int kOutside = kClasses;  ///< what lies beside a chain that bounds one region only

  /// Of the classes, and nothing for what is outside.
  using Increments = std::array<PaddedIncrement, kClasses + 1>;

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

  /// What is known of the regions.
  enum class Regions {
    kMayOverlap,
    kApart  ///< every place is in one at most, and chains meet in common corners only: nothing need be sorted
  };

  /// Adds increments[class] to every cell inside, then forgets the chains. The grid has it once `pending` is settled.
  /// \throws std::length_error if the grid may not grow as far; it is unchanged then
  void fill(grids::EvidentialGrid& grid, PendingRegions& pending, const Increments& increments,
            Regions regions = Regions::kMayOverlap);

 private:
  struct Chain {
    std::size_t begin, end;  ///< of its corners
    Sides sides;
  };
  /// Upwards across an edge: the class below it and the one above.
  struct Passage {
    std::int16_t leave, enter;
  };
  /// An edge that crosses columns: from corner `from` to the next.
  struct Edge {
    std::uint32_t from;
    Passage passage;
  };
  /// Where a column crosses an edge.
  struct Crossing {
    std::int32_t row;  ///< the first cell whose centre is not below the edge
    Passage passage;
  };
  struct Winding;

  [[nodiscard, gnu::always_inline]] static inline Quad change_of(const Passage& passage, const Increments& increments);
  void measure();
  [[nodiscard, gnu::always_inline]] inline std::int32_t row_at(std::size_t edge, std::int32_t column) const;
  [[nodiscard]] std::span<Edge> select_edges();
  void cross_columns(std::span<const Edge> edges);
  [[gnu::always_inline]] static inline void sort(std::span<Crossing> crossings);
  [[gnu::always_inline]] static inline void resolve(std::span<Crossing> crossings);
  static void add_column(std::int32_t column, std::span<Crossing> crossings, PendingRegions& pending,
                         const Increments& increments);
  void fill_overlapping(PendingRegions& pending, const Increments& increments);
  void fill_apart(PendingRegions& pending, const Increments& increments);

  std::vector<double> x_, y_;  // the corners
  std::vector<Chain> chains_;
  std::size_t chain_begin_ = 0;

  std::vector<std::int32_t> columns_;                // first_centre of the corners along x
  std::vector<double> slopes_;                       // of the edges that begin there, up a column for each column
  std::vector<std::int32_t> first_rows_;             // and where they cross their first column
  std::int32_t first_column_ = 0, last_column_ = 0;  // of all corners
  PendingRegions::TileBox tiles_;                    // that they are in
  std::vector<Edge> edges_;
  std::vector<Crossing> crossings_;  // by column
  std::vector<std::uint32_t> column_end_;
};

}  // namespace credo::mapping
