// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/cell_kernels.hpp"
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

  /// In cells from the lower left corner of the base: single precision is enough beside it, and twice as fast.
  struct Corner {
    float x = 0.0F;
    float y = 0.0F;
  };

  /// Forgets the chains. \param base  from which the corners of the next ones are counted
  void clear(grids::CellIndex base = {});

  /// More corners of the chain at hand.
  void add_corner(const Corner& corner) {
    x_.push_back(corner.x);
    y_.push_back(corner.y);
    chain_of_.push_back(static_cast<std::uint32_t>(chains_.size()));
  }
  void add_corners(std::span<const float> x, std::span<const float> y) {
    x_.insert(x_.end(), x.begin(), x.end());
    y_.insert(y_.end(), y.begin(), y.end());
    chain_of_.resize(x_.size(), static_cast<std::uint32_t>(chains_.size()));
  }
  /// Ends the chain at hand. All the chains of a class together must bound it: each corner is entered as often as left.
  void end_chain(const Sides& sides) {
    assert(sides.left >= 0 && sides.left <= kOutside && sides.right >= 0 && sides.right <= kOutside);
    chains_.push_back(sides);
  }
  /// A chain of two corners.
  void add_edge(const Corner& from, const Corner& to, const Sides& sides) {
    add_corner(from);
    add_corner(to);
    end_chain(sides);
  }
  /// A closed chain around a class: the last corner is joined to the first.
  void add_contour(std::span<const Corner> corners, int region_class);

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
  /// Upwards across an edge: the class below it and the one above.
  struct Passage {
    std::int16_t leave, enter;
  };
  /// Where a column crosses an edge.
  struct Crossing {
    std::int32_t row;  ///< the first cell whose centre is not below the edge
    Passage passage;
  };
  struct Winding;
  struct Line;

  /// An edge that crosses more columns than its first, each with one of changes_.
  struct LongEdge {
    std::uint32_t from, change;
  };
  void measure();
  void mark_edges();
  [[nodiscard, gnu::always_inline]] inline Line line_of(std::size_t edge) const;
  template <typename Visit>
  [[gnu::always_inline]] inline void for_each_edge(const Visit& visit) const;
  void cross_columns();
  [[gnu::always_inline]] static inline void sort(std::span<Crossing> crossings);
  [[gnu::always_inline]] static inline void resolve(std::span<Crossing> crossings);
  void add_column(std::int32_t column, std::span<Crossing> crossings, const PendingRegions::Writer& pending,
                  const Increments& increments) const;
  void fill_overlapping(PendingRegions& pending, const Increments& increments);
  void fill_apart(PendingRegions& pending, const Increments& increments);
  [[nodiscard]] std::size_t cross_first_columns(PendingRegions& pending, const Increments& increments);
  void cross_later_columns(PendingRegions& pending, std::size_t count);

  grids::CellIndex base_;     // what follows is counted from there
  std::vector<float> x_, y_;  // the corners
  std::vector<std::uint32_t> chain_of_;
  std::vector<Sides> chains_;

  std::vector<std::int32_t> columns_;                // first_centre of the corners along x
  std::vector<float> slopes_;                        // of the edges that begin there, up a column for each column
  std::vector<std::int32_t> first_rows_;             // and where they cross their first column
  std::int32_t first_column_ = 0, last_column_ = 0;  // of all corners
  PendingRegions::TileBox tiles_;                    // that they are in
  std::vector<std::uint64_t> edges_;                 // bit i of them: edge i crosses a column

  // Where regions may overlap.
  std::vector<Crossing> crossings_;  // by column
  std::vector<std::uint32_t> column_end_;

  // Where they lie apart.
  std::vector<Quad> changes_;
  std::vector<LongEdge> long_edges_;
  std::size_t long_count_ = 0;  // of those
  std::vector<std::int32_t> later_tiles_, later_places_, later_changes_;
};

}  // namespace credo::mapping
