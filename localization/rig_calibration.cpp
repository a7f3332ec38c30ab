// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/rig_calibration.hpp"

#include <cmath>

namespace credo::localization {
namespace {

double sigma_of(const CalibratedPose& pose, PoseState::Index index) {
  return std::sqrt(std::max(0.0, pose.joint(index, index)));
}

CameraCalibration camera_calibration(const sensors::OmniCamera& camera, const CalibratedPose& pose,
                                     const perception::MirrorEstimate& mirror) {
  CameraCalibration calibration;
  calibration.theta_rad = geometry::wrap_angle(camera.T_base_camera.theta + pose.common_errors(3));
  calibration.theta_sigma_rad = sigma_of(pose, PoseState::kCameraTheta);
  calibration.harmonic_rad = pose.common_errors.tail<2>();
  calibration.harmonic_sigma_rad = {sigma_of(pose, PoseState::kCameraCos), sigma_of(pose, PoseState::kCameraSin)};
  calibration.center_px = mirror.center_px;
  calibration.center_sigma_px = mirror.center_sigma_px;
  if (camera.horizon_radius_px > 0.0) {
    calibration.center_px += center_shift_px(camera, calibration.harmonic_rad);
    calibration.center_sigma_px = camera.horizon_radius_px * calibration.harmonic_sigma_rad.maxCoeff();
  }
  calibration.tilt_rad = mirror.tilt_rad;
  calibration.tilt_sigma_rad = mirror.tilt_sigma_rad;
  return calibration;
}

}  // namespace

Eigen::Vector2d center_shift_px(const sensors::OmniCamera& camera, const Eigen::Vector2d& harmonic_rad) {
  // A centre moved by d turns the image azimuth phi by (d_u sin phi - d_v cos phi) / radius, and the azimuth in the
  // base frame is zero + sign * phi.
  const double zero = camera.T_base_camera.theta + camera.azimuth_zero_rad;
  const double c = std::cos(zero), s = std::sin(zero);
  return camera.horizon_radius_px *
         Eigen::Vector2d(harmonic_rad.y() * c - harmonic_rad.x() * s,
                         -camera.azimuth_sign * (harmonic_rad.x() * c + harmonic_rad.y() * s));
}

RigCalibration rig_calibration(const sensors::Rig& rig, const CalibratedPose& pose,
                               const perception::MirrorEstimate& mirror) {
  RigCalibration calibration;
  if (!rig.range_finders.empty()) {
    const geometry::Pose2 correction{pose.common_errors(0), pose.common_errors(1), pose.common_errors(2)};
    calibration.range = {correction * rig.range_finders.front().T_base_sensor,
                         {sigma_of(pose, PoseState::kRangeX), sigma_of(pose, PoseState::kRangeY),
                          sigma_of(pose, PoseState::kRangeTheta)}};
  }
  if (rig.camera) calibration.camera = camera_calibration(*rig.camera, pose, mirror);
  return calibration;
}

}  // namespace credo::localization
