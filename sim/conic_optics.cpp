// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/conic_optics.hpp"

#include <cmath>
#include <numbers>

namespace credo::sim {
namespace {

/// The elevation of the ray on the camera's axis: phi - this = elevation for a camera ray at phi from the axis.
double offset_angle(const sensors::ConicMirror& mirror) { return 2.0 * mirror.half_angle_rad - 0.5 * std::numbers::pi; }

}  // namespace

ConicOptics ConicOptics::of(const sensors::OmniCamera& camera) {
  return {.mirror = camera.mirror.value(),
          .center_px = camera.center_px,
          .azimuth_zero_rad = camera.azimuth_zero_rad,
          .azimuth_sign = camera.azimuth_sign};
}

double ConicOptics::viewpoint_radius() const { return mirror.apex_distance_m * std::sin(2.0 * mirror.half_angle_rad); }

double ConicOptics::tan_elevation(double radius_px) const {
  // tan(phi - offset), tan(phi) = radius / focal
  const double tan_phi = radius_px / mirror.focal_px;
  const double tan_offset = std::tan(offset_angle(mirror));
  return (tan_phi - tan_offset) / (1.0 + tan_phi * tan_offset);
}

Ray ConicOptics::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d d = pixel - center_px;
  const double c = std::cos(azimuth_zero_rad), s = std::sin(azimuth_zero_rad);
  const double radius = d.norm();
  const double slope = tan_elevation(radius);
  // (cos, sin) of azimuth_zero + sign * atan2(dv, du), times the radius: linear in the pixel.
  const Eigen::Vector3d direction(c * d.x() - azimuth_sign * s * d.y(), s * d.x() + azimuth_sign * c * d.y(),
                                  radius * slope);
  return {tilt * Eigen::Vector3d(0.0, 0.0, viewpoint_radius() * slope), tilt * direction};
}

Eigen::Vector2d ConicOptics::project(const Eigen::Vector3d& point) const {
  const double range = point.head<2>().norm();
  const double elevation = std::atan2(point.z(), range + viewpoint_radius());
  const double radius = mirror.focal_px * std::tan(elevation + offset_angle(mirror));
  const double angle = azimuth_sign * (std::atan2(point.y(), point.x()) - azimuth_zero_rad);
  return center_px + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace credo::sim
