// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/laser_calibrated.hpp"

#include <algorithm>

#include "evidence/parameter_check.hpp"
#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

void check_weights(const evidence::ParameterCheck& check, const std::string& name, const LaserWeights& weights) {
  check.require(weights.hit_weights.size() == LaserKnots::kCount, name + ".hit_weights",
                static_cast<double>(weights.hit_weights.size()), std::to_string(LaserKnots::kCount) + " of them");
  for (const double weight : weights.hit_weights) check.finite(name + ".hit_weights", weight);
  check.not_negative(name + ".free_weight", weights.free_weight);
}

void check(const CalibratedLaserParams& params) {
  const evidence::ParameterCheck check("laser model: ");
  check_weights(check, "summed", params.summed);
  check_weights(check, "alone", params.alone);
  check.positive("free_margin.least_m", params.free_margin.least_m);
  check.positive("half_width.least_m", params.half_width.least_m);
  check.not_negative("half_width.sigmas", params.half_width.sigmas);
  check.require(params.half_width.least_m <= params.free_margin.least_m, "half_width.least_m",
                params.half_width.least_m, "at most free_margin.least_m");
  check.require(params.half_width.sigmas <= params.free_margin.sigmas, "half_width.sigmas", params.half_width.sigmas,
                "at most free_margin.sigmas");
}

}  // namespace

CalibratedLaser::CalibratedLaser(const CalibratedLaserParams& params, ReadingsTaken taken)
    : free_margin_(params.free_margin), half_width_(params.half_width), weights_(params.weights(taken)) {
  check(params);
  greatest_weight_ = std::max(0.0, std::ranges::max(weights_.hit_weights));
}

evidence::GridMass CalibratedLaser::free_mass() const { return before_full_trust(simple_mass(-weights_.free_weight)); }
evidence::GridMass CalibratedLaser::hit_mass() const { return before_full_trust(simple_mass(greatest_weight_)); }

double CalibratedLaser::hit_share(double reading_m, const sensors::RangeNoise& noise) const {
  if (greatest_weight_ == 0.0) return 0.0;
  const double sigma_m = noise.sigma(reading_m);
  double weight = 0.0;
  for_each_hit_weight(sigma_m, reading_m,
                      [&](std::size_t i, double share) { weight += share * weights_.hit_weights[i]; });
  weight *= std::min(1.0, LaserKnots::kSigma.back() / sigma_m);
  return before_full_trust(simple_mass(std::max(0.0, weight))).occupied / hit_mass().occupied;
}

double CalibratedLaser::reliability() const { return kFullTrust; }

}  // namespace credo::mapping
