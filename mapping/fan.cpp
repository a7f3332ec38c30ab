// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/tile_window.hpp"

namespace credo::mapping {
namespace {

/// Narrows [low, high] to the x on the inner side of an edge through the apex: all (x, dy) with
/// cross(edge, (x, dy)) * side >= 0.
void clip(double edge_x, double edge_y, double side, double dy, double& low, double& high) {
  const double slope = -side * edge_y;  // of the cross product in x
  const double constant = side * edge_x * dy;
  if (slope > 0.0)
    low = std::max(low, -constant / slope);
  else if (slope < 0.0)
    high = std::min(high, -constant / slope);
  else if (constant < 0.0)
    high = -std::numeric_limits<double>::infinity();
}

}  // namespace

Fan::Fan(const grids::Georeference& georeference, const geometry::Pose2& pose, double half_width_rad, double reach_m)
    : x_((pose.x - georeference.origin_x_m) / georeference.resolution_m),
      y_((pose.y - georeference.origin_y_m) / georeference.resolution_m),
      axis_x_(std::cos(pose.theta)),
      axis_y_(std::sin(pose.theta)),
      radius_(reach_m / georeference.resolution_m) {
  const double c = std::cos(half_width_rad), s = std::sin(half_width_rad);
  right_x_ = axis_x_ * c + axis_y_ * s;
  right_y_ = axis_y_ * c - axis_x_ * s;
  left_x_ = axis_x_ * c - axis_y_ * s;
  left_y_ = axis_y_ * c + axis_x_ * s;
}

CellRun Fan::rows() const {
  // Between the apex, the corners, and where the arc points straight up or down.
  double low = std::min({0.0, right_y_, left_y_}), high = std::max({0.0, right_y_, left_y_});
  if (right_x_ > 0.0 && left_x_ < 0.0) high = 1.0;
  if (right_x_ < 0.0 && left_x_ > 0.0) low = -1.0;
  return {first_centre(y_ + radius_ * low), first_centre(y_ + radius_ * high)};
}

CellRun Fan::run(int row) const {
  const double dy = row + 0.5 - y_;
  const double half = std::sqrt(std::max(0.0, radius_ * radius_ - dy * dy));
  double low = -half, high = half;
  clip(right_x_, right_y_, 1.0, dy, low, high);
  clip(left_x_, left_y_, -1.0, dy, low, high);
  if (!(low < high)) return {};
  return {first_centre(x_ + low), first_centre(x_ + high)};
}

}  // namespace credo::mapping
