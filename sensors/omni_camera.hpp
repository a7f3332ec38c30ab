// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/calibration_accuracy.hpp"

namespace credo::sensors {

/// A cone on the optical axis in front of a pinhole camera.
struct ConicMirror {
  double half_angle_rad = 0.0;   ///< between the axis and the cone's surface
  double apex_distance_m = 0.0;  ///< from the pinhole to the apex
  double focal_px = 0.0;

  friend bool operator==(const ConicMirror&, const ConicMirror&) = default;
};

/// The unified central model with a radial-tangential lens (Mei and Rives, ICRA 2007). [px]
struct MeiProjection {
  double xi = 0.0;
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();      ///< fu, fv
  Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();  ///< pu, pv
  Eigen::Vector4d distortion = Eigen::Vector4d::Zero();    ///< k1, k2, p1, p2

  friend bool operator==(const MeiProjection&, const MeiProjection&) = default;
};

/// The polynomial model (Scaramuzza et al., ICVS 2006).
struct ScaramuzzaProjection {
  std::vector<double> polynomial;            ///< by growing power, pixel to ray
  std::vector<double> inverse_polynomial;    ///< by growing power, ray to pixel; may be empty
  Eigen::Vector3d affine = {1.0, 0.0, 0.0};  ///< c, d, e

  friend bool operator==(const ScaramuzzaProjection&, const ScaramuzzaProjection&) = default;
};

/// An omnidirectional camera: the sensor.yaml of camera0. Vertical lines of the world are radial lines about `center`.
struct OmniCamera {
  enum class Model { kConic, kMei, kScaramuzza, kEquirectangular };

  geometry::Pose2 T_base_camera;
  double height_m = 1.0;
  int width_px = 0;
  int height_px = 0;
  Model model = Model::kConic;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< u, v; u right, v down; centre of the first pixel = (0, 0)
  double inner_radius_px = 0.0;                         ///< usable annulus
  double outer_radius_px = 0.0;
  double horizon_radius_px = 0.0;       ///< where the elevation is zero
  std::optional<double> rim_radius_px;  ///< the mirror's visible rim
  cv::Mat mask;                         ///< CV_8UC1, 0 = never use; empty = all usable
  double azimuth_zero_rad = 0.0;
  int azimuth_sign = -1;
  std::optional<ConicMirror> mirror;
  std::optional<MeiProjection> mei;                ///< where model is kMei
  std::optional<ScaramuzzaProjection> scaramuzza;  ///< where model is kScaramuzza
  double exposure_s = 0.0;
  CalibrationAccuracy accuracy;

  /// Azimuth, in the sensor frame, of the ray through a pixel. [rad], (-pi, pi]
  [[nodiscard]] double azimuth_of(double u, double v) const;
  /// Unit vector (du, dv) in the image along which points of a given azimuth lie, seen from the centre.
  [[nodiscard]] Eigen::Vector2d image_direction(double azimuth) const;
};

}  // namespace credo::sensors
