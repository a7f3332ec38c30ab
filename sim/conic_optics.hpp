// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sensors/omni_camera.hpp"

namespace credo::sim {

/// A ray of light that the camera receives, backwards: origin + t * direction, t > 0, in the frame of the camera: x, y
/// as the sensor frame, z up, the origin of the frame on the mirror axis at the height of the effective viewpoint.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// A pinhole that looks up into a cone, as it really is. Everything stays in the plane through the axis and the point,
/// so that a vertical line is a radial line exactly. The virtual viewpoints are a circle around the axis (Baker and
/// Nayar 1999; docs/equations.md).
struct ConicOptics {
  sensors::ConicMirror mirror;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double azimuth_zero_rad = 0.0;
  int azimuth_sign = -1;
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();  ///< of the mirror axis, about the effective viewpoint

  [[nodiscard]] static ConicOptics of(const sensors::OmniCamera& camera);

  /// The ray through an image point; its direction is not normalised: horizontal length = radius in pixels (without
  /// tilt).
  [[nodiscard]] Ray ray(const Eigen::Vector2d& pixel) const;
  /// Where a point of the camera frame is seen. Precondition: not on the axis, no tilt.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const;
  /// Tangent of the elevation seen at a radius of the image.
  [[nodiscard]] double tan_elevation(double radius_px) const;
  /// d sin(2 tau): how far beyond the axis the viewpoint of a ray lies.
  [[nodiscard]] double viewpoint_radius() const;
};

}  // namespace credo::sim
