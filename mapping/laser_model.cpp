// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/laser_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

constexpr evidence::GridMass kFree{.empty = 0.9, .occupied = 0.05, .conflict = 0.0, .unknown = 0.05};
constexpr evidence::GridMass kHit{.empty = 0.05, .occupied = 0.9, .conflict = 0.0, .unknown = 0.05};

}  // namespace

evidence::GridMass laser_li2006(double rho_m, double reading_m, double epsilon_m) {
  if (!(rho_m > 0.0)) return evidence::GridMass::vacuous();
  if (rho_m < reading_m - epsilon_m) return kFree;
  return rho_m <= reading_m + epsilon_m ? kHit : evidence::GridMass::vacuous();
}

Li2006Laser::Li2006Laser(const Li2006LaserParams& params) : params_(params) {
  if (!(params.epsilon_m > 0.0 && std::isfinite(params.epsilon_m)))
    throw std::invalid_argument("laser model: epsilon_m must be a finite length above 0");
  if (!(params.hit_sigmas >= 0.0 && params.free_sigmas >= params.hit_sigmas && std::isfinite(params.free_sigmas)))
    throw std::invalid_argument("laser model: hit_sigmas must not be negative, nor above free_sigmas, and both finite");
  if (!(params.reliability >= 0.0 && params.reliability < 1.0))
    throw std::invalid_argument("laser model: reliability must be in [0, 1): at 1 no later reading could correct it");
}

bool Li2006Laser::is_printed() const { return params_.variant == Variant::kPrinted; }

evidence::GridMass Li2006Laser::free_mass() const { return is_printed() ? before_full_trust(kFree) : kFree; }
evidence::GridMass Li2006Laser::hit_mass() const { return is_printed() ? before_full_trust(kHit) : kHit; }
double Li2006Laser::reliability() const { return is_printed() ? kFullTrust : params_.reliability; }

double Li2006Laser::free_margin(double reading_m, const sensors::RangeNoise& noise) const {
  return is_printed() ? params_.epsilon_m : std::max(params_.epsilon_m, params_.free_sigmas * noise.sigma(reading_m));
}

double Li2006Laser::half_width(double reading_m, const sensors::RangeNoise& noise) const {
  return is_printed() ? params_.epsilon_m : std::max(params_.epsilon_m, params_.hit_sigmas * noise.sigma(reading_m));
}

double Li2006Laser::hit_share(double reading_m, const sensors::RangeNoise& noise) const {
  return params_.epsilon_m / half_width(reading_m, noise);
}

}  // namespace credo::mapping
