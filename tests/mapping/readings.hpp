// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/angles.hpp"
#include "mapping/mapper.hpp"

// Poses, instruments, and what they read in a room, without noise.
namespace credo::mapping::test {

using evidence::Believed;
using evidence::FixedLogCommonality;
using geometry::Pose2;
using geometry::PoseEstimate;
using geometry::to_radians;

inline constexpr float kInf = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr double kPi = std::numbers::pi;

inline Believed<PoseEstimate> certain(const Pose2& pose) {
  return {{pose, Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}};
}

inline Believed<PoseEstimate> with_sigma(const Pose2& pose, double sigma_m, double sigma_rad) {
  Believed<PoseEstimate> result = certain(pose);
  result.value.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return result;
}

/// 360 beams all round.
inline sensors::RangeFinder panoramic() {
  return {.T_base_sensor = {},
          .height_m = 0.5,
          .angle_min_rad = -kPi,
          .angle_increment_rad = 2.0 * kPi / 360.0,
          .count = 360,
          .range_min_m = 0.1,
          .range_max_m = 8.0,
          .noise = {.sigma_0_m = 0.01, .k_per_m = 0.0},
          .scan_time_s = 0.0,
          .accuracy = {}};
}

inline sensors::SonarRing one_sonar() {
  sensors::SonarRing ring;
  ring.T_base_transducer = {{0.0, 0.0, 0.0}};
  return ring;
}

inline sensors::Rig rig_with(const sensors::RangeFinder& finder) {
  sensors::Rig rig;
  rig.range_finders = {finder};
  return rig;
}

inline sensors::Rig rig_with(const sensors::SonarRing& ring) {
  sensors::Rig rig;
  rig.sonar_rings = {ring};
  return rig;
}

/// Distance to the walls of the room [0, width] x [0, height] from a point within.
inline double distance_to_room(const Eigen::Vector2d& from, double angle, double width, double height) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double along_x = c > 0 ? (width - from.x()) / c : c < 0 ? -from.x() / c : 1e9;
  const double along_y = s > 0 ? (height - from.y()) / s : s < 0 ? -from.y() / s : 1e9;
  return std::min(along_x, along_y);
}

inline sensors::RangeScan scan_of_room(const sensors::RangeFinder& finder, const Pose2& base, double width,
                                       double height) {
  const Pose2 sensor = base * finder.T_base_sensor;
  sensors::RangeScan scan;
  for (int i = 0; i < finder.count; ++i)
    scan.ranges_m.push_back(
        static_cast<float>(distance_to_room(sensor.translation(), sensor.theta + finder.beam_angle(i), width, height)));
  return scan;
}

inline int cells_in(const grids::EvidentialGrid& grid) {
  int count = 0;
  for (const auto& [index, tile] : grid.tiles())
    for (int i = 0; i < grids::Tile::kCells; ++i) count += (tile.empty[i] | tile.occupied[i] | tile.unknown[i]) != 0;
  return count;
}

inline double weight(const FixedLogCommonality& cell) {  // all evidence in a cell
  return evidence::evidence_for_empty(cell.value()) + evidence::evidence_for_occupied(cell.value());
}

}  // namespace credo::mapping::test
