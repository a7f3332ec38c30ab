// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/region_filler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>

#include "grids/instructions.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

using evidence::FixedLogCommonality;

namespace {

/// Rows that fill a tile from side to side follow one another in its arrays: they become one stretch.
void append(std::vector<Stretch>& stretches, int place, int count, int region_class) {
  if (count == grids::Tile::kSide && !stretches.empty()) {
    Stretch& last = stretches.back();
    if (last.place + last.count == place && last.region_class == region_class) {
      last.count = static_cast<std::int16_t>(last.count + count);
      return;
    }
  }
  stretches.push_back({static_cast<std::int16_t>(place), static_cast<std::int16_t>(count), region_class});
}

}  // namespace

/// How often the chains of each class wind around the place between two crossings.
struct RegionFiller::Winding {
  std::array<std::int16_t, kClasses + 1> turns{};
  std::uint64_t inside = 0;  ///< bit c: turns[c] != 0

  void turn(int region_class, int by) {
    turns[region_class] = static_cast<std::int16_t>(turns[region_class] + by);
    const std::uint64_t bit = std::uint64_t{region_class < kClasses} << (region_class % kClasses);
    inside = turns[region_class] != 0 ? inside | bit : inside & ~bit;
  }
  void cross(const Passage& passage) {
    turn(passage.leave, -1);
    turn(passage.enter, 1);
  }
  [[nodiscard]] int highest() const { return inside != 0 ? static_cast<int>(std::bit_width(inside)) - 1 : kOutside; }
};

void RegionFiller::clear() {
  x_.clear();
  y_.clear();
  chains_.clear();
  chain_begin_ = 0;
}

void RegionFiller::add_corner(const Corner& corner) {
  x_.push_back(corner.x);
  y_.push_back(corner.y);
}

void RegionFiller::add_corners(std::span<const double> x, std::span<const double> y) {
  x_.insert(x_.end(), x.begin(), x.end());
  y_.insert(y_.end(), y.begin(), y.end());
}

void RegionFiller::end_chain(Sides sides) {
  assert(sides.left >= 0 && sides.left <= kOutside && sides.right >= 0 && sides.right <= kOutside);
  chains_.push_back({chain_begin_, x_.size(), sides});
  chain_begin_ = x_.size();
}

void RegionFiller::add_edge(const Corner& from, const Corner& to, Sides sides) {
  add_corner(from);
  add_corner(to);
  end_chain(sides);
}

void RegionFiller::add_contour(std::span<const Eigen::Vector2d> corners, int region_class) {
  if (corners.empty()) return;
  for (const Eigen::Vector2d& corner : corners) add_corner({corner.x(), corner.y()});
  add_corner({corners.front().x(), corners.front().y()});
  end_chain({.left = region_class});
}

/// The rows and columns of all edges, without a branch, so that it is done many at a time. Between the chains there are
/// edges which are none.
void RegionFiller::measure() {
  const std::size_t count = x_.size();
  rows_.resize(count);
  slopes_.resize(count);
  first_columns_.resize(count);
  const double *x = x_.data(), *y = y_.data();
  std::int32_t* const rows = rows_.data();
  double* const slopes = slopes_.data();
  std::int32_t* const columns = first_columns_.data();
  grids::run_with(
      grids::best_instructions(), [ this, count, x, y, rows, slopes, columns ]() __attribute__((always_inline)) {
        constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min(),
                               kMost = std::numeric_limits<std::int32_t>::max();
        std::int32_t low_row = kMost, high_row = kLeast, low_column = kMost, high_column = kLeast;
        for (std::size_t i = 0; i < count; ++i) {
          const std::int32_t column = first_centre(x[i]), row = first_centre(y[i]);
          rows[i] = row;
          low_row = std::min(low_row, row);
          high_row = std::max(high_row, row);
          low_column = std::min(low_column, column);
          high_column = std::max(high_column, column);
        }
        first_row_ = low_row;
        last_row_ = high_row;
        first_tile_column_ = (low_column - 1) >> grids::Tile::kShift;  // crossings may be rounded beyond the corners
        last_tile_column_ = (high_column + 1) >> grids::Tile::kShift;
        for (std::size_t i = 0; i + 1 < count; ++i) {
          const bool up = rows[i] < rows[i + 1];  // both directions of an edge must cross a row at the same place
          const double low_x = up ? x[i] : x[i + 1], high_x = up ? x[i + 1] : x[i];
          const double low_y = up ? y[i] : y[i + 1], high_y = up ? y[i + 1] : y[i];
          const std::int32_t row = std::min(rows[i], rows[i + 1]);
          const double slope = rows[i] != rows[i + 1] ? (high_x - low_x) / (high_y - low_y) : 0.0;
          slopes[i] = slope;
          columns[i] = first_centre(low_x + (row + 0.5 - low_y) * slope);
        }
      });
}

/// The edges that cross rows; most scans have many corners to a row.
std::span<const RegionFiller::Edge> RegionFiller::select_edges() {
  if (edges_.size() < x_.size()) edges_.resize(x_.size());
  std::size_t count = 0;
  for (const Chain& chain : chains_) {
    const auto left = static_cast<std::int16_t>(chain.sides.left), right = static_cast<std::int16_t>(chain.sides.right);
    const Passage up{left, right}, down{right, left};
    for (std::size_t i = chain.begin; i + 1 < chain.end; ++i) {
      edges_[count] = {static_cast<std::uint32_t>(i), rows_[i] < rows_[i + 1] ? up : down};
      count += rows_[i] != rows_[i + 1];
    }
  }
  return std::span(edges_).first(count);
}

/// Crossings of all rows: counted first, then put where they belong.
void RegionFiller::cross_rows(std::span<const Edge> edges) {
  row_end_.assign(static_cast<std::size_t>(last_row_ - first_row_) + 1, 0);
  for (const Edge& edge : edges) {
    const auto [low, high] = std::minmax(rows_[edge.from], rows_[edge.from + 1]);
    ++row_end_[low - first_row_];
    --row_end_[high - first_row_];
  }
  std::uint32_t in_row = 0, total = 0;
  for (std::uint32_t& end : row_end_) {
    in_row += end;
    end = total;  // where the row begins; it moves on to the end with every crossing
    total += in_row;
  }
  crossings_.resize(total);
  for (const Edge& edge : edges) {
    const bool up = rows_[edge.from] < rows_[edge.from + 1];
    const std::size_t low = edge.from + (up ? 0 : 1), high = edge.from + (up ? 1 : 0);
    Crossing crossing{first_columns_[edge.from], edge.passage};
    std::int32_t row = rows_[low];
    crossings_[row_end_[row - first_row_]++] = crossing;
    while (++row < rows_[high]) {
      crossing.column = first_centre(x_[low] + (row + 0.5 - y_[low]) * slopes_[edge.from]);
      crossings_[row_end_[row - first_row_]++] = crossing;
    }
  }
}

/// Rows hold a few crossings, in nearly the right order: insertion sort.
void RegionFiller::sort(std::span<Crossing> crossings) {
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const Crossing crossing = crossings[i];
    std::size_t place = i;
    for (; place > 0 && crossing.column < crossings[place - 1].column; --place) crossings[place] = crossings[place - 1];
    crossings[place] = crossing;
  }
}

/// Afterwards each crossing enters the class that counts between it and the next.
void RegionFiller::resolve(std::span<Crossing> crossings) {
  int here = kOutside;
  bool passed_on = true;  // no region overlaps another: what one crossing enters the next one leaves
  for (const Crossing& crossing : crossings) {
    passed_on &= crossing.passage.leave == here;
    here = crossing.passage.enter;
  }
  if (passed_on) return;
  Winding winding;
  for (Crossing& crossing : crossings) {
    winding.cross(crossing.passage);
    crossing.passage.enter = static_cast<std::int16_t>(winding.highest());
  }
}

/// Finds the stretches of one class in a row.
void RegionFiller::find_stretches(std::int32_t row, std::span<Crossing> crossings) {
  sort(crossings);
  resolve(crossings);
  const int row_place = grids::place_in_tile({0, row});
  std::vector<Stretch>* const of_tile = stretches_.data();
  const std::int32_t first_tile = first_tile_column_;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const int region_class = crossings[i].passage.enter;
    if (region_class == kOutside) continue;
    std::int32_t begin = crossings[i].column;
    const std::int32_t end = crossings[i + 1].column;
    for (std::int32_t tile = begin >> grids::Tile::kShift; begin < end; ++tile) {
      const std::int32_t stop = std::min(end, (tile + 1) << grids::Tile::kShift);
      append(of_tile[tile - first_tile], row_place | (begin & (grids::Tile::kSide - 1)), stop - begin, region_class);
      begin = stop;
    }
  }
}

/// Adds the stretches of a row of tiles, tile by tile, and forgets them.
void RegionFiller::add_stretches(grids::EvidentialGrid& grid, std::int32_t tile_row,
                                 std::span<const FixedLogCommonality> increments) {
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (stretches_[i].empty()) continue;
    add_by_class(grid.tile({tile_row, first_tile_column_ + static_cast<std::int32_t>(i)}), stretches_[i], increments);
    stretches_[i].clear();
  }
}

void RegionFiller::fill(grids::EvidentialGrid& grid, std::span<const FixedLogCommonality> increments) {
  if (x_.empty()) return;
  measure();
  cross_rows(select_edges());

  for (std::vector<Stretch>& of_tile : stretches_) of_tile.clear();
  stretches_.resize(static_cast<std::size_t>(last_tile_column_ - first_tile_column_) + 1);
  std::uint32_t begin = 0;
  for (std::int32_t row = first_row_; row < last_row_; ++row) {
    const std::uint32_t end = row_end_[row - first_row_];
    find_stretches(row, std::span(crossings_).subspan(begin, end - begin));
    begin = end;
    const std::int32_t tile_row = row >> grids::Tile::kShift;
    if (row + 1 == last_row_ || (row + 1) >> grids::Tile::kShift != tile_row) add_stretches(grid, tile_row, increments);
  }
  clear();
}

}  // namespace credo::mapping
