// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/calibrated_pose.hpp"

namespace credo::localization {
namespace {

using Eigen::Vector3d;

/// An instrument that is not there has an error that is known to be nearly nothing, so that the covariance inverts.
constexpr double kNearlyNothing = 1e-10;

double squared(double x) { return x * x; }

Vector3d scan_variance(const sensors::Rig& rig) {
  if (rig.range_finders.empty()) return Vector3d::Constant(kNearlyNothing);
  const sensors::CalibrationAccuracy& a = rig.range_finders.front().accuracy;
  return Vector3d(squared(a.x_m), squared(a.y_m), squared(a.theta_rad)).cwiseMax(kNearlyNothing);
}

Vector3d camera_variance(const sensors::Rig& rig) {
  if (!rig.camera) return Vector3d::Constant(kNearlyNothing);
  const sensors::CalibrationAccuracy& a = rig.camera->accuracy;
  const double harmonic = rig.camera->horizon_radius_px > 0.0 ? a.center_px / rig.camera->horizon_radius_px : 0.0;
  return Vector3d(squared(a.theta_rad), squared(harmonic), squared(harmonic)).cwiseMax(kNearlyNothing);
}

}  // namespace

PoseState::Vector CalibratedPose::state() const {
  PoseState::Vector x;
  x << pose.x, pose.y, pose.theta, common_errors;
  return x;
}

CalibratedPose calibrated_pose(const sensors::Rig& rig, const geometry::PoseEstimate& pose, int plan_errors) {
  CalibratedPose calibrated;
  calibrated.pose = pose.pose;
  calibrated.joint.topLeftCorner<3, 3>() = pose.covariance;
  calibrated.joint.diagonal().segment<3>(PoseState::kRangeX) = scan_variance(rig);
  calibrated.joint.diagonal().segment<3>(PoseState::kCameraTheta) = camera_variance(rig);
  calibrated.with_plan = PlanCovariance(plan_errors);
  return calibrated;
}

void move(CalibratedPose& pose, const geometry::PoseEstimate& motion, const CalibrationWalk& walk) {
  // The end of the way turns with the heading at its start.
  const Eigen::Vector2d way = pose.pose.rotation() * motion.pose.translation();
  const Eigen::Vector2d aside(-way.y(), way.x());
  PoseState::Matrix turned = PoseState::Matrix::Identity();
  turned.block<2, 1>(PoseState::kX, PoseState::kTheta) = aside;
  pose.joint = turned * pose.joint * turned.transpose();
  pose.with_plan.transform(turned);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = pose.pose.rotation();
  pose.joint.topLeftCorner<3, 3>() += R * motion.covariance * R.transpose();
  PoseState::Vector walked;
  walked << 0.0, 0.0, 0.0, walk.mounting_m, walk.mounting_m, walk.mounting_rad, walk.mounting_rad, walk.harmonic_rad,
      walk.harmonic_rad;
  pose.joint.diagonal() += walked.cwiseAbs2();
  pose.pose = pose.pose * motion.pose;
}

void place(CalibratedPose& pose, const geometry::PoseEstimate& elsewhere) {
  pose.pose = elsewhere.pose;
  pose.joint.topRows<3>().setZero();
  pose.joint.leftCols<3>().setZero();
  pose.joint.topLeftCorner<3, 3>() = elsewhere.covariance;
  PoseState::Matrix forget_pose = PoseState::Matrix::Identity();
  forget_pose.topLeftCorner<3, 3>().setZero();
  pose.with_plan.transform(forget_pose);
}

void set_state(const CalibratedPose& from, CalibratedPose& pose) {
  pose.pose = from.pose;
  pose.common_errors = from.common_errors;
  pose.joint = from.joint;
}

void widen(CalibratedPose& pose, const Eigen::Matrix3d& doubt) { pose.joint.topLeftCorner<3, 3>() += doubt; }

}  // namespace credo::localization
