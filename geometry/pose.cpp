// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/pose.hpp"

#include <ostream>

namespace credo::geometry {

Pose2 interpolate(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrap_angle(a.theta + share * angle_difference(b.theta, a.theta))};
}

PoseEstimate compose(const PoseEstimate& T_a_b, const PoseEstimate& T_b_c) {
  const double c = std::cos(T_a_b.pose.theta), s = std::sin(T_a_b.pose.theta);
  Eigen::Matrix3d by_first = Eigen::Matrix3d::Identity();
  by_first(0, 2) = -s * T_b_c.pose.x - c * T_b_c.pose.y;
  by_first(1, 2) = c * T_b_c.pose.x - s * T_b_c.pose.y;
  Eigen::Matrix3d by_second = Eigen::Matrix3d::Identity();
  by_second.topLeftCorner<2, 2>() << c, -s, s, c;
  return {T_a_b.pose * T_b_c.pose,
          by_first * T_a_b.covariance * by_first.transpose() + by_second * T_b_c.covariance * by_second.transpose()};
}

std::ostream& operator<<(std::ostream& out, const Pose2& pose) {
  return out << "(x " << pose.x << " m, y " << pose.y << " m, theta " << to_degrees(pose.theta) << " deg)";
}

std::ostream& operator<<(std::ostream& out, const PoseEstimate& estimate) {
  return out << estimate.pose << " +- (" << std::sqrt(estimate.covariance(0, 0)) << " m, "
             << std::sqrt(estimate.covariance(1, 1)) << " m, " << to_degrees(std::sqrt(estimate.covariance(2, 2)))
             << " deg)";
}

}  // namespace credo::geometry
