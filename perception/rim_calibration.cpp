// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/rim_calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace credo::perception {
namespace {

/// Equations of a circle's (dx, dy, R): radius(direction) = R + dx cos + dy sin, for a centre that is off by far less
/// than the radius.
struct CircleNormal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double weighted_square = 0.0, weight = 0.0;
};

/// With Tukey's biweight: 1 for a residual of 0, falling to 0 at `limit` and beyond.
CircleNormal accumulate(std::span<const RimFalls> falls, const Eigen::Vector3d& x, double limit) {
  using RimLanes = RimFalls::Lanes;
  RimLanes cc = RimLanes::Zero(), cs = cc, ss = cc, c = cc, s = cc, rc = cc, rs = cc, r = cc, squares = cc,
           weights = cc;
  for (const RimFalls& fall : falls) {
    const RimLanes distance = fall.radius_px - (fall.cosine * x(0) + fall.sine * x(1) + x(2));
    const RimLanes weight = (1.0 - (distance / limit).square()).max(0.0).square();
    const RimLanes by_cosine = weight * fall.cosine, by_sine = weight * fall.sine, by_radius = weight * fall.radius_px;
    cc += by_cosine * fall.cosine;
    cs += by_cosine * fall.sine;
    ss += by_sine * fall.sine;
    c += by_cosine;
    s += by_sine;
    rc += by_radius * fall.cosine;
    rs += by_radius * fall.sine;
    r += by_radius;
    squares += weight * distance.square();
    weights += weight;
  }
  CircleNormal sum{.right = {rc.sum(), rs.sum(), r.sum()}, .weighted_square = squares.sum(), .weight = weights.sum()};
  sum.information << cc.sum(), cs.sum(), c.sum(), cs.sum(), ss.sum(), s.sum(), c.sum(), s.sum(), sum.weight;
  return sum;
}

}  // namespace

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
  falls_.reserve(samples_.size() / RimFalls::kLanes + 1);
}

void RimCalibration::find_falls(const std::uint8_t* pixels) {
  const auto count = static_cast<int>(circles_.size());
  const int n = params_.directions;
  for (int i = 0; i < count; ++i) circles_[i].sample(pixels, 0, samples_.data() + static_cast<std::size_t>(i) * n);
  falls_.clear();
  fall_count_ = 0;
  const double least = params_.least_step * AnnulusTable::kScale;
  for (int direction = 0; direction < n; ++direction) {
    const auto fall = [&](int i) {  // smoothed fall of the grey level around circle i
      const std::int16_t* at = samples_.data() + static_cast<std::size_t>(i) * n + direction;
      return at[-2 * n] + at[-n] - at[n] - at[2 * n];
    };
    for (int i = 3; i + 3 < count; ++i) {
      const int here = fall(i);
      if (here < 2.0 * least) continue;
      const int before = fall(i - 1);
      const int after = fall(i + 1);
      const bool usable = circles_[i - 2].usable(0, direction) && circles_[i + 2].usable(0, direction);
      if (!usable || here < before || here <= after) continue;
      const double between = 0.5 * (after - before) / (2.0 * here - before - after);
      const double radius = circles_[i].rows()[0].radius_px + between * params_.step_px;
      add_fall(directions_[direction], static_cast<float>(radius));
    }
  }
}

void RimCalibration::add_fall(const Eigen::Vector2d& direction, float radius_px) {
  const int lane = fall_count_++ % RimFalls::kLanes;
  if (lane == 0) falls_.emplace_back();
  falls_.back().cosine[lane] = direction.x();
  falls_.back().sine[lane] = direction.y();
  falls_.back().radius_px[lane] = radius_px;
}

std::optional<RimCircle> RimCalibration::fit_circle() const {
  Eigen::Vector3d x(0.0, 0.0, rim_radius_px_);
  CircleNormal sum;
  double limit = params_.search_px + 3.0 * calibration_sigma_px_;
  constexpr int kIterations = 12;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    sum = accumulate(falls_, x, limit);
    // The radius is known to about a pixel, which counts as one direction.
    sum.information(2, 2) += 1.0;
    sum.right(2) += rim_radius_px_;
    x = sum.information.ldlt().solve(sum.right);
    limit = std::max(params_.tukey_px, 0.7 * limit);
  }
  RimCircle circle{.center_px = calibrated_center_px_ + x.head<2>(), .radius_px = x(2)};
  circle.share = sum.weight / params_.directions;
  if (circle.share < params_.least_share) return std::nullopt;
  const Eigen::Matrix3d covariance = sum.information.inverse() * (sum.weighted_square / sum.weight);
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
