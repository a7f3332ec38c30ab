// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// Parallel lanes, up and down, over all that a robot can reach: the exploration that Li X. 2006 calls "Z", also known
/// as boustrophedon (Choset and Pignon 1997).
struct Lanes {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< where the robot sets out; a lane goes through it
  double heading_rad = 0.0;                         ///< in which it sets out; the lanes lie along it
  double spacing_m = 1.0;                           ///< between neighbouring lanes
  double margin_m = 0.1;                            ///< at least, between the robot and all that ever stands there
};

/// The waypoints of a sweep. A lane ends before what stands in its way and goes on behind it. From the end of a stretch
/// the robot drives to the nearest end of another one, around what stands between them, until all are driven: one side
/// of an obstacle, or one room, and then the next. A stretch shorter than half of the spacing is left out: its
/// neighbours see it. The same world gives the same way.
/// \param world  its building, robot and sensors; its path is not looked at
/// \throws std::invalid_argument  where the robot does not fit at the start, or no stretch is long enough
[[nodiscard]] std::vector<Waypoint> sweep_in_lanes(const World& world, const Lanes& lanes);

}  // namespace credo::sim
