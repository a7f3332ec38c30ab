// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/tile_window.hpp"

namespace credo::mapping {

Fan::Fan(const grids::Georeference& georeference, const geometry::Pose2& pose, double half_width_rad, double reach_m)
    : x_((pose.x - georeference.origin_x_m) / georeference.resolution_m),
      y_((pose.y - georeference.origin_y_m) / georeference.resolution_m),
      axis_x_(std::cos(pose.theta)),
      axis_y_(std::sin(pose.theta)),
      radius_(reach_m / georeference.resolution_m) {
  const double c = std::cos(half_width_rad), s = std::sin(half_width_rad);
  const double right_x = axis_x_ * c + axis_y_ * s, left_x = axis_x_ * c - axis_y_ * s;
  const double right_y = axis_y_ * c - axis_x_ * s + 0.0, left_y = axis_y_ * c + axis_x_ * s + 0.0;  // no -0.0

  // Between the apex, the corners, and where the arc points straight up or down.
  low_ = radius_ * (right_x < 0.0 && left_x > 0.0 ? -1.0 : std::min({0.0, right_y, left_y}));
  high_ = radius_ * (right_x > 0.0 && left_x < 0.0 ? 1.0 : std::max({0.0, right_y, left_y}));

  // Inside is what lies to the left of the right edge, and to the right of the left one, seen from the apex.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Bound right{right_x / right_y, 0.0}, left{left_x / left_y, 0.0};
  const Bound lowest{0.0, -kInfinity}, highest{0.0, kInfinity};
  low_by_right_ = right_y >= 0.0 ? lowest : right;
  low_by_left_ = left_y >= 0.0 ? left : lowest;
  high_by_right_ = right_y >= 0.0 ? right : highest;
  high_by_left_ = left_y >= 0.0 ? highest : left;
}

CellRun Fan::rows() const { return {first_centre(y_ + low_), first_centre(y_ + high_)}; }

}  // namespace credo::mapping
