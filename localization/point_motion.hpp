// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <span>

#include "geometry/pose.hpp"

namespace credo::localization {

/// The same place of the world, seen from two poses of the robot.
struct PointPair {
  Eigen::Vector2d before = Eigen::Vector2d::Zero();             ///< (X', Y'), in the base frame of the earlier scan [m]
  Eigen::Vector2d now = Eigen::Vector2d::Zero();                ///< (X, Y), in that of the later one [m]
  Eigen::Matrix2d before_covariance = Eigen::Matrix2d::Zero();  ///< each in its own frame [m^2]
  Eigen::Matrix2d now_covariance = Eigen::Matrix2d::Zero();
};

/// The motion (delta x, delta y, delta theta) of Li X. 2006, eq. (13): the robot has turned by `dtheta`, and what was
/// at p' is now at Rot(-dtheta) p' + (dx, dy). [m, m, rad]
struct PointMotion {
  double dx = 0.0;
  double dy = 0.0;
  double dtheta = 0.0;

  /// The same as a pose: T_before_now of the base.
  [[nodiscard]] geometry::Pose2 T_before_now() const { return geometry::Pose2{dx, dy, -dtheta}.inverse(); }
};

/// The least squares of Li X. 2006, eqs. (13)-(15), in closed form.
/// \throws std::invalid_argument  for points that are not finite, or all at one place: they do not tell a turn
[[nodiscard]] PointMotion point_motion(std::span<const PointPair> pairs);

/// T_before_now with the covariance that the points' covariances give it to first order; the pairs are independent.
/// The closed form weighs all pairs alike, and this is the covariance of that estimate, not of the best one.
/// \throws std::invalid_argument  likewise
[[nodiscard]] geometry::PoseEstimate point_motion_estimate(std::span<const PointPair> pairs);

}  // namespace credo::localization
