// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/rim_calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/tukey_weight.hpp"

namespace credo::perception {
RimCalibration::RimCalibration(const sensors::OmniCamera& camera, const RimParams& params)
    : params_(params),
      calibration_sigma_px_(camera.accuracy.center_px),
      calibrated_center_px_(camera.center_px),
      center_px_(camera.center_px),
      sigma_px_(camera.accuracy.center_px) {
  params_.directions = std::max(16, (params.directions + 15) / 16 * 16);
  if (!camera.rim_radius_px) return;
  rim_radius_px_ = *camera.rim_radius_px;
  const double half = params.search_px + 3.0 * calibration_sigma_px_;
  const std::vector<double> radii =
      evenly_spaced_radii(std::max(1.0, rim_radius_px_ - half), rim_radius_px_ + half, params.step_px);
  sensors::OmniCamera plain = camera;  // image azimuths; the mask may well cover the rim
  plain.T_base_camera = {};
  plain.azimuth_zero_rad = 0.0;
  plain.azimuth_sign = 1;
  plain.mask = cv::Mat();
  // Every circle gets the same number of columns: their distance follows the radius.
  circles_.reserve(radii.size());
  for (const double radius : radii) {
    const double column_px = 2.0 * std::numbers::pi * radius / params_.directions;
    circles_.emplace_back(plain, camera.center_px, std::span(&radius, 1), column_px * (1.0 + 1e-9));
  }
  for (int i = 0; i < params_.directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / params_.directions;
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
  samples_.resize(radii.size() * params_.directions);
  falls_.reserve(samples_.size());
}

void RimCalibration::find_falls(const std::uint8_t* pixels) {
  const auto count = static_cast<int>(circles_.size());
  const int n = params_.directions;
  for (int i = 0; i < count; ++i) circles_[i].sample(pixels, 0, samples_.data() + static_cast<std::size_t>(i) * n);
  falls_.clear();
  const double least = params_.least_step * AnnulusTable::kScale;
  for (int direction = 0; direction < n; ++direction) {
    const auto fall = [&](int i) {  // smoothed fall of the grey level around circle i
      const std::int16_t* at = samples_.data() + static_cast<std::size_t>(i) * n + direction;
      return at[-2 * n] + at[-n] - at[n] - at[2 * n];
    };
    for (int i = 3; i + 3 < count; ++i) {
      const bool usable = circles_[i - 2].usable(0, direction) && circles_[i + 2].usable(0, direction);
      const int here = fall(i);
      const int before = fall(i - 1);
      const int after = fall(i + 1);
      if (!usable || here < 2.0 * least || here < before || here <= after) continue;
      const double between = 0.5 * (after - before) / (2.0 * here - before - after);
      const double radius = circles_[i].rows()[0].radius_px + between * params_.step_px;
      falls_.push_back({direction, static_cast<float>(radius), static_cast<float>(here)});
    }
  }
}

std::optional<RimCircle> RimCalibration::fit_circle() const {
  // radius(direction) = R + dx cos + dy sin, for a centre that is off by far less than the radius.
  Eigen::Vector3d x(0.0, 0.0, rim_radius_px_);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double square = 0.0;
  double weights = 0.0;
  double limit = params_.search_px + 3.0 * calibration_sigma_px_;
  constexpr int kIterations = 12;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    information.setZero();
    information(2, 2) = 1.0;  // the radius is known to about a pixel, which counts as one direction
    Eigen::Vector3d right(0.0, 0.0, rim_radius_px_);
    square = weights = 0.0;
    for (const Fall& fall : falls_) {
      const Eigen::Vector3d row(directions_[fall.direction].x(), directions_[fall.direction].y(), 1.0);
      const double distance = fall.radius_px - row.dot(x);
      const double weight = tukey_weight(distance, limit);
      information += weight * row * row.transpose();
      right += weight * fall.radius_px * row;
      square += weight * distance * distance;
      weights += weight;
    }
    x = information.ldlt().solve(right);
    limit = std::max(params_.tukey_px, 0.7 * limit);
  }
  RimCircle circle{.center_px = calibrated_center_px_ + x.head<2>(), .radius_px = x(2)};
  circle.share = weights / params_.directions;
  if (circle.share < params_.least_share) return std::nullopt;
  const Eigen::Matrix3d covariance = information.inverse() * (square / weights);
  circle.sigma_px = std::hypot(params_.floor_sigma_px, std::sqrt(std::max(covariance(0, 0), covariance(1, 1))));
  return circle;
}

std::optional<RimCircle> RimCalibration::find(const std::uint8_t* pixels) {
  if (circles_.empty()) return std::nullopt;
  find_falls(pixels);
  return fit_circle();
}

void RimCalibration::update(const std::uint8_t* pixels) {
  const std::optional<RimCircle> rim = find(pixels);
  if (!rim) return;
  const double expected = std::hypot(calibration_sigma_px_, rim->sigma_px);
  if ((rim->center_px - calibrated_center_px_).norm() > params_.agreement_sigmas * expected) return;
  // One-dimensional Kalman filter on both axes alike.
  const double predicted = sigma_px_ * sigma_px_ + params_.walk_px * params_.walk_px;
  const double gain = predicted / (predicted + rim->sigma_px * rim->sigma_px);
  center_px_ += gain * (rim->center_px - center_px_);
  // What the images have in common does not average out.
  sigma_px_ = std::max(params_.floor_sigma_px, std::sqrt((1.0 - gain) * predicted));
}

}  // namespace credo::perception
