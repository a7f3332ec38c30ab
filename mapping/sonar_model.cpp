// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace credo::mapping {
namespace {

using evidence::GridMass;

constexpr double kNothing = 1e-12;  // a sum of masses up to here is no evidence

/// Masses divided by their sum, as the print asks.
GridMass divided(const GridMass& raw) {
  const double sum = raw.empty + raw.occupied + raw.conflict + raw.unknown;
  if (sum <= kNothing) return GridMass::vacuous();
  return {raw.empty / sum, raw.occupied / sum, raw.conflict / sum, raw.unknown / sum};
}

/// The mass that is missing to 1 is ignorance; a sum above 1 is divided out.
GridMass completed(const GridMass& raw) {
  const double sum = raw.empty + raw.occupied + raw.conflict + raw.unknown;
  if (sum > 1.0) return divided(raw);
  return {raw.empty, raw.occupied, raw.conflict, raw.unknown + (1.0 - sum)};
}

/// Li X. 2007, eq. (5). \param limit_m  R - 2 eps, where the evidence ends
double empty_mass(double rho_m, double limit_m, double lambda) {
  if (!(limit_m > 0.0 && rho_m <= limit_m)) return 0.0;
  const double share = rho_m / limit_m;
  return (1.0 - share * share) * (1.0 - 0.5 * lambda);
}

void require(bool holds, const std::string& what, double value) {
  if (!holds) throw std::invalid_argument("sonar model: " + what + ", not " + std::to_string(value));
}

}  // namespace

double beam_weight(double theta_rad, double beam_width_rad) {
  const double share = 2.0 * std::abs(theta_rad) / beam_width_rad;  // Li X. 2007, eq. (9)
  return share <= 1.0 ? 1.0 - share * share : 0.0;
}

GridMass sonar_li2007(double rho_m, double theta_rad, double reading_m, double epsilon_m, double beam_width_rad,
                      double range_min_m, double rho_v_per_m2, Variant variant) {
  if (std::abs(theta_rad) > 0.5 * beam_width_rad || rho_m < range_min_m) return GridMass::vacuous();
  const double lambda = beam_weight(theta_rad, beam_width_rad);
  const double past = rho_m - reading_m;
  GridMass raw{.empty = empty_mass(rho_m, reading_m - 2.0 * epsilon_m, lambda),  // eq. (5)
               .occupied = 0.0,
               .conflict = 0.0,
               .unknown = 0.0};
  if (rho_m <= reading_m + 2.0 * epsilon_m)
    raw.occupied = std::exp(-3.0 * rho_v_per_m2 * past * past) * lambda;  // eq. (6)
  if (rho_m <= reading_m + epsilon_m) {
    // Eq. (7), negative for rho < R/2 - 2 eps in print: clamped. Resolved: lambda here too, or the edge of the cone
    // near R would be pure conflict.
    const double share = 2.0 * (rho_m - (reading_m - 2.0 * epsilon_m)) / reading_m;
    raw.conflict = std::max(0.0, 1.0 - share * share) * (variant == Variant::kResolved ? lambda : 1.0);
  }
  if (past >= 0.0 && rho_m <= reading_m + 2.0 * epsilon_m)
    raw.unknown = std::tanh(2.0 * past) * (1.0 - lambda);  // eq. (8)
  return variant == Variant::kResolved ? completed(raw) : divided(raw);
}

Li2007::Li2007(const sensors::SonarRing& ring, const Li2007Params& params)
    : beam_width_rad_(ring.beam_width_rad),
      range_min_m_(ring.range_min_m),
      range_max_m_(ring.range_max_m),
      params_(params) {
  require(params.epsilon_m > 0.0 && std::isfinite(params.epsilon_m), "epsilon_m must be above 0", params.epsilon_m);
  require(params.rho_v_per_m2 > 0.0 && std::isfinite(params.rho_v_per_m2), "rho_v_per_m2 must be above 0",
          params.rho_v_per_m2);
  require(params.reliability >= 0.0 && params.reliability < 1.0, "reliability must be in [0, 1)", params.reliability);
  require(params.no_echo_reliability >= 0.0 && params.no_echo_reliability < 1.0,
          "no_echo_reliability must be in [0, 1)", params.no_echo_reliability);
  require(params.no_echo_range_m >= 0.0, "no_echo_range_m must not be negative", params.no_echo_range_m);
  require(ring.beam_width_rad > 0.0 && ring.beam_width_rad < std::numbers::pi,
          "beam_width must be between 0 and pi rad", ring.beam_width_rad);
  require(ring.range_min_m >= 0.0, "range_min must not be negative", ring.range_min_m);
  require(ring.range_max_m > ring.range_min_m && std::isfinite(ring.range_max_m), "range_max must be above range_min",
          ring.range_max_m);
}

GridMass Li2007::mass(double rho_m, double theta_rad, double reading_m) const {
  return sonar_li2007(rho_m, theta_rad, reading_m, params_.epsilon_m, beam_width_rad_, range_min_m_,
                      params_.rho_v_per_m2, params_.variant);
}

GridMass Li2007::no_echo_mass(double rho_m, double theta_rad) const {
  if (std::abs(theta_rad) > 0.5 * beam_width_rad_ || rho_m < range_min_m_ || rho_m > params_.no_echo_range_m)
    return GridMass::vacuous();
  const double empty = empty_mass(rho_m, range_max_m_, beam_weight(theta_rad, beam_width_rad_));
  return {.empty = empty, .occupied = 0.0, .conflict = 0.0, .unknown = 1.0 - empty};
}

double Li2007::reach(double reading_m) const {
  return std::isinf(reading_m) ? std::min(params_.no_echo_range_m, range_max_m_) : reading_m + 2.0 * params_.epsilon_m;
}

}  // namespace credo::mapping
