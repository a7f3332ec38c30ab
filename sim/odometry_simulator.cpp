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
    : noise_(noise), random_(seed, kOdometryStream), extra_(seed, kOdometryStream, 1) {
  const auto draw = [this](double sigma) {
    return Error{random_.normal(kHalf * sigma), random_.normal(kHalf * sigma)};
  };
  translation_ = draw(noise.translation_per_metre);
  rotation_ = draw(noise.rotation_per_metre);
  turning_ = draw(noise.rotation_per_radian);
}

geometry::Pose2 OdometrySimulator::advance(const geometry::Pose2& T_from_to, const Condition& condition,
                                           double slip_m) {
  if (slip_m != 0.0) T_odom_base_ = T_odom_base_ * geometry::Pose2{slip_m, 0.0, 0.0};
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
  const double scale = condition.scale * (1.0 + translation_.value());
  geometry::Pose2 counted{scale * T_from_to.x, scale * T_from_to.y,
                          turn + rotation_.value() * way + turning_.value() * turn};
  if (const double more = condition.noise_beyond_usual(); more > 0.0) {
    // Independent from piece to piece, so that the variance grows with the way.
    counted.x += extra_.normal(more * noise_.translation_per_metre * std::sqrt(way));
    counted.theta += extra_.normal(
        more * (noise_.rotation_per_metre * std::sqrt(way) + noise_.rotation_per_radian * std::sqrt(std::abs(turn))));
  }
  T_odom_base_ = T_odom_base_ * counted;
  return T_odom_base_;
}

}  // namespace credo::sim
