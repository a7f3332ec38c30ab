// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::sensors {

/// How far a sensor's calibration is to be trusted: 1-sigma of the mounting pose, of the mirror axis in the image and
/// of the axis' tilt.
struct CalibrationAccuracy {
  double x_m = 0.002;
  double y_m = 0.002;
  double theta_rad = 0.003;
  double center_px = 0.3;
  double tilt_rad = 0.01;

  friend bool operator==(const CalibrationAccuracy&, const CalibrationAccuracy&) = default;
};

}  // namespace credo::sensors
