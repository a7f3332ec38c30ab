// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/pose.hpp"
#include "sensors/motion_path.hpp"

namespace credo::sensors {

/// How dead reckoning drifts, 1-sigma after one metre of way or one radian of turning. The errors of successive pieces
/// of the way are independent, so the variance grows with the way, and it does not matter how often odometry is read.
struct OdometryNoise {
  double translation_per_metre = 0.03;
  double rotation_per_metre = 0.02;
  double rotation_per_radian = 0.03;
  /// Of translation_per_metre, across the direction of motion: wheels roll, and hardly slip sideways. 1 for a robot
  /// that can move to all sides. It decides how well the heading of the instruments is learned from driving.
  double lateral_share = 0.1;

  /// Covariance of a measured motion T_from_to, in the frame `from`, plus a floor of 1 mm and 0.5 mrad so that
  /// a robot at rest keeps an invertible covariance.
  [[nodiscard]] geometry::PoseEstimate with_covariance(const geometry::Pose2& T_from_to) const;

  /// T_from_to of the base along a path, with the covariance built up row by row, so that a turn on the spot or a way
  /// there and back counts; the floor comes once. An end between two rows, or beyond them, is less sure: a robot that
  /// speeds up or slows down there is somewhere else than a steady one. Precondition: from <= to.
  [[nodiscard]] geometry::PoseEstimate along(const MotionPath& path, Timestamp from, Timestamp to) const;

  friend bool operator==(const OdometryNoise&, const OdometryNoise&) = default;
};

}  // namespace credo::sensors
