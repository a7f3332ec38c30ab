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

namespace {

[[gnu::always_inline]] inline double middle(double a, double b) { return 0.5 * (a + b); }

}  // namespace

/// What an edge changes.
Quad RegionFiller::change_of(const Passage& passage, const Increments& increments) {
  return increments[static_cast<std::size_t>(passage.enter)].quad() -
         increments[static_cast<std::size_t>(passage.leave)].quad();
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

/// The columns and rows of all edges, without a branch, so that it is done many at a time. Between the chains there are
/// edges which are none.
void RegionFiller::measure() {
  const std::size_t count = x_.size();
  columns_.resize(count);
  slopes_.resize(count);
  first_rows_.resize(count);
  const double *x = x_.data(), *y = y_.data();
  std::int32_t* const columns = columns_.data();
  double* const slopes = slopes_.data();
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
        tiles_ = {{(low_row - 1) >> kShift, low_column >> kShift}, {(high_row + 1) >> kShift, high_column >> kShift}};
        for (std::size_t i = 0; i + 1 < count; ++i) {
          const double x0 = x[i], y0 = y[i], x1 = x[i + 1], y1 = y[i + 1];
          const bool right = x0 < x1;  // both directions must cross a column at the same place
          const double left_x = right ? x0 : x1, left_y = right ? y0 : y1;
          const double right_x = right ? x1 : x0, right_y = right ? y1 : y0;
          const std::int32_t from = columns[i], to = columns[i + 1];
          const double centre = (from < to ? from : to) + 0.5, width = right_x - left_x;
          const double slope = (right_y - left_y) / (width > 0.0 ? width : 1.0);
          slopes[i] = slope;
          rows[i] = first_centre(centre < middle(left_x, right_x) ? left_y + (centre - left_x) * slope
                                                                  : right_y - (right_x - centre) * slope);
        }
      });
}

/// Where an edge crosses a column, reckoned from its nearer end: edges that meet in a corner come there in their order,
/// even if it is the centre of a cell.
std::int32_t RegionFiller::row_at(std::size_t edge, std::int32_t column) const {
  const std::size_t left = edge + (columns_[edge] < columns_[edge + 1] ? 0 : 1), right = 2 * edge + 1 - left;
  const double centre = column + 0.5;
  return first_centre(centre < middle(x_[left], x_[right]) ? y_[left] + (centre - x_[left]) * slopes_[edge]
                                                           : y_[right] - (x_[right] - centre) * slopes_[edge]);
}

std::span<RegionFiller::Edge> RegionFiller::select_edges() {
  if (edges_.size() < x_.size()) edges_.resize(x_.size());
  std::size_t count = 0;
  for (const Chain& chain : chains_) {
    const auto left = static_cast<std::int16_t>(chain.sides.left), right = static_cast<std::int16_t>(chain.sides.right);
    const Passage rightwards{right, left}, leftwards{left, right};
    for (std::size_t i = chain.begin; i + 1 < chain.end; ++i) {
      edges_[count] = {static_cast<std::uint32_t>(i), columns_[i] < columns_[i + 1] ? rightwards : leftwards};
      count += columns_[i] != columns_[i + 1];
    }
  }
  return std::span(edges_).first(count);
}

/// Crossings of all columns: counted first, then put where they belong.
void RegionFiller::cross_columns(std::span<const Edge> edges) {
  column_end_.assign(static_cast<std::size_t>(last_column_ - first_column_) + 1, 0);
  for (const Edge& edge : edges) {
    const auto [low, high] = std::minmax(columns_[edge.from], columns_[edge.from + 1]);
    ++column_end_[low - first_column_];
    --column_end_[high - first_column_];
  }
  std::uint32_t in_column = 0, total = 0;
  for (std::uint32_t& end : column_end_) {
    in_column += end;
    end = total;  // where the column begins; it moves on to the end with every crossing
    total += in_column;
  }
  crossings_.resize(total);
  for (const Edge& edge : edges) {
    const auto [first, last] = std::minmax(columns_[edge.from], columns_[edge.from + 1]);
    Crossing crossing{first_rows_[edge.from], edge.passage};
    crossings_[column_end_[first - first_column_]++] = crossing;
    for (std::int32_t column = first + 1; column < last; ++column) {
      crossing.row = row_at(edge.from, column);
      crossings_[column_end_[column - first_column_]++] = crossing;
    }
  }
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
void RegionFiller::add_column(std::int32_t column, std::span<Crossing> crossings, PendingRegions& pending,
                              const Increments& increments) {
  sort(crossings);
  resolve(crossings);
  Quad here{};
  for (const Crossing& crossing : crossings) {
    const Quad above = increments[static_cast<std::size_t>(crossing.passage.enter)].quad();
    pending.change(column, crossing.row, above - here);
    here = above;
  }
}

void RegionFiller::fill_overlapping(PendingRegions& pending, const Increments& increments) {
  cross_columns(select_edges());
  std::uint32_t begin = 0;
  for (std::int32_t column = first_column_; column < last_column_; ++column) {
    const std::uint32_t end = column_end_[column - first_column_];
    add_column(column, std::span(crossings_).subspan(begin, end - begin), pending, increments);
    begin = end;
  }
}

/// Where no region overlaps another the order of the crossings does not matter.
void RegionFiller::fill_apart(PendingRegions& pending, const Increments& increments) {
  std::size_t wide = 0;
  const std::span<Edge> edges = select_edges();
  for (const Edge& edge : edges) {  // most cross one column: those that cross more are put first
    const auto [first, last] = std::minmax(columns_[edge.from], columns_[edge.from + 1]);
    pending.change(first, first_rows_[edge.from], change_of(edge.passage, increments));
    edges[wide] = edge;
    wide += last - first > 1;
  }
  for (const Edge& edge : edges.first(wide)) {
    const std::size_t i = edge.from, left = i + (columns_[i] < columns_[i + 1] ? 0 : 1), right = 2 * i + 1 - left;
    const double left_x = x_[left], left_y = y_[left], right_x = x_[right], right_y = y_[right], slope = slopes_[i];
    const Quad change = change_of(edge.passage, increments);
    const std::int32_t last = columns_[right], half = std::min(last, first_centre(middle(left_x, right_x)));
    std::int32_t column = columns_[left] + 1;
    for (; column < half; ++column)
      pending.change(column, first_centre(left_y + (column + 0.5 - left_x) * slope), change);
    for (; column < last; ++column)
      pending.change(column, first_centre(right_y - (right_x - (column + 0.5)) * slope), change);
  }
}

void RegionFiller::fill(grids::EvidentialGrid& grid, PendingRegions& pending, const Increments& increments,
                        Regions regions) {
  if (x_.empty()) return;
  measure();
  pending.begin_set(grid, tiles_);
  if (regions == Regions::kApart)
    fill_apart(pending, increments);
  else
    fill_overlapping(pending, increments);
  clear();
  pending.end_set(grid);
}

}  // namespace credo::mapping
