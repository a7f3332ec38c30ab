// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/pose.hpp"
#include "grids/georeference.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

/// A row of cells [begin, end).
struct CellRun {
  int begin = 0;
  int end = 0;
};

/// The cone of a transducer on a grid, in cells: from the apex at (x, y) to the arc of a radius, between two edges.
class Fan {
 public:
  /// \param T_map_transducer  its x axis is the axis of the cone
  /// \param half_width_rad    of the cone, below pi / 2
  Fan(const grids::Georeference& georeference, const geometry::Pose2& T_map_transducer, double half_width_rad,
      double reach_m);

  [[nodiscard]] double x() const { return x_; }
  [[nodiscard]] double y() const { return y_; }
  [[nodiscard]] double axis_x() const { return axis_x_; }
  [[nodiscard]] double axis_y() const { return axis_y_; }

  /// The rows that the fan may touch.
  [[nodiscard]] CellRun rows() const;
  /// The cells of a row whose centres lie in the fan; begin >= end where none does.
  [[nodiscard]] CellRun run(int row) const;

 private:
  double x_, y_;            // apex
  double axis_x_, axis_y_;  // unit vector
  double radius_;
  double low_, high_;  // of the rows, from the apex
  // Where the edges cross a row, per row above the apex; infinite for level ones.
  double right_slope_, left_slope_;
  bool right_is_high_, left_is_low_;  // which end of a row the edges bound
};

inline CellRun Fan::run(int row) const {
  const double dy = row + 0.5 - y_;
  const double half = std::sqrt(std::max(0.0, radius_ * radius_ - dy * dy));
  // In this order, a nan, of a level edge in its own row, bounds nothing.
  const double right = dy * right_slope_, left = dy * left_slope_;
  const double low = std::max(std::max(-half, right_is_high_ ? -half : right), left_is_low_ ? left : -half);
  const double high = std::min(std::min(half, right_is_high_ ? right : half), left_is_low_ ? half : left);
  const bool some = low < high;  // no branch: it would be hard to foretell
  return {first_centre(x_ + (some ? low : 0.0)), first_centre(x_ + (some ? high : 0.0))};
}

}  // namespace credo::mapping
