// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/laser_bayes.hpp"

#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

evidence::GridMass of_log_odds(const evidence::GridMass& mass, double reliability) {
  return before_full_trust(simple_mass(pignistic_log_odds(mass, reliability)));
}

}  // namespace

BayesLaser::BayesLaser(const BayesLaserParams& params)
    : matched_(params.matched),
      free_(of_log_odds(matched_.free_mass(), matched_.reliability())),
      hit_(of_log_odds(matched_.hit_mass(), matched_.reliability())) {}

double BayesLaser::hit_share(double reading_m, const sensors::RangeNoise& noise) const {
  const double share = matched_.hit_share(reading_m, noise);
  return of_log_odds(matched_.hit_mass(), share * matched_.reliability()).occupied / hit_.occupied;
}

double BayesLaser::reliability() const { return kFullTrust; }

}  // namespace credo::mapping
