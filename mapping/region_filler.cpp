// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/region_filler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "mapping/tile_window.hpp"

namespace credo::mapping {

using evidence::FixedLogCommonality;

namespace {

/// Rows that fill a tile from side to side follow one another in its arrays: they become one stretch.
void append(std::vector<Stretch>& stretches, int place, int count, int region_class) {
  if (!stretches.empty()) {
    Stretch& last = stretches.back();
    if (last.place + last.count == place && last.region_class == region_class) {
      last.count = static_cast<std::int16_t>(last.count + count);
      return;
    }
  }
  stretches.push_back({static_cast<std::int16_t>(place), static_cast<std::int16_t>(count), region_class});
}

}  // namespace

/// How often the contours of each class wind around the place between two crossings.
struct RegionFiller::Winding {
  std::array<std::int16_t, kClasses> turns{};
  std::uint64_t inside = 0;  ///< bit c: turns[c] != 0

  void cross(const Crossing& crossing) {
    const std::uint64_t bit = std::uint64_t{1} << crossing.region_class;
    std::int16_t& count = turns[crossing.region_class];
    count = static_cast<std::int16_t>(count + crossing.direction);
    inside = count != 0 ? inside | bit : inside & ~bit;
  }
  [[nodiscard]] int highest() const { return static_cast<int>(std::bit_width(inside)) - 1; }
};

void RegionFiller::clear() {
  crossings_.clear();
  crossing_rows_.clear();
  first_row_ = std::numeric_limits<std::int32_t>::max();
  last_row_ = std::numeric_limits<std::int32_t>::min();
}

/// \param row_from, row_to  first_centre of the heights of the ends
void RegionFiller::add_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::int32_t row_from,
                            std::int32_t row_to, std::int16_t region_class) {
  const bool up = row_from < row_to;
  const Eigen::Vector2d& low = up ? from : to;  // both directions of an edge must cross a row at the same place
  const Eigen::Vector2d& high = up ? to : from;
  const double slope = (high.x() - low.x()) / (high.y() - low.y());
  const std::int32_t end = std::max(row_from, row_to);
  for (std::int32_t row = std::min(row_from, row_to); row < end; ++row) {
    const double x = low.x() + (row + 0.5 - low.y()) * slope;
    crossings_.push_back({first_centre(x), region_class, static_cast<std::int16_t>(up ? 1 : -1)});
    crossing_rows_.push_back(row);
  }
}

void RegionFiller::add_contour(std::span<const Eigen::Vector2d> corners, int region_class) {
  assert(region_class >= 0 && region_class < kClasses);
  if (corners.empty()) return;
  std::int32_t first_row = first_row_, last_row = last_row_;
  const Eigen::Vector2d* from = &corners.back();
  std::int32_t row_from = first_centre(from->y());
  for (const Eigen::Vector2d& to : corners) {
    const std::int32_t row_to = first_centre(to.y());
    first_row = std::min(first_row, row_to);
    last_row = std::max(last_row, row_to);
    if (row_to != row_from) add_edge(*from, to, row_from, row_to, static_cast<std::int16_t>(region_class));
    from = &to;
    row_from = row_to;
  }
  first_row_ = first_row;
  last_row_ = last_row;
}

void RegionFiller::sort_by_row() {
  row_begin_.assign(static_cast<std::size_t>(last_row_ - first_row_) + 1, 0);
  for (const std::int32_t row : crossing_rows_) ++row_begin_[row - first_row_ + 1];
  for (std::size_t row = 1; row < row_begin_.size(); ++row) row_begin_[row] += row_begin_[row - 1];
  sorted_.resize(crossings_.size());
  // Places each crossing and moves its row's begin on, so that the begin of a row becomes that of the next.
  for (std::size_t i = 0; i < crossings_.size(); ++i)
    sorted_[row_begin_[crossing_rows_[i] - first_row_]++] = crossings_[i];
  std::rotate(row_begin_.begin(), row_begin_.end() - 1, row_begin_.end());
  row_begin_.front() = 0;
}

/// Finds the stretches of one class in a row.
void RegionFiller::find_stretches(std::int32_t row, std::span<Crossing> crossings) {
  // Rows hold a few crossings, in nearly the right order: insertion sort.
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const Crossing crossing = crossings[i];
    std::size_t place = i;
    for (; place > 0 && crossing.column < crossings[place - 1].column; --place) crossings[place] = crossings[place - 1];
    crossings[place] = crossing;
  }
  Winding winding;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding.cross(crossings[i]);
    if (winding.inside == 0) continue;
    std::int32_t begin = crossings[i].column;
    while (begin < crossings[i + 1].column) {  // tile by tile
      const std::int32_t tile_column = begin >> grids::Tile::kShift;
      const std::int32_t end = std::min(crossings[i + 1].column, (tile_column + 1) << grids::Tile::kShift);
      const int place = grids::place_in_tile({begin, row});
      append(stretches_[tile_column - first_tile_column_], place, end - begin, winding.highest());
      begin = end;
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
  if (crossings_.empty()) return;
  sort_by_row();
  const auto [left, right] = std::minmax_element(
      crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) { return a.column < b.column; });
  first_tile_column_ = left->column >> grids::Tile::kShift;
  const std::int32_t last_tile_column = right->column >> grids::Tile::kShift;
  for (std::vector<Stretch>& of_tile : stretches_) of_tile.clear();
  stretches_.resize(static_cast<std::size_t>(last_tile_column - first_tile_column_) + 1);
  for (std::int32_t row = first_row_; row < last_row_; ++row) {
    const std::uint32_t begin = row_begin_[row - first_row_], end = row_begin_[row - first_row_ + 1];
    find_stretches(row, std::span(sorted_).subspan(begin, end - begin));
    const std::int32_t tile_row = row >> grids::Tile::kShift;
    if (row + 1 == last_row_ || (row + 1) >> grids::Tile::kShift != tile_row) add_stretches(grid, tile_row, increments);
  }
  clear();
}

}  // namespace credo::mapping
