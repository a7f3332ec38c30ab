// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/odometry.hpp"

#include <cmath>

namespace credo::sensors {
namespace {

constexpr double kTranslationFloor_m = 1e-3;
constexpr double kRotationFloor_rad = 5e-4;

}  // namespace

geometry::PoseEstimate OdometryNoise::with_covariance(const geometry::Pose2& T_from_to) const {
  const double distance = std::hypot(T_from_to.x, T_from_to.y);
  const double turn = std::abs(geometry::wrap_angle(T_from_to.theta));
  const double sigma_t = std::hypot(translation_per_metre * distance, kTranslationFloor_m);
  const double sigma_r =
      std::hypot(rotation_per_metre * distance, rotation_per_radian * turn, kRotationFloor_rad);
  geometry::PoseEstimate motion{T_from_to, Eigen::Matrix3d::Zero()};
  // The heading error builds up on the way, so the end of the way is off sideways by half of it on average, with a
  // variance of a third of (heading error * distance)^2 and a covariance of half.
  const Eigen::Vector2d along = T_from_to.translation();
  const Eigen::Vector2d aside(-along.y(), along.x());
  motion.covariance.topLeftCorner<2, 2>() = sigma_t * sigma_t * Eigen::Matrix2d::Identity() +
                                            sigma_r * sigma_r / 3.0 * aside * aside.transpose();
  motion.covariance.topRightCorner<2, 1>() = 0.5 * sigma_r * sigma_r * aside;
  motion.covariance.bottomLeftCorner<1, 2>() = motion.covariance.topRightCorner<2, 1>().transpose();
  motion.covariance(2, 2) = sigma_r * sigma_r;
  return motion;
}

}  // namespace credo::sensors
