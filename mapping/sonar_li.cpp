// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_li.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "mapping/raw_mass.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;
using evidence::ParameterCheck;
using sensors::SonarRing;

constexpr GridMass kNothing{.empty = 0.0, .occupied = 0.0, .conflict = 0.0, .unknown = 0.0};

bool in_cone(double theta_rad, const SonarRing& ring) { return std::abs(theta_rad) <= 0.5 * ring.beam_width_rad; }

/// A parabola with its top at R - 2 eps, negative for rho < R/2 - 2 eps in print: clamped (Li X. 2006, eq. (7); Li X.
/// 2007, eq. (7)).
double conflict_profile(double rho_m, double reading_m, double epsilon_m) {
  const double share = 2.0 * (rho_m - (reading_m - 2.0 * epsilon_m)) / reading_m;
  return std::max(0.0, 1.0 - share * share);
}

double occupied_profile(double past_m, double rho_v_per_m2) { return std::exp(-3.0 * rho_v_per_m2 * past_m * past_m); }

/// Li X. 2006, eqs. (5)-(8), with a given lambda.
GridMass raw_li2006(double rho, double R, const SonarRing& ring, double eps, double rho_v, double lambda,
                    Variant variant) {
  GridMass raw = kNothing;
  const double rmin = ring.range_min_m, rmax = ring.range_max_m;
  if (rho < rmin || rho > rmax) return raw;
  if (rho <= R && R <= rmax) {
    raw.empty = (1.0 - (rho / R) * (rho / R)) * lambda;     // eq. (5)
    raw.conflict = conflict_profile(rho, R, eps) * lambda;  // eq. (7)
  }
  // Eq. (6): in print nothing is occupied for the last readings before the range ends.
  const bool near = rho <= R + eps && (variant == Variant::kPrinted ? R + eps <= rmax : R <= rmax);
  if (near) raw.occupied = occupied_profile(rho - R, rho_v) * lambda;
  if (rho >= R) raw.unknown = std::tanh(2.0 * (rho - R)) * lambda;  // eq. (8)
  return raw;
}

}  // namespace

GridMass sonar_li2006(double rho_m, double theta_rad, double reading_m, const SonarRing& ring, double epsilon_m,
                      double rho_v_per_m2, Variant variant) {
  if (!in_cone(theta_rad, ring)) return GridMass::vacuous();
  const double lambda = beam_weight(theta_rad, ring.beam_width_rad);  // eq. (9)
  if (variant == Variant::kPrinted)
    return divided(raw_li2006(rho_m, reading_m, ring, epsilon_m, rho_v_per_m2, lambda, variant));
  return discount(completed(raw_li2006(rho_m, reading_m, ring, epsilon_m, rho_v_per_m2, 1.0, variant)), lambda);
}

GridMass sonar_li2007(double rho_m, double theta_rad, double reading_m, const SonarRing& ring, double epsilon_m,
                      double rho_v_per_m2, Variant variant) {
  if (!in_cone(theta_rad, ring) || rho_m < ring.range_min_m) return GridMass::vacuous();
  const double lambda = beam_weight(theta_rad, ring.beam_width_rad);  // eq. (9)
  const double past = rho_m - reading_m, limit = reading_m - 2.0 * epsilon_m;
  GridMass raw = kNothing;
  if (limit > 0.0 && rho_m <= limit)
    raw.empty = (1.0 - (rho_m / limit) * (rho_m / limit)) * (1.0 - 0.5 * lambda);             // eq. (5)
  if (past <= 2.0 * epsilon_m) raw.occupied = occupied_profile(past, rho_v_per_m2) * lambda;  // eq. (6)
  if (past <= epsilon_m)                                                                      // eq. (7)
    raw.conflict = conflict_profile(rho_m, reading_m, epsilon_m) * (variant == Variant::kResolved ? lambda : 1.0);
  if (past >= 0.0 && past <= 2.0 * epsilon_m) raw.unknown = std::tanh(2.0 * past) * (1.0 - lambda);  // eq. (8)
  return variant == Variant::kResolved ? completed(raw) : divided(raw);
}

GridMass sonar_lip(double d, double theta_rad, double R, const SonarRing& ring, const LiPParams& p) {
  if (!in_cone(theta_rad, ring) || d < ring.range_min_m || d > R + 2.0 * p.epsilon_m || !(d > 0.0))
    return GridMass::vacuous();
  const double lambda = beam_weight(theta_rad, ring.beam_width_rad);  // eq. (12)
  const double root = std::sqrt(R);
  const double beta = std::log(p.rho_e * R * root / (p.rho_e * root + p.rho_o));  // eq. (11)
  GridMass raw = kNothing;
  raw.empty = (1.0 - 0.5 * lambda) * std::exp(-d * d / (2.0 * (R * p.rho_e) * (R * p.rho_e)));  // eq. (7)
  raw.occupied = lambda * std::exp(-(d - R) * (d - R) / (2.0 * R * p.rho_o * p.rho_o));         // eq. (8)
  const double off = std::log(d) - beta;
  raw.conflict = std::exp(-p.rho_c * off * off) * (p.variant == Variant::kResolved ? lambda : 1.0);  // eq. (9)
  if (d >= R + p.epsilon_m)
    raw.unknown = (1.0 - lambda) * std::tanh(p.rho_i * (d - (R + p.epsilon_m)) / R);  // eq. (10)
  return p.variant == Variant::kResolved ? completed(raw) : divided(raw);
}

namespace {

template <typename Params>
void check_params(const Params& params) {
  const ParameterCheck check("sonar model: ");
  check.positive("epsilon_m", params.epsilon_m);
  check.share("reliability", params.reliability);
  if constexpr (std::is_same_v<Params, LiPParams>) {
    check.positive("rho_e", params.rho_e);
    check.positive("rho_o", params.rho_o);
    check.positive("rho_c", params.rho_c);
    check.positive("rho_i", params.rho_i);
  } else {
    check.positive("rho_v_per_m2", params.rho_v_per_m2);
  }
}

GridMass mass_by(const Li2006SonarParams& p, double rho_m, double theta_rad, double reading_m, const SonarRing& ring) {
  return sonar_li2006(rho_m, theta_rad, reading_m, ring, p.epsilon_m, p.rho_v_per_m2, p.variant);
}
GridMass mass_by(const Li2007Params& p, double rho_m, double theta_rad, double reading_m, const SonarRing& ring) {
  return sonar_li2007(rho_m, theta_rad, reading_m, ring, p.epsilon_m, p.rho_v_per_m2, p.variant);
}
GridMass mass_by(const LiPParams& p, double rho_m, double theta_rad, double reading_m, const SonarRing& ring) {
  return sonar_lip(rho_m, theta_rad, reading_m, ring, p);
}

}  // namespace

template <typename Params>
FormulaSonar<Params>::FormulaSonar(const SonarRing& ring, const Params& params)
    : ring_(ring), params_(params), no_echo_(ring, params.no_echo) {
  check_ring(ring);
  check_params(params);
}

template <typename Params>
GridMass FormulaSonar<Params>::mass(double rho_m, double theta_rad, double reading_m) const {
  return mass_by(params_, rho_m, theta_rad, reading_m, ring_);
}

template <typename Params>
double FormulaSonar<Params>::reach(double reading_m) const {
  if constexpr (std::is_same_v<Params, Li2006SonarParams>)
    return std::min(reading_m + params_.epsilon_m, ring_.range_max_m);
  else
    return reading_m + 2.0 * params_.epsilon_m;
}

template class FormulaSonar<Li2006SonarParams>;
template class FormulaSonar<Li2007Params>;
template class FormulaSonar<LiPParams>;

}  // namespace credo::mapping
