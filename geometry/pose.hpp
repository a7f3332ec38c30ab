// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <iosfwd>

#include "geometry/angles.hpp"

namespace credo::geometry {

/// A planar rigid transform T_a_b: maps coordinates of frame b into frame a. [m, m, rad]
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;

  [[nodiscard]] Eigen::Vector2d translation() const { return {x, y}; }
  [[nodiscard]] Eigen::Matrix2d rotation() const {
    const double c = std::cos(theta), s = std::sin(theta);
    return (Eigen::Matrix2d() << c, -s, s, c).finished();
  }
  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(theta), s = std::sin(theta);
    return {-c * x - s * y, s * x - c * y, -theta};
  }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// T_a_c = T_a_b * T_b_c; theta is wrapped.
[[nodiscard]] inline Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const double c = std::cos(T_a_b.theta), s = std::sin(T_a_b.theta);
  return {T_a_b.x + c * T_b_c.x - s * T_b_c.y, T_a_b.y + s * T_b_c.x + c * T_b_c.y,
          wrap_angle(T_a_b.theta + T_b_c.theta)};
}

/// A point of frame b in frame a.
[[nodiscard]] inline Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(T_a_b.theta), s = std::sin(T_a_b.theta);
  return {T_a_b.x + c * p_b.x() - s * p_b.y(), T_a_b.y + s * p_b.x() + c * p_b.y()};
}

/// The pose at a share of the way from `a` to `b`: straight in x and y, the short way round in theta.
/// \param share  0 gives a, 1 gives b; outside [0, 1] extrapolates.
[[nodiscard]] Pose2 interpolate(const Pose2& a, const Pose2& b, double share);

/// A pose with the covariance of its additive error (x, y, theta), in the frame that the pose is given in:
/// true = pose + error, theta wrapped. [m^2, m rad, rad^2]
struct PoseEstimate {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  friend bool operator==(const PoseEstimate&, const PoseEstimate&) = default;
};

/// T_a_c with first-order covariance, from independent T_a_b and T_b_c.
[[nodiscard]] PoseEstimate compose(const PoseEstimate& T_a_b, const PoseEstimate& T_b_c);

std::ostream& operator<<(std::ostream& out, const Pose2& pose);
std::ostream& operator<<(std::ostream& out, const PoseEstimate& estimate);

}  // namespace credo::geometry
