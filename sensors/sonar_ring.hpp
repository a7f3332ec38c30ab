// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "geometry/pose.hpp"

namespace credo::sensors {

/// A ring of ultrasonic transducers: the sensor.yaml of sonar0.
struct SonarRing {
  std::vector<geometry::Pose2> T_base_transducer;
  double beam_width_rad = 0.436;  ///< full opening angle of the cone
  double range_min_m = 0.2;
  double range_max_m = 3.0;
  double sigma_m = 0.02;
  double height_m = 0.0;
  std::vector<double> firing_times_s;  ///< relative to the timestamp, one for each transducer; empty = all 0
};

}  // namespace credo::sensors
