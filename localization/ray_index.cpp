// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/ray_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::cross;

/// The shares of a ray's way, from..to, that lie in a rectangle. Empty where from > to.
struct Stretch {
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

Stretch within(const Vector2d& low, const Vector2d& high, const Vector2d& origin, const Vector2d& direction) {
  Stretch stretch;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(direction(axis)) < 1e-12) {
      if (origin(axis) < low(axis) || origin(axis) > high(axis)) return {1.0, 0.0};
      continue;
    }
    const double one = (low(axis) - origin(axis)) / direction(axis),
                 other = (high(axis) - origin(axis)) / direction(axis);
    stretch.from = std::max(stretch.from, std::min(one, other));
    stretch.to = std::min(stretch.to, std::max(one, other));
  }
  return stretch;
}

}  // namespace

RayIndex::RayIndex(std::span<const geometry::Segment> walls) {
  constexpr double kMostCells = 1e6, kMargin_m = 0.01;
  if (walls.empty()) return;
  Vector2d low = walls.front().a, high = low;
  for (const geometry::Segment& wall : walls) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
    const Vector2d along = wall.b - wall.a;
    if (along.norm() > 0.0) walls_.push_back({wall.a, along, wall.normal()});
  }
  origin_ = low - Vector2d::Constant(kMargin_m);
  const Vector2d size = high - low + Vector2d::Constant(2.0 * kMargin_m);
  cell_m_ = std::max(1.0, std::sqrt(size.x() * size.y() / kMostCells));
  columns_ = static_cast<int>(size.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size.y() / cell_m_) + 1;

  std::vector<std::vector<std::uint32_t>> cells(cell(0, rows_));
  for (std::uint32_t w = 0; w < walls_.size(); ++w) {
    const Vector2d a = walls_[w].a - origin_, b = a + walls_[w].along;
    const auto place = [&](double value) { return static_cast<int>(value / cell_m_); };
    for (int row = place(std::min(a.y(), b.y())); row <= place(std::max(a.y(), b.y())); ++row)
      for (int column = place(std::min(a.x(), b.x())); column <= place(std::max(a.x(), b.x())); ++column) {
        const Vector2d corner = cell_m_ * Vector2d(column, row);
        const Vector2d margin = Vector2d::Constant(kMargin_m);
        const Stretch stretch =
            within(corner - margin, corner + Vector2d::Constant(cell_m_) + margin, a, walls_[w].along);
        if (stretch.from <= std::min(1.0, stretch.to)) cells[cell(column, row)].push_back(w);
      }
  }
  for (const auto& members : cells) {
    first_.push_back(static_cast<std::uint32_t>(members_.size()));
    members_.insert(members_.end(), members.begin(), members.end());
  }
  first_.push_back(static_cast<std::uint32_t>(members_.size()));
}

void RayIndex::meet(std::size_t cell, const Vector2d& origin, const Vector2d& direction, RayHit& first) const {
  for (std::uint32_t m = first_[cell]; m < first_[cell + 1]; ++m) {
    const Wall& wall = walls_[members_[m]];
    const double det = cross(direction, wall.along);
    if (std::abs(det) < 1e-12) continue;
    const Vector2d to = wall.a - origin;
    const double range = cross(to, wall.along) / det, share = cross(to, direction) / det;
    if (!(range > 0.0 && range < first.range_m && share >= 0.0 && share <= 1.0)) continue;
    first.range_m = range;
    first.normal = det > 0.0 ? wall.normal : Vector2d(-wall.normal);
  }
}

RayHit RayIndex::cast(const Vector2d& origin, const Vector2d& direction, double max_range_m) const {
  RayHit first;
  if (walls_.empty()) return first;
  const Vector2d size = cell_m_ * Vector2d(columns_, rows_);
  const Vector2d from = origin - origin_;
  Stretch stretch = within(Vector2d::Zero(), size, from, direction);
  stretch.to = std::min(stretch.to, max_range_m);
  if (!(stretch.from <= stretch.to)) return first;

  const Vector2d entry = from + stretch.from * direction;
  const std::array<int, 2> count{columns_, rows_};
  std::array<int, 2> at{}, step{};
  Vector2d next, every;  // way to the next border of a cell, and between two
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    at[k] = std::clamp(static_cast<int>(entry(axis) / cell_m_), 0, count[k] - 1);
    step[k] = direction(axis) < 0.0 ? -1 : 1;
    const bool moves = std::abs(direction(axis)) > 1e-12;
    const double border = cell_m_ * (at[k] + (step[k] > 0 ? 1 : 0));
    every(axis) = moves ? cell_m_ / std::abs(direction(axis)) : std::numeric_limits<double>::infinity();
    next(axis) = moves ? (border - from(axis)) / direction(axis) : std::numeric_limits<double>::infinity();
  }
  for (;;) {
    meet(cell(at[0], at[1]), origin, direction, first);
    const int axis = next.x() < next.y() ? 0 : 1;
    const auto k = static_cast<std::size_t>(axis);
    if (first.range_m <= next(axis) || next(axis) > stretch.to) break;
    at[k] += step[k];
    if (at[k] < 0 || at[k] >= count[k]) break;
    next(axis) += every(axis);
  }
  return first.range_m <= max_range_m ? first : RayHit{};
}

}  // namespace credo::localization
