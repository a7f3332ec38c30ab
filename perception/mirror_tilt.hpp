// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sensors/omni_camera.hpp"

namespace credo::perception {

/// How the tilt of the mirror's axis is learned from the slopes of the lines, and forgotten.
struct TiltParams {
  double walk_rad = 0.001;   ///< change from image to image: the floor is not even
  double tukey = 3.0;        ///< where a line loses its weight, in standard deviations of its slope
  double line_sigma = 0.10;  ///< of a slope besides its own sigma: not every edge is plumb [rad px]
  int least_lines = 8;
  double floor_rad = 0.001;  ///< the tilt is never known better
};

/// A line's slope, for learning.
struct SlopeReading {
  double azimuth = 0.0;  ///< in any frame that turns with the camera [rad]
  double slope = 0.0;    ///< without any expectation of it [rad px]
  double sigma = 0.0;
};

/// The tilt of the mirror's axis. A tilt shifts the azimuth by tilt * tan(elevation) * a sine of the azimuth, which is
/// nothing at the horizon ring: what is learned here bends lines upright and moves no bearing that is read there. A
/// centre that is off has nearly the same effect on the slopes, but shifts the bearings: it is not to be learned from
/// slopes.
class MirrorTilt {
 public:
  /// \param radii_px  of the annulus' rows
  MirrorTilt(const sensors::OmniCamera& camera, double horizon_px, std::span<const double> radii_px,
             const TiltParams& params);

  /// What to subtract from an azimuth seen on a row. [rad]
  [[nodiscard]] double shift(int row, const Eigen::Vector2d& direction) const {
    return tan_elevation_[row] * tilt_.dot(direction);
  }

  /// Learns from slopes that remained after the shifts were subtracted.
  void learn(std::span<const SlopeReading> readings);

  [[nodiscard]] const Eigen::Vector2d& tilt_rad() const { return tilt_; }
  [[nodiscard]] double sigma_rad() const { return sigma_rad_; }  ///< per axis
  /// 1-sigma of a line's slope through what is not known of the tilt. [rad px]
  [[nodiscard]] double slope_sigma() const { return slope_per_tilt_ * sigma_rad_; }

 private:
  TiltParams params_;
  std::vector<double> tan_elevation_;  ///< by row
  double slope_per_tilt_ = 0.0;        ///< slope of a line over the whole annulus [px]
  Eigen::Vector2d tilt_ = Eigen::Vector2d::Zero();
  double sigma_rad_;  ///< of the tilt, per axis
};

}  // namespace credo::perception
