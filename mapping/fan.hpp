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
  /// Where an edge crosses a row, from the apex: slope * (height of the row above it) + offset. The slope of a level
  /// edge is infinite; so is the offset at an end of the rows that the edge does not bound.
  struct Bound {
    double slope, offset;
  };
  Bound low_by_right_, low_by_left_, high_by_right_, high_by_left_;
};

// Without branches, so that the rows of a fan are done many at a time.
inline CellRun Fan::run(int row) const {
  const auto higher = [](double a, double b) { return a < b ? b : a; };  // a where b is nan
  const auto lower = [](double a, double b) { return b < a ? b : a; };
  const double dy = row + 0.5 - y_;
  const double half = std::sqrt(higher(0.0, radius_ * radius_ - dy * dy));
  // In this order, a nan, of a level edge in its own row, bounds nothing.
  const double low = higher(higher(-half, low_by_right_.slope * dy + low_by_right_.offset),
                            low_by_left_.slope * dy + low_by_left_.offset);
  const double high = lower(lower(half, high_by_right_.slope * dy + high_by_right_.offset),
                            high_by_left_.slope * dy + high_by_left_.offset);
  // Where none does, low is above high; both stay in reach.
  return {first_centre(x_ + lower(low, half)), first_centre(x_ + higher(high, -half))};
}

}  // namespace credo::mapping
