// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace credo::mapping {

using evidence::GridMass;
using evidence::ParameterCheck;

double beam_weight(double theta_rad, double beam_width_rad) {
  const double share = 2.0 * std::abs(theta_rad) / beam_width_rad;
  return share <= 1.0 ? 1.0 - share * share : 0.0;
}

void check_ring(const sensors::SonarRing& ring) {
  const ParameterCheck check("sonar ring: ");
  check.between("beam_width", ring.beam_width_rad, 0.0, std::numbers::pi);
  check.not_negative("range_min", ring.range_min_m);
  check.finite("range_max", ring.range_max_m);
  check.require(ring.range_max_m > ring.range_min_m, "range_max", ring.range_max_m, "a number above range_min");
}

NoEcho::NoEcho(const sensors::SonarRing& ring, const NoEchoParams& params)
    : mass_([ring, params](double rho_m, double theta_rad) {
        if (std::abs(theta_rad) > 0.5 * ring.beam_width_rad || rho_m < ring.range_min_m || rho_m > params.range_m)
          return GridMass::vacuous();
        const double share = rho_m / ring.range_max_m;
        const double empty =
            share < 1.0 ? (1.0 - share * share) * (1.0 - 0.5 * beam_weight(theta_rad, ring.beam_width_rad)) : 0.0;
        return GridMass{.empty = empty, .occupied = 0.0, .conflict = 0.0, .unknown = 1.0 - empty};
      }),
      reliability_(params.reliability),
      reach_m_(std::min(params.range_m, ring.range_max_m)) {
  const ParameterCheck check("sonar model: no_echo.");
  check.share("reliability", params.reliability);
  check.not_negative("range_m", params.range_m);
}

}  // namespace credo::mapping
