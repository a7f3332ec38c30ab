// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/wall_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Segment;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kMostSquares = 1e6;
/// A wall is listed in the squares this near to it, too: walls on a border and rays along one are not missed.
constexpr double kBorder_m = 1e-3;

/// Where a ray meets a wall: the distance along the ray, or infinity. [m]
double crossing(const Vector2d& origin, const Vector2d& direction, const Segment& wall) {
  const Vector2d along = wall.b - wall.a, to = wall.a - origin;
  const double det = along.x() * direction.y() - along.y() * direction.x();
  const double share = direction.x() * to.y() - direction.y() * to.x();  // of the wall, times det
  if (std::abs(det) < 1e-12 || std::abs(share) > std::abs(det) || share * det < 0.0) return kNowhere;
  const double distance = (along.x() * to.y() - along.y() * to.x()) / det;
  return distance > 0.0 ? distance : kNowhere;
}

/// A ray's way through the squares of a grid along one axis.
struct AxisWalk {
  int square = 0;
  int step = 0;
  double next = kNowhere;  ///< distance along the ray to the border of the next square [m]
  double growth = 0.0;     ///< from border to border [m]

  /// \param at  where the ray enters the grid, along the axis from its first border [m]
  AxisWalk(double at, double direction, double entered, double side, int squares)
      : square(std::clamp(static_cast<int>(std::floor(at / side)), 0, squares - 1)) {
    if (direction == 0.0) return;
    step = direction > 0.0 ? 1 : -1;
    growth = side / std::abs(direction);
    next = entered + ((square + (direction > 0.0 ? 1 : 0)) * side - at) / direction;
  }
};

/// The part of a ray that lies between two borders along one axis narrows [from, to].
void clip(double origin, double direction, double low, double high, double& from, double& to) {
  if (direction == 0.0) {
    if (origin < low || origin > high) to = -kNowhere;
    return;
  }
  const double one = (low - origin) / direction, other = (high - origin) / direction;
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
}

}  // namespace

WallGrid::WallGrid(std::span<const Segment> walls) {
  if (walls.empty()) return;
  Vector2d low = walls.front().a, high = low;
  for (const Segment& wall : walls) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  origin_ = low - Vector2d::Constant(2.0 * kBorder_m);
  const Vector2d size = high - low + Vector2d::Constant(4.0 * kBorder_m);
  side_m_ = std::max(1.0, std::sqrt(size.x() * size.y() / kMostSquares));
  side_m_ = std::max(side_m_, size.maxCoeff() / kMostSquares);
  columns_ = static_cast<int>(std::ceil(size.x() / side_m_));
  rows_ = static_cast<int>(std::ceil(size.y() / side_m_));
  begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Segment& wall : walls) for_each_square(wall, [this](const Square& at) { ++begin_[place(at) + 1]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  entries_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < walls.size(); ++i)
    for_each_square(walls[i], [&](const Square& at) { entries_[next[place(at)]++] = {walls[i], static_cast<int>(i)}; });
}

WallGrid::Block WallGrid::around(const Vector2d& low, const Vector2d& high) const {
  const auto square = [this](double from_border, int squares) {
    return static_cast<int>(std::clamp(std::floor(from_border / side_m_), -1.0, static_cast<double>(squares)));
  };
  const Vector2d a = low - origin_, b = high - origin_;
  return {{std::max(0, square(a.x(), columns_)), std::max(0, square(a.y(), rows_))},
          {std::min(columns_ - 1, square(b.x(), columns_)), std::min(rows_ - 1, square(b.y(), rows_))}};
}

/// Row by row, from where the wall enters the row to where it leaves it.
template <class Visit>
void WallGrid::for_each_square(const Segment& wall, Visit&& visit) const {
  const Vector2d border = Vector2d::Constant(kBorder_m);
  const double rise = wall.b.y() - wall.a.y();
  const Block whole = around(wall.a.cwiseMin(wall.b) - border, wall.a.cwiseMax(wall.b) + border);
  for (int row = whole.first.row; row <= whole.last.row; ++row) {
    double from = 0.0, to = 1.0;
    if (std::abs(rise) > kBorder_m) {
      const double below = origin_.y() + row * side_m_ - kBorder_m, above = below + side_m_ + 2.0 * kBorder_m;
      const double one = (below - wall.a.y()) / rise, other = (above - wall.a.y()) / rise;
      from = std::clamp(std::min(one, other), 0.0, 1.0), to = std::clamp(std::max(one, other), 0.0, 1.0);
    }
    const Vector2d enters = wall.a + from * (wall.b - wall.a), leaves = wall.a + to * (wall.b - wall.a);
    const Block part = around(enters.cwiseMin(leaves) - border, enters.cwiseMax(leaves) + border);
    for (int column = part.first.column; column <= part.last.column; ++column) visit(Square{column, row});
  }
}

/// From square to square along the ray (Amanatides and Woo, Eurographics 1987).
/// \param visit  takes the square and how far its end is along the ray; tells whether to go on
template <class Visit>
void WallGrid::walk(const Vector2d& origin, const Vector2d& direction, double reach_m, Visit&& visit) const {
  if (entries_.empty()) return;
  const Vector2d size = side_m_ * Vector2d(columns_, rows_), start = origin - origin_;
  double from = 0.0, to = reach_m;
  clip(start.x(), direction.x(), 0.0, size.x(), from, to);
  clip(start.y(), direction.y(), 0.0, size.y(), from, to);
  if (!(from <= to)) return;
  const Vector2d entry = start + from * direction;
  AxisWalk x(entry.x(), direction.x(), from, side_m_, columns_), y(entry.y(), direction.y(), from, side_m_, rows_);
  while (true) {
    const double left = std::min(x.next, y.next);
    if (!visit(Square{x.square, y.square}, left) || left >= to) return;
    AxisWalk& axis = x.next < y.next ? x : y;
    axis.square += axis.step;
    axis.next += axis.growth;
    if (x.square < 0 || x.square >= columns_ || y.square < 0 || y.square >= rows_) return;
  }
}

WallGrid::Met WallGrid::first_wall(const Vector2d& origin, const Vector2d& direction, double reach_m) const {
  Met nearest;
  walk(origin, direction, reach_m, [&](const Square& square, double left) {
    for (const Entry& entry : walls_in(square)) {
      const double range = crossing(origin, direction, entry.wall);
      if (range < nearest.range_m) nearest = {range, &entry.wall};
    }
    return nearest.range_m > left;
  });
  return nearest.range_m < reach_m ? nearest : Met{};
}

bool WallGrid::any_crossing(const Vector2d& origin, const Vector2d& direction, double reach_m) const {
  bool crossed = false;
  walk(origin, direction, reach_m, [&](const Square& square, double) {
    const std::span<const Entry> here = walls_in(square);
    crossed = std::any_of(here.begin(), here.end(),
                          [&](const Entry& entry) { return crossing(origin, direction, entry.wall) < reach_m; });
    return !crossed;
  });
  return crossed;
}

RayHit WallGrid::first_hit(const Vector2d& origin, const Vector2d& direction, double reach_m) const {
  const Met met = first_wall(origin, direction, reach_m);
  if (met.wall == nullptr) return {};
  const Vector2d normal = met.wall->normal();
  return {met.range_m, direction.dot(normal) > 0.0 ? Vector2d(-normal) : normal};
}

bool WallGrid::any_near(const Vector2d& point, double distance_m) const {
  if (entries_.empty()) return false;
  const Vector2d reach = Vector2d::Constant(distance_m);
  const Block block = around(point - reach, point + reach);
  for (int row = block.first.row; row <= block.last.row; ++row)
    for (int column = block.first.column; column <= block.last.column; ++column)
      for (const Entry& entry : walls_in({column, row}))
        if (geometry::distance(point, entry.wall) <= distance_m) return true;
  return false;
}

void WallGrid::list_near(const Vector2d& point, double distance_m, std::vector<int>& indices) const {
  indices.clear();
  if (entries_.empty()) return;
  const Vector2d reach = Vector2d::Constant(distance_m);
  const Block block = around(point - reach, point + reach);
  for (int row = block.first.row; row <= block.last.row; ++row)
    for (int column = block.first.column; column <= block.last.column; ++column)
      for (const Entry& entry : walls_in({column, row})) indices.push_back(entry.index);
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

}  // namespace credo::localization
