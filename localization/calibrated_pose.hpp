// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

#include "geometry/pose.hpp"
#include "localization/plan_covariance.hpp"
#include "localization/pose_state.hpp"
#include "sensors/acquisition.hpp"

namespace credo::localization {

/// A pose and the calibration of the instruments, estimated together, with all that is known of their errors: how they
/// go with each other and with the plan's. The plan's errors come again whenever a landmark is seen again, so they do
/// not average out; a Schmidt-Kalman filter (Schmidt 1966) considers them without estimating them.
struct CalibratedPose {
  geometry::Pose2 pose;
  /// What is to be added to the readings: to the scan (x, y, theta in the base frame, about its origin), to the
  /// camera's azimuths (yaw, and the cosine and sine of the azimuth that a mirror off its centre makes).
  /// [m, m, rad, rad, rad, rad]
  Eigen::Matrix<double, 6, 1> common_errors = Eigen::Matrix<double, 6, 1>::Zero();
  PoseState::Matrix joint = PoseState::Matrix::Zero();  ///< covariance of (pose, common errors)
  /// Covariance of the same with the plan's errors: columns 2 j and 2 j + 1 are x and y of junction j, and after all
  /// junctions, by id, two for what each landmark is off beside them: x and y of a point, offset and angle of a wall.
  PlanCovariance with_plan;

  [[nodiscard]] PoseState::Vector state() const;
  [[nodiscard]] Eigen::Matrix3d covariance() const { return joint.topLeftCorner<3, 3>(); }
  [[nodiscard]] geometry::PoseEstimate estimate() const { return {pose, covariance()}; }
};

/// How much the calibration changes from one acquisition to the next, 1-sigma: instruments settle, mirrors warm up.
struct CalibrationWalk {
  double mounting_m = 1e-5;
  double mounting_rad = 1e-5;
  double harmonic_rad = 1e-5;
};

/// A pose that is independent of the calibration, and that as the rig's calibration accuracy says.
/// \param plan_errors  of CalibratedPose::with_plan; 0 without a plan
[[nodiscard]] CalibratedPose calibrated_pose(const sensors::Rig& rig, const geometry::PoseEstimate& pose,
                                             int plan_errors = 0);

/// Moves the robot. \param motion  T_previous_current of the base, independent of what was known
void move(CalibratedPose& pose, const geometry::PoseEstimate& motion, const CalibrationWalk& walk = {});

/// Another pose, from elsewhere, in place of the one that was there; the calibration stays.
void place(CalibratedPose& pose, const geometry::PoseEstimate& elsewhere);

/// Copies all but the covariances with the plan's errors.
void set_state(const CalibratedPose& from, CalibratedPose& pose);

/// Adds to the covariance of the pose.
void widen(CalibratedPose& pose, const Eigen::Matrix3d& doubt);

}  // namespace credo::localization
