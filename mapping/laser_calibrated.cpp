// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/laser_calibrated.hpp"

#include <algorithm>

#include "evidence/parameter_check.hpp"
#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

void check(const CalibratedLaserParams& params) {
  const evidence::ParameterCheck check("laser model: ");
  check.require(params.hit_weights.size() == LaserKnots::kCount, "hit_weights",
                static_cast<double>(params.hit_weights.size()), std::to_string(LaserKnots::kCount) + " of them");
  for (const double weight : params.hit_weights) check.finite("hit_weights", weight);
  check.not_negative("free_weight", params.free_weight);
  check.positive("free_margin.least_m", params.free_margin.least_m);
  check.positive("half_width.least_m", params.half_width.least_m);
  check.not_negative("half_width.sigmas", params.half_width.sigmas);
  check.require(params.half_width.least_m <= params.free_margin.least_m, "half_width.least_m",
                params.half_width.least_m, "at most free_margin.least_m");
  check.require(params.half_width.sigmas <= params.free_margin.sigmas, "half_width.sigmas", params.half_width.sigmas,
                "at most free_margin.sigmas");
}

}  // namespace

CalibratedLaser::CalibratedLaser(const CalibratedLaserParams& params) : params_(params) {
  check(params);
  greatest_weight_ = std::max(0.0, std::ranges::max(params.hit_weights));
}

evidence::GridMass CalibratedLaser::free_mass() const { return before_full_trust(simple_mass(-params_.free_weight)); }
evidence::GridMass CalibratedLaser::hit_mass() const { return before_full_trust(simple_mass(greatest_weight_)); }

double CalibratedLaser::hit_share(double reading_m, const sensors::RangeNoise& noise) const {
  if (greatest_weight_ == 0.0) return 0.0;
  double weight = 0.0;
  for_each_hit_weight(noise.sigma(reading_m), reading_m,
                      [&](std::size_t i, double share) { weight += share * params_.hit_weights[i]; });
  return before_full_trust(simple_mass(std::max(0.0, weight))).occupied / hit_mass().occupied;
}

double CalibratedLaser::reliability() const { return kFullTrust; }

}  // namespace credo::mapping
