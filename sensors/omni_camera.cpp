// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/omni_camera.hpp"

#include <cmath>

namespace credo::sensors {

double OmniCamera::azimuth_of(double u, double v) const {
  return geometry::wrap_angle(azimuth_zero_rad + azimuth_sign * std::atan2(v - center_px.y(), u - center_px.x()));
}

Eigen::Vector2d OmniCamera::image_direction(double azimuth) const {
  const double angle = azimuth_sign * (azimuth - azimuth_zero_rad);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace credo::sensors
