// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/georeference.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::grids {

CellBox CellBox::united(const CellBox& other) const {
  if (empty()) return other;
  if (other.empty()) return *this;
  const CellIndex low{std::min(min.x, other.min.x), std::min(min.y, other.min.y)};
  return {low, std::max(min.x + width, other.min.x + other.width) - low.x,
          std::max(min.y + height, other.min.y + other.height) - low.y};
}

CellIndex Georeference::cell_at(const Eigen::Vector2d& point_m) const {
  const double x = std::floor((point_m.x() - origin_x_m) / resolution_m);
  const double y = std::floor((point_m.y() - origin_y_m) / resolution_m);
  if (!(std::abs(x) < kLargestIndex && std::abs(y) < kLargestIndex))
    throw std::out_of_range("the point (" + std::to_string(point_m.x()) + ", " + std::to_string(point_m.y()) +
                            ") m is not on the map: with cells of " + std::to_string(resolution_m) +
                            " m it must be finite and within " + std::to_string(kLargestIndex * resolution_m) +
                            " m of the origin");
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
}

}  // namespace credo::grids
