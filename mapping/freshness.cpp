// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/freshness.hpp"

#include <algorithm>
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
  geometry::Pose2& rest = place.T_map_base;
  if (place.read == 0.0) rest = T_map_base;
  const Eigen::Vector2d offset = T_map_base.translation() - rest.translation();
  const double turned = geometry::wrap_angle(T_map_base.theta - rest.theta);
  const double way_m = std::max(0.0, offset.norm() - params_.still_m);
  const double turn_rad = std::max(0.0, std::abs(turned) - params_.still_rad);
  if (way_m > 0.0) {
    const Eigen::Vector2d way = offset * (way_m / offset.norm());
    rest.x += way.x();
    rest.y += way.y();
  }
  rest.theta = geometry::wrap_angle(rest.theta + std::copysign(turn_rad, turned));
  const double read = place.read * std::exp(-way_m / params_.way_m - turn_rad / params_.turn_rad);
  place.read = read + 1.0;
  // g(n + 1) - g(n) over one denominator: no cancellation however large n is
  const double rho = params_.correlation;
  const double share = (1.0 - rho) / ((1.0 + read * rho) * (1.0 + (read - 1.0) * rho));
  return std::exp2(std::round(std::log2(share)));
}

}  // namespace credo::mapping
