// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "geometry/segment.hpp"

namespace credo::geometry {

/// The theoretical map that the robot is given: opaque vertical surfaces at the height of the range finder, seen from
/// either side, and vertical marks without relief (door frames). Plain data, in the map frame.
struct FloorPlan {
  std::vector<Segment> walls;
  std::vector<Eigen::Vector2d> verticals;
  double uncertainty_m = 0.0;  ///< 1-sigma of each coordinate of each junction, independent

  friend bool operator==(const FloorPlan&, const FloorPlan&) = default;
};

}  // namespace credo::geometry
