// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/odometry_simulator.hpp"

#include <cmath>
#include <numbers>

namespace credo::sim {
namespace {

constexpr double kCorrelation_m = 1.0;
constexpr double kHalf = 1.0 / std::numbers::sqrt2;  // of the standard deviation: half of the variance

}  // namespace

OdometrySimulator::OdometrySimulator(const sensors::OdometryNoise& noise, std::uint64_t seed)
    : noise_(noise), random_(seed, kOdometryStream) {
  const auto draw = [this](double sigma) {
    return Error{random_.normal(kHalf * sigma), random_.normal(kHalf * sigma)};
  };
  translation_ = draw(noise.translation_per_metre);
  rotation_ = draw(noise.rotation_per_metre);
  turning_ = draw(noise.rotation_per_radian);
}

geometry::Pose2 OdometrySimulator::advance(const geometry::Pose2& T_from_to) {
  const double way = std::hypot(T_from_to.x, T_from_to.y), turn = T_from_to.theta;
  if (way == 0.0 && turn == 0.0) return T_odom_base_;
  // First-order Gauss-Markov over the way driven; a radian on the spot wanders like half a metre.
  const double keep = std::exp(-(way + 0.5 * std::abs(turn)) / kCorrelation_m);
  const double fresh = kHalf * std::sqrt(1.0 - keep * keep);
  const auto wander = [&](Error& error, double sigma) {
    error.wandering = keep * error.wandering + random_.normal(fresh * sigma);
  };
  wander(translation_, noise_.translation_per_metre);
  wander(rotation_, noise_.rotation_per_metre);
  wander(turning_, noise_.rotation_per_radian);
  const double scale = 1.0 + translation_.value();
  T_odom_base_ = T_odom_base_ * geometry::Pose2{scale * T_from_to.x, scale * T_from_to.y,
                                                turn + rotation_.value() * way + turning_.value() * turn};
  return T_odom_base_;
}

}  // namespace credo::sim
