// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/freshness.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/angles.hpp"

namespace credo::mapping {

Freshness::Freshness(const FreshnessParams& params) : params_(params) {
  if (!(params.correlation >= 0.0 && params.correlation < 1.0))
    throw std::invalid_argument("the correlation of readings from one place must be in [0, 1), not " +
                                std::to_string(params.correlation));
  if (!(params.way_m > 0.0 && params.turn_rad > 0.0))
    throw std::invalid_argument("way_m and turn_rad, after which readings are new, must be above 0");
  if (!(params.still_m >= 0.0 && params.still_rad >= 0.0))
    throw std::invalid_argument("still_m and still_rad, within which a robot is at rest, must not be negative");
}

double Freshness::of_next(Place& place, const geometry::Pose2& T_map_base) const {
  const double way_m = (T_map_base.translation() - place.T_map_base.translation()).norm();
  const double turn_rad = std::abs(geometry::wrap_angle(T_map_base.theta - place.T_map_base.theta));
  const bool still = place.read > 0.0 && way_m <= params_.still_m && turn_rad <= params_.still_rad;
  const double read = still ? place.read : place.read * std::exp(-way_m / params_.way_m - turn_rad / params_.turn_rad);
  place = {still ? place.T_map_base : T_map_base, read + 1.0};
  // g(n + 1) - g(n) over one denominator: no cancellation however large n is
  const double rho = params_.correlation;
  const double share = (1.0 - rho) / ((1.0 + read * rho) * (1.0 + (read - 1.0) * rho));
  return std::exp2(std::round(std::log2(share)));
}

}  // namespace credo::mapping
