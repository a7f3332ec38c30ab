// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/region_filler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace credo::mapping {

using evidence::FixedLogCommonality;

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
    crossings_.push_back({row, first_centre(x), region_class, static_cast<std::int16_t>(up ? 1 : -1)});
  }
}

void RegionFiller::add_contour(std::span<const Eigen::Vector2d> corners, int region_class) {
  assert(region_class >= 0 && region_class < kClasses);
  if (corners.empty()) return;
  const Eigen::Vector2d* from = &corners.back();
  std::int32_t row_from = first_centre(from->y());
  for (const Eigen::Vector2d& to : corners) {
    const std::int32_t row_to = first_centre(to.y());
    if (row_to != row_from) add_edge(*from, to, row_from, row_to, static_cast<std::int16_t>(region_class));
    from = &to;
    row_from = row_to;
  }
}

void RegionFiller::sort_by_row() {
  const auto [lowest, highest] = std::minmax_element(
      crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) { return a.row < b.row; });
  first_row_ = lowest->row;
  row_begin_.assign(static_cast<std::size_t>(highest->row - first_row_) + 2, 0);
  for (const Crossing& crossing : crossings_) ++row_begin_[crossing.row - first_row_ + 1];
  for (std::size_t row = 1; row < row_begin_.size(); ++row) row_begin_[row] += row_begin_[row - 1];
  sorted_.resize(crossings_.size());
  // Places each crossing and moves its row's begin on, so that the begin of a row becomes that of the next.
  for (const Crossing& crossing : crossings_) sorted_[row_begin_[crossing.row - first_row_]++] = crossing;
  std::rotate(row_begin_.begin(), row_begin_.end() - 1, row_begin_.end());
  row_begin_.front() = 0;
}

/// Finds the stretches of one class in a row.
void RegionFiller::stretch_row(std::span<Crossing> row) {
  // Rows hold a few crossings, in nearly the right order: insertion sort.
  for (std::size_t i = 1; i < row.size(); ++i) {
    for (std::size_t j = i; j > 0 && row[j].column < row[j - 1].column; --j) std::swap(row[j], row[j - 1]);
  }
  Winding winding;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    winding.cross(row[i]);
    if (winding.inside == 0 || row[i].column == row[i + 1].column) continue;
    const int region_class = winding.highest();
    window_.for_run(row[i].row, row[i].column, row[i + 1].column, [&](grids::Tile& tile, int place, int count) {
      stretches_.push_back({&tile, static_cast<std::int16_t>(place), static_cast<std::int16_t>(count), region_class});
    });
  }
}

void RegionFiller::fill(grids::EvidentialGrid& grid, std::span<const FixedLogCommonality> increments) {
  if (crossings_.empty()) return;
  sort_by_row();
  const auto [left, right] = std::minmax_element(
      crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) { return a.column < b.column; });
  const int rows = static_cast<int>(row_begin_.size()) - 1;
  window_.open(grid, {{left->column, first_row_}, std::max(1, right->column - left->column), rows});
  stretches_.clear();
  for (int row = 0; row < rows; ++row)
    stretch_row(std::span(sorted_).subspan(row_begin_[row], row_begin_[row + 1] - row_begin_[row]));
  add_by_class(stretches_, increments);
  clear();
}

}  // namespace credo::mapping
