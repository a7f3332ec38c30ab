// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_calibrated.hpp"

#include <algorithm>

#include "mapping/simple_mass.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;

NoEcho learned_no_echo(const sensors::SonarRing& ring, const CalibratedSonarParams& params) {
  const double half_width_rad = 0.5 * ring.beam_width_rad, range_min_m = ring.range_min_m;
  return NoEcho(
      [half_width_rad, range_min_m, weights = params.weights](double rho_m, double theta_rad) {
        const double off_axis = std::abs(theta_rad) / half_width_rad;
        if (off_axis > 1.0 || rho_m < range_min_m) return GridMass::vacuous();
        double weight = 0.0;
        for_each_no_echo_weight(rho_m, off_axis, [&](std::size_t i, double share) { weight += share * weights[i]; });
        return simple_mass(weight);
      },
      params.reliability, ring.range_max_m);
}

}  // namespace

CalibratedSonar::CalibratedSonar(const sensors::SonarRing& ring, const CalibratedSonarParams& params)
    : half_width_rad_(0.5 * ring.beam_width_rad), params_(params), no_echo_(learned_no_echo(ring, params)) {
  check_ring(ring);
  const evidence::ParameterCheck check("sonar model: ");
  check.share("reliability", params.reliability);
  check.require(params.weights.size() == SonarKnots::kCount, "weights", static_cast<double>(params.weights.size()),
                std::to_string(SonarKnots::kCount) + " of them");
  for (const double weight : params.weights) check.finite("weights", weight);
}

GridMass CalibratedSonar::mass(double rho_m, double theta_rad, double reading_m) const {
  const double off_axis = std::abs(theta_rad) / half_width_rad_;
  if (off_axis > 1.0 || rho_m > reach(reading_m)) return GridMass::vacuous();
  double weight = 0.0;
  for_each_echo_weight(rho_m, off_axis, reading_m,
                       [&](std::size_t i, double share) { weight += share * params_.weights[i]; });
  return simple_mass(weight);
}

}  // namespace credo::mapping
