// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/region_filler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "grids/instructions.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

namespace {

constexpr std::size_t kBits = 64;  // of a word of edges_

template <typename Real>
[[gnu::always_inline]] inline Real middle(Real a, Real b) {
  return 0.5F * (a + b);
}

using Rows = grids::Lanes;
constexpr Rows kSteps{0, 1, 2, 3, 4, 5, 6, 7};
using Places [[gnu::vector_size(32)]] = float;

/// first_centre of each.
[[gnu::always_inline]] inline void first_centres(const Places& coordinates, Rows& first) {
  const Places centres = coordinates - 0.5F;
  const Rows towards_zero = __builtin_convertvector(centres, Rows);
  first = towards_zero - (__builtin_convertvector(towards_zero, Places) < centres);  // -1 where true
}

}  // namespace

/// An edge that crosses columns, seen from left to right.
struct RegionFiller::Line {
  std::int32_t first, last;  ///< columns that it crosses: from the first to before the last
  float left_x, left_y, right_x, right_y, slope;

  /// Where it crosses columns, reckoned from its nearer end: edges that meet in a corner come there in their order,
  /// even if it is the centre of a cell.
  [[gnu::always_inline]] void rows_from(std::int32_t column, Rows& rows) const {
    const Places centres = __builtin_convertvector(column + kSteps, Places) + 0.5F;
    const Places from_left = left_y + (centres - left_x) * slope, from_right = right_y - (right_x - centres) * slope;
    first_centres(centres < middle(left_x, right_x) ? from_left : from_right, rows);
  }
};

RegionFiller::Line RegionFiller::line_of(std::size_t edge) const {
  const std::size_t left = edge + (columns_[edge] < columns_[edge + 1] ? 0 : 1), right = 2 * edge + 1 - left;
  return {columns_[left], columns_[right], x_[left], y_[left], x_[right], y_[right], slopes_[edge]};
}

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

void RegionFiller::clear(grids::CellIndex base) {
  base_ = base;
  x_.clear();
  y_.clear();
  chain_of_.clear();
  chains_.clear();
}

void RegionFiller::add_contour(std::span<const Corner> corners, int region_class) {
  if (corners.empty()) return;
  for (const Corner& corner : corners) add_corner(corner);
  add_corner(corners.front());
  end_chain({.left = region_class});
}

/// The columns and rows of all edges, without a branch, so that it is done many at a time. Between the chains there are
/// edges which are none.
void RegionFiller::measure() {
  const std::size_t count = x_.size();
  columns_.resize(count);
  slopes_.resize(count);
  first_rows_.resize(count);
  const float *x = x_.data(), *y = y_.data();
  std::int32_t* const columns = columns_.data();
  float* const slopes = slopes_.data();
  std::int32_t* const rows = first_rows_.data();
  grids::run_with(
      grids::best_instructions(), [ this, count, x, y, columns, slopes, rows ]() __attribute__((always_inline)) {
        constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min(),
                               kMost = std::numeric_limits<std::int32_t>::max();
        std::int32_t low_row = kMost, high_row = kLeast, low_column = kMost, high_column = kLeast;
        for (std::size_t i = 0; i < count; ++i) {
          const std::int32_t column = first_centre(x[i]), row = first_centre(y[i]);
          columns[i] = column;
          low_row = std::min(low_row, row);
          high_row = std::max(high_row, row);
          low_column = std::min(low_column, column);
          high_column = std::max(high_column, column);
        }
        first_column_ = low_column;
        last_column_ = high_column;
        constexpr int kShift = grids::Tile::kShift;  // crossings may be rounded beyond the corners
        tiles_ = {{(base_.y + low_row - 1) >> kShift, (base_.x + low_column) >> kShift},
                  {(base_.y + high_row + 1) >> kShift, (base_.x + high_column) >> kShift}};
        for (std::size_t i = 0; i + 1 < count; ++i) {
          const float x0 = x[i], y0 = y[i], x1 = x[i + 1], y1 = y[i + 1];
          const bool right = x0 < x1;  // both directions must cross a column at the same place
          const float left_x = right ? x0 : x1, left_y = right ? y0 : y1;
          const float right_x = right ? x1 : x0, right_y = right ? y1 : y0;
          const std::int32_t from = columns[i], to = columns[i + 1];
          const float first = static_cast<float>(from < to ? from : to) + 0.5F, width = right_x - left_x;
          const float centre = std::min(std::max(first, left_x), right_x);  // beside steep edges no row fits
          const float slope = (right_y - left_y) / (width > 0.0F ? width : 1.0F);
          slopes[i] = slope;
          rows[i] = first_centre(centre < middle(left_x, right_x) ? left_y + (centre - left_x) * slope
                                                                  : right_y - (right_x - centre) * slope);
        }
      });
}

/// Which edges cross columns: those between the chains do not. Sixty-four at a time, so that most, which cross none,
/// cost next to nothing.
void RegionFiller::mark_edges() {
  const std::size_t count = columns_.size();
  edges_.resize(count / kBits + 1);
  const std::int32_t* const columns = columns_.data();
  const std::uint32_t* const chains = chain_of_.data();
  grids::run_with(
      grids::best_instructions(), [ this, count, columns, chains ]() __attribute__((always_inline)) {
        std::array<std::uint8_t, kBits> crosses;
        const auto mark = [&](std::size_t edge, std::size_t k) __attribute__((always_inline)) {
          crosses[k] = (columns[edge] != columns[edge + 1]) & (chains[edge] == chains[edge + 1]);
        };
        for (std::size_t begin = 0; begin < count; begin += kBits) {
          if (begin + kBits < count) {
            for (std::size_t k = 0; k < kBits; ++k) mark(begin + k, k);
          } else {
            crosses = {};
            for (std::size_t edge = begin; edge + 1 < count; ++edge) mark(edge, edge - begin);
          }
          std::uint64_t bits = 0;
          for (std::size_t k = 0; k < kBits; k += 8) {
            std::uint64_t eight;  // 0 or 1 each
            std::memcpy(&eight, crosses.data() + k, sizeof(eight));
            bits |= (eight * 0x0102040810204080U >> 56U) << k;
          }
          edges_[begin / kBits] = bits;
        }
      });
}

/// Calls visit(edge) for each edge that crosses a column.
template <typename Visit>
void RegionFiller::for_each_edge(const Visit& visit) const {
  for (std::size_t word = 0; word * kBits < columns_.size(); ++word)
    for (std::uint64_t bits = edges_[word]; bits != 0; bits &= bits - 1)
      visit(word * kBits + static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Crossings of all columns: counted first, then put where they belong.
void RegionFiller::cross_columns() {
  column_end_.assign(static_cast<std::size_t>(last_column_ - first_column_) + 1, 0);
  for_each_edge([&](std::size_t edge) {
    const auto [low, high] = std::minmax(columns_[edge], columns_[edge + 1]);
    ++column_end_[low - first_column_];
    --column_end_[high - first_column_];
  });
  std::uint32_t in_column = 0, total = 0;
  for (std::uint32_t& end : column_end_) {
    in_column += end;
    end = total;  // where the column begins; it moves on to the end with every crossing
    total += in_column;
  }
  crossings_.resize(total);
  for_each_edge([&](std::size_t edge) {
    const auto [first, last] = std::minmax(columns_[edge], columns_[edge + 1]);
    const Sides& sides = chains_[chain_of_[edge]];
    const auto left = static_cast<std::int16_t>(sides.left), right = static_cast<std::int16_t>(sides.right);
    const bool rightwards = columns_[edge] < columns_[edge + 1];
    Crossing crossing{first_rows_[edge], rightwards ? Passage{right, left} : Passage{left, right}};
    crossings_[column_end_[first - first_column_]++] = crossing;
    const Line line = line_of(edge);
    for (std::int32_t column = first + 1; column < last; column += grids::kLanes) {
      Rows rows;
      line.rows_from(column, rows);
      for (int k = 0; k < std::min(grids::kLanes, last - column); ++k) {
        crossing.row = rows[k];
        crossings_[column_end_[column + k - first_column_]++] = crossing;
      }
    }
  });
}

/// Columns hold a few crossings, in nearly the right order: insertion sort.
void RegionFiller::sort(std::span<Crossing> crossings) {
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const Crossing crossing = crossings[i];
    std::size_t place = i;
    for (; place > 0 && crossing.row < crossings[place - 1].row; --place) crossings[place] = crossings[place - 1];
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

/// Adds what changes along a column.
void RegionFiller::add_column(std::int32_t column, std::span<Crossing> crossings, const PendingRegions::Writer& pending,
                              const Increments& increments) const {
  sort(crossings);
  resolve(crossings);
  Quad here{};
  for (const Crossing& crossing : crossings) {
    const Quad above = increments[static_cast<std::size_t>(crossing.passage.enter)].quad();
    pending.change(pending.spot(base_.x + column, base_.y + crossing.row), above - here);
    here = above;
  }
}

void RegionFiller::fill_overlapping(PendingRegions& pending, const Increments& increments) {
  cross_columns();
  std::uint32_t begin = 0;
  for (std::int32_t column = first_column_; column < last_column_; ++column) {
    const std::uint32_t end = column_end_[column - first_column_];
    add_column(column, std::span(crossings_).subspan(begin, end - begin), pending.writer(), increments);
    begin = end;
  }
}

/// Where no region overlaps another the order of the crossings does not matter. Most edges cross one column: those that
/// cross more are set aside.
/// \return how many columns those cross then
std::size_t RegionFiller::cross_first_columns(PendingRegions& pending, const Increments& increments) {
  changes_.resize(2 * chains_.size());
  Quad* const changes = changes_.data();
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    const Quad rightwards = increments[static_cast<std::size_t>(chains_[i].left)].quad() -
                            increments[static_cast<std::size_t>(chains_[i].right)].quad();
    changes[2 * i] = rightwards;
    changes[2 * i + 1] = -rightwards;
  }
  const PendingRegions::Writer writer = pending.writer();
  const std::int32_t *const columns = columns_.data(), *const rows = first_rows_.data();
  const std::uint32_t* const chains = chain_of_.data();
  if (long_edges_.size() < x_.size()) long_edges_.resize(x_.size());
  LongEdge* next = long_edges_.data();
  std::size_t later = 0;
  for_each_edge([&](std::size_t edge) {
    const std::int32_t from = columns[edge], to = columns[edge + 1];
    const std::uint32_t change = 2 * chains[edge] + (from < to ? 0 : 1);
    const std::int32_t more = std::abs(to - from) - 1;
    writer.change(writer.spot(base_.x + std::min(from, to), base_.y + rows[edge]), changes[change]);
    *next = {static_cast<std::uint32_t>(edge), change};
    next += more > 0;
    later += static_cast<std::size_t>(more);
  });
  long_count_ = static_cast<std::size_t>(next - long_edges_.data());
  return later;
}

/// The columns that long edges cross after their first. They are found eight at a time, for most edges all at once, and
/// written down: how many an edge crosses is not to be guessed in the inner loops.
void RegionFiller::cross_later_columns(PendingRegions& pending, std::size_t count) {
  const PendingRegions::Writer writer = pending.writer();
  for (std::vector<std::int32_t>* values : {&later_tiles_, &later_places_, &later_changes_})
    if (values->size() < count + grids::kLanes) values->resize(count + grids::kLanes);
  std::int32_t *const tiles = later_tiles_.data(), *const places = later_places_.data(),
                      *const changes = later_changes_.data();
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
        std::size_t next = 0;
        const auto store = [](const Rows& values, std::int32_t* to) __attribute__((always_inline)) {
          std::memcpy(to, &values, sizeof(values));
        };
        for (const LongEdge& edge : std::span(long_edges_).first(long_count_)) {
          const Line line = line_of(edge.from);
          for (std::int32_t column = line.first + 1; column < line.last; column += grids::kLanes) {
            Rows rows;
            line.rows_from(column, rows);
            const auto spots = writer.spot(Rows(base_.x + column + kSteps), Rows(base_.y + rows));
            store(spots.tile, tiles + next);
            store(spots.place, places + next);
            store(static_cast<std::int32_t>(edge.change) + Rows{}, changes + next);
            next += static_cast<std::size_t>(std::min(grids::kLanes, line.last - column));
          }
        }
      });
  const Quad* const change = changes_.data();
  for (std::size_t i = 0; i < count; ++i) writer.change({tiles[i], places[i]}, change[changes[i]]);
}

void RegionFiller::fill_apart(PendingRegions& pending, const Increments& increments) {
  cross_later_columns(pending, cross_first_columns(pending, increments));
}

void RegionFiller::fill(grids::EvidentialGrid& grid, PendingRegions& pending, const Increments& increments,
                        Regions regions) {
  if (x_.empty()) return;
  measure();
  mark_edges();
  pending.begin_set(grid, tiles_);
  if (regions == Regions::kApart)
    fill_apart(pending, increments);
  else
    fill_overlapping(pending, increments);
  clear();
  pending.end_set(grid);
}

}  // namespace credo::mapping
