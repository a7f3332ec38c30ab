// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>

#include "geometry/pose.hpp"
#include "sensors/calibration_accuracy.hpp"

namespace credo::sensors {

/// Range noise: sigma(r)^2 = sigma_0^2 + (k r^2)^2. Triangulation has k > 0, time of flight k = 0. [m, 1/m]
struct RangeNoise {
  double sigma_0_m = 0.01;
  double k_per_m = 0.0;

  [[nodiscard]] double sigma(double range_m) const { return std::hypot(sigma_0_m, k_per_m * range_m * range_m); }
  friend bool operator==(const RangeNoise&, const RangeNoise&) = default;
};

/// A panoramic range finder or a 2D laser: the sensor.yaml of range0. Beam i points along
/// angle_min + i * angle_increment in the sensor frame.
struct RangeFinder {
  geometry::Pose2 T_base_sensor;
  double height_m = 0.0;
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  int count = 0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  RangeNoise noise;
  double scan_time_s = 0.0;  ///< beam i is taken at timestamp + scan_time * ((i + 0.5) / count - 0.5)
  CalibrationAccuracy accuracy;

  [[nodiscard]] double beam_angle(int beam) const { return angle_min_rad + beam * angle_increment_rad; }
  /// Seconds from the scan's timestamp at which a beam is taken.
  [[nodiscard]] double beam_time(int beam) const { return scan_time_s * ((beam + 0.5) / count - 0.5); }
};

}  // namespace credo::sensors
