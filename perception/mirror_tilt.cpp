// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/mirror_tilt.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace credo::perception {
namespace {

/// A cone shows elevation phi - phi_horizon at radius focal * tan(phi); of another mirror only the rise at the horizon
/// is guessed, a paraboloid's.
double tan_elevation(const sensors::OmniCamera& camera, double horizon_px, double radius_px) {
  const double focal = camera.mirror ? camera.mirror->focal_px : 0.0;
  if (!(focal > 0.0)) return (radius_px - horizon_px) / horizon_px;
  return std::tan(std::atan(radius_px / focal) - std::atan(horizon_px / focal));
}

}  // namespace

MirrorTilt::MirrorTilt(const sensors::OmniCamera& camera, double horizon_px, std::span<const double> radii_px,
                       const TiltParams& params)
    : params_(params), sigma_rad_(camera.accuracy.tilt_rad) {
  // The slope of a line that follows tan(elevation), fitted with weights radius^2.
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const double radius : radii_px) {
    tan_elevation_.push_back(tan_elevation(camera, horizon_px, radius));
    const double weight = radius * radius;
    const double lever = 1.0 / radius - 1.0 / horizon_px;
    w += weight;
    x += weight * lever;
    y += weight * tan_elevation_.back();
    xx += weight * lever * lever;
    xy += weight * lever * tan_elevation_.back();
  }
  const double determinant = w * xx - x * x;
  if (determinant > 0.0) slope_per_tilt_ = std::abs((w * xy - x * y) / determinant);
}

void MirrorTilt::learn(std::span<const SlopeReading> readings) {
  const double variance = sigma_rad_ * sigma_rad_ + params_.walk_rad * params_.walk_rad;
  sigma_rad_ = std::min(sigma_rad_ * 2.0, std::sqrt(variance));
  if (static_cast<int>(readings.size()) < params_.least_lines || slope_per_tilt_ == 0.0) return;
  Eigen::Vector2d change = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity() / variance;
  constexpr int kIterations = 4;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    information = Eigen::Matrix2d::Identity() / variance;
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const SlopeReading& reading : readings) {
      // The slope falls with the elevation: 1/radius does.
      const Eigen::Vector2d row =
          -slope_per_tilt_ * Eigen::Vector2d(std::cos(reading.azimuth), std::sin(reading.azimuth));
      const double sigma = std::hypot(reading.sigma, params_.line_sigma);
      const double z = (reading.slope - row.dot(change)) / sigma;
      const double limit = params_.tukey * (iteration == 0 ? 3.0 : 1.0);
      if (std::abs(z) >= limit) continue;
      const double rest = 1.0 - (z / limit) * (z / limit);
      const double weight = rest * rest / (sigma * sigma);
      information += weight * row * row.transpose();
      right += weight * reading.slope * row;
    }
    change = information.inverse() * right;
  }
  tilt_ += change;
  const Eigen::Matrix2d covariance = information.inverse();
  sigma_rad_ = std::max(params_.floor_rad, std::sqrt(std::max(covariance(0, 0), covariance(1, 1))));
}

}  // namespace credo::perception
