// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_bayes.hpp"

#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

NoEcho bayes_no_echo(const NoEcho& matched) {
  return NoEcho(
      [matched](double rho_m, double theta_rad) {
        return before_full_trust(
            simple_mass(pignistic_log_odds(matched.mass(rho_m, theta_rad), matched.reliability())));
      },
      kFullTrust, matched.reach());
}

}  // namespace

BayesSonar::BayesSonar(const sensors::SonarRing& ring, const BayesSonarParams& params)
    : matched_(ring, params.matched), no_echo_(bayes_no_echo(matched_.no_echo())) {}

evidence::GridMass BayesSonar::mass(double rho_m, double theta_rad, double reading_m) const {
  return before_full_trust(
      simple_mass(pignistic_log_odds(matched_.mass(rho_m, theta_rad, reading_m), matched_.reliability())));
}

double BayesSonar::reliability() const { return kFullTrust; }

}  // namespace credo::mapping
