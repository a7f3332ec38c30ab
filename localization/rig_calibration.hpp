// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/pose.hpp"
#include "localization/calibrated_pose.hpp"
#include "perception/scene.hpp"
#include "sensors/acquisition.hpp"

namespace credo::localization {

/// Where range finder 0 is really mounted.
struct RangeCalibration {
  geometry::Pose2 T_base_sensor;
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();  ///< x, y, theta [m, m, rad]
};

/// How the camera really looks at the world.
struct CameraCalibration {
  double theta_rad = 0.0;  ///< of T_base_camera
  double theta_sigma_rad = 0.0;
  /// First harmonic that is left in the azimuths, to be added: cosine and sine of the azimuth. [rad]
  Eigen::Vector2d harmonic_rad = Eigen::Vector2d::Zero();
  Eigen::Vector2d harmonic_sigma_rad = Eigen::Vector2d::Zero();
  /// The mirror's axis in the image: where the rim has it, moved so that the harmonic is nothing.
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double center_sigma_px = 0.0;                        ///< the larger of both axes
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();  ///< from the slopes of the lines about that centre
  double tilt_sigma_rad = 0.0;
};

/// What a drive has taught about the instruments, each number with its uncertainty. In the order that tells a centre
/// that is off from an axis that is tilted, which bend the lines alike: the centre from the rim and from the azimuths
/// against plan and range finder, the tilt from what slopes are left. The yaw that camera and range finder share shows
/// only in how the robot drives.
struct RigCalibration {
  std::optional<RangeCalibration> range;
  std::optional<CameraCalibration> camera;
};

/// \param rig  as calibrated before the drive
/// \param pose  its common errors are relative to `rig`
/// \param mirror  of the latest scene
[[nodiscard]] RigCalibration rig_calibration(const sensors::Rig& rig, const CalibratedPose& pose,
                                             const perception::MirrorEstimate& mirror);

/// By how many pixels the centre has to be moved for a first harmonic (cosine, sine) to vanish from the azimuths.
/// Precondition: the camera's horizon radius is positive.
[[nodiscard]] Eigen::Vector2d center_shift_px(const sensors::OmniCamera& camera, const Eigen::Vector2d& harmonic_rad);

}  // namespace credo::localization
