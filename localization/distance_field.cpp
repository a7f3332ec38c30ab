// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace credo::localization {

using Eigen::Vector2d;

DistanceField::DistanceField(std::span<const geometry::Segment> walls) {
  constexpr double kMostTiles = 4e6;
  if (walls.empty()) return;
  Vector2d low = walls.front().a, high = low;
  for (const geometry::Segment& wall : walls) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  origin_ = low - Vector2d::Constant(kReach_m);
  const Vector2d size = high - low + Vector2d::Constant(2.0 * kReach_m);
  cells_per_m_ = std::min(cells_per_m_, kTileSide * std::sqrt(kMostTiles / (size.x() * size.y())));
  const auto tiles = [&](double extent_m) { return static_cast<int>(std::ceil(extent_m * cells_per_m_ / kTileSide)); };
  tiles_in_row_ = static_cast<std::size_t>(tiles(size.x()));
  columns_ = kTileSide * tiles(size.x());
  rows_ = kTileSide * tiles(size.y());
  directory_.assign(tiles_in_row_ * static_cast<std::size_t>(tiles(size.y())), -1);
  for (const geometry::Segment& wall : walls) add(wall);
}

/// Row by row, where the wall may be within reach.
void DistanceField::add(const geometry::Segment& wall) {
  const double reach = kReach_m * cells_per_m_;
  const Vector2d a = (wall.a - origin_) * cells_per_m_, b = (wall.b - origin_) * cells_per_m_;
  const auto clamped = [](double value, int end) { return std::clamp(static_cast<int>(value), 0, end); };
  const int first_row = clamped(std::min(a.y(), b.y()) - reach, rows_);
  const int last_row = clamped(std::max(a.y(), b.y()) + reach + 1.0, rows_);
  const double rise = b.y() - a.y();
  for (int row = first_row; row < last_row; ++row) {
    // The part of the wall whose rows are within reach of this one.
    double from = 0.0, to = 1.0;
    if (std::abs(rise) > 1e-9) {
      const double one = (row - reach - a.y()) / rise, other = (row + 1.0 + reach - a.y()) / rise;
      from = std::clamp(std::min(one, other), 0.0, 1.0), to = std::clamp(std::max(one, other), 0.0, 1.0);
    }
    const double x1 = a.x() + from * (b.x() - a.x()), x2 = a.x() + to * (b.x() - a.x());
    const int first = clamped(std::min(x1, x2) - reach, columns_);
    const int last = clamped(std::max(x1, x2) + reach + 1.0, columns_);
    for (int column = first; column < last; ++column) {
      const Vector2d centre = origin_ + Vector2d(column + 0.5, row + 0.5) / cells_per_m_;
      const double units = geometry::distance(centre, wall) / kUnit_m;
      if (units < 255.0) lower(column, row, static_cast<std::uint8_t>(units));
    }
  }
}

void DistanceField::lower(int x, int y, std::uint8_t units) {
  std::int32_t& tile = directory_[directory_place(x, y)];
  if (tile < 0) {
    tile = static_cast<std::int32_t>(cells_.size() >> (2 * kTileBits));
    cells_.resize(cells_.size() + kTileSide * kTileSide, 255);
  }
  std::uint8_t& cell = cells_[cell_place(tile, x, y)];
  cell = std::min(cell, units);
}

}  // namespace credo::localization
