// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/odometry.hpp"

#include <algorithm>
#include <cmath>

namespace credo::sensors {
namespace {

constexpr double kTranslationFloor_m = 1e-3;
constexpr double kRotationFloor_rad = 5e-4;
/// How much a robot changes its speed between two rows, 1-sigma. [m/s^2, rad/s^2]
constexpr double kAcceleration = 0.5;
constexpr double kTurnAcceleration = 1.0;

/// A straight motion whose heading error builds up on the way: the end of the way is off sideways with a third of the
/// variance of (heading error * distance), and a covariance of half of it.
/// \param lateral_share  OdometryNoise::lateral_share
geometry::PoseEstimate straight(const geometry::Pose2& motion, double variance_per_metre, double lateral_share,
                                double variance_r) {
  geometry::PoseEstimate estimate{motion, Eigen::Matrix3d::Zero()};
  const Eigen::Vector2d along = motion.translation();
  const Eigen::Vector2d aside(-along.y(), along.x());
  const double distance = along.norm();
  const double per_metre = distance > 0.0 ? variance_per_metre / distance : 0.0;
  estimate.covariance.topLeftCorner<2, 2>() =
      per_metre * along * along.transpose() +
      (lateral_share * lateral_share * per_metre + variance_r / 3.0) * aside * aside.transpose();
  estimate.covariance.topRightCorner<2, 1>() = 0.5 * variance_r * aside;
  estimate.covariance.bottomLeftCorner<1, 2>() = estimate.covariance.topRightCorner<2, 1>().transpose();
  estimate.covariance(2, 2) = variance_r;
  return estimate;
}

geometry::PoseEstimate step(const OdometryNoise& noise, const geometry::Pose2& motion) {
  const double distance = std::hypot(motion.x, motion.y);
  const double turn = std::abs(geometry::wrap_angle(motion.theta));
  return straight(motion, noise.translation_per_metre * noise.translation_per_metre, noise.lateral_share,
                  noise.rotation_per_metre * noise.rotation_per_metre * distance +
                      noise.rotation_per_radian * noise.rotation_per_radian * turn);
}

/// Variances of the pose that a path gives between its rows, for a steady robot, when the robot need not be steady: at
/// a share s of an interval dt it is off by acceleration * dt^2 / 2 * s (1 - s), and by no more than the motion allows.
Eigen::Vector2d interpolation_variance(const MotionPath& path, Timestamp time) {
  const auto& rows = path.rows();
  if (rows.size() < 2) return Eigen::Vector2d::Zero();
  const auto after = std::upper_bound(rows.begin() + 1, rows.end() - 1, time,
                                      [](Timestamp t, const OdometryReading& row) { return t < row.time; });
  const OdometryReading& a = *(after - 1);
  const OdometryReading& b = *after;
  const double dt = seconds_between(a.time, b.time);
  const double share = seconds_between(a.time, time) / dt;
  const double bulge = std::abs(share * (1.0 - share));
  const geometry::Pose2 motion = a.T_odom_base.inverse() * b.T_odom_base;
  double sigma_t = 0.5 * kAcceleration * dt * dt * bulge;
  double sigma_r = 0.5 * kTurnAcceleration * dt * dt * bulge;
  if (share >= 0.0 && share <= 1.0) {
    sigma_t = std::min(sigma_t, std::hypot(motion.x, motion.y) * bulge);
    sigma_r = std::min(sigma_r, std::abs(geometry::wrap_angle(motion.theta)) * bulge);
  }
  return {sigma_t * sigma_t, sigma_r * sigma_r};
}

void add_diagonal(geometry::PoseEstimate& estimate, double variance_t, double variance_r) {
  estimate.covariance.diagonal() += Eigen::Vector3d(variance_t, variance_t, variance_r);
}

}  // namespace

geometry::PoseEstimate OdometryNoise::with_covariance(const geometry::Pose2& T_from_to) const {
  geometry::PoseEstimate motion = step(*this, T_from_to);
  add_diagonal(motion, kTranslationFloor_m * kTranslationFloor_m, kRotationFloor_rad * kRotationFloor_rad);
  return motion;
}

geometry::PoseEstimate OdometryNoise::along(const MotionPath& path, Timestamp from, Timestamp to) const {
  geometry::PoseEstimate motion;
  geometry::Pose2 last = path.pose_at(from);
  const auto& rows = path.rows();
  auto row = std::upper_bound(rows.begin(), rows.end(), from,
                              [](Timestamp t, const OdometryReading& reading) { return t < reading.time; });
  for (; row != rows.end() && row->time < to; ++row) {
    motion = geometry::compose(motion, step(*this, last.inverse() * row->T_odom_base));
    last = row->T_odom_base;
  }
  motion = geometry::compose(motion, step(*this, last.inverse() * path.pose_at(to)));
  const Eigen::Vector2d ends = interpolation_variance(path, from) + interpolation_variance(path, to);
  add_diagonal(motion, ends[0] + kTranslationFloor_m * kTranslationFloor_m,
               ends[1] + kRotationFloor_rad * kRotationFloor_rad);
  return motion;
}

}  // namespace credo::sensors
