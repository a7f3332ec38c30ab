// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>

#include "evidence/grid_mass.hpp"
#include "sensors/sonar_ring.hpp"

namespace credo::mapping {

/// What one reading of a transducer says about a cell at distance `rho` and angle `theta` from the beam axis, and how
/// far such a reading is to be trusted. Lengths from the transducer; masses before discounting.
template <typename Model>
concept SonarModel = requires(const Model& model, double rho_m, double theta_rad, double reading_m) {
  { model.mass(rho_m, theta_rad, reading_m) } -> std::same_as<evidence::GridMass>;  // an echo at reading_m
  { model.reliability() } -> std::convertible_to<double>;                           // in [0, 1)
  { model.no_echo_mass(rho_m, theta_rad) } -> std::same_as<evidence::GridMass>;     // nothing came back
  { model.no_echo_reliability() } -> std::convertible_to<double>;
  { model.reach(reading_m) } -> std::convertible_to<double>;  // vacuous beyond; no echo: of an infinite reading
};

/// The formulas as printed, brought to sum 1 by division; or as resolved (docs/equations.md): lambda on the conflict
/// too, and the mass that is missing to 1 goes to ignorance.
enum class Variant { kResolved, kPrinted };

struct Li2007Params {
  double epsilon_m = 0.05;            ///< range error
  double rho_v_per_m2 = 100;          ///< narrowness of the occupied lobe; 1 in print, which makes walls 0.5 m thick
  double reliability = 0.8;           ///< discounts every reading, in [0, 1); below 1 no reading is dogmatic
  double no_echo_reliability = 0.05;  ///< of "empty" where nothing came back; specular misses make it weak
  double no_echo_range_m = 2.0;       ///< and up to here only, or the ring's range_max where that is nearer
  Variant variant = Variant::kResolved;
};

/// Sonar of Li X. 2007, eqs. (5)-(9), with discounting (Li X. 2006, eq. (4)).
class Li2007 {
 public:
  /// \param ring  gives beam width (omega), range_min (R_min) and range_max
  /// \throws std::invalid_argument if a parameter is out of its range or the beam is not between 0 and pi wide.
  Li2007(const sensors::SonarRing& ring, const Li2007Params& params = {});

  /// Resolved or printed masses of an echo at `reading_m`.
  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const;
  [[nodiscard]] double reliability() const { return params_.reliability; }
  /// Free space as of eq. (5) with R - 2 eps = range_max: no echo is taken as an echo from beyond the range.
  [[nodiscard]] evidence::GridMass no_echo_mass(double rho_m, double theta_rad) const;
  [[nodiscard]] double no_echo_reliability() const { return params_.no_echo_reliability; }
  [[nodiscard]] double reach(double reading_m) const;

 private:
  double beam_width_rad_ = 0.0;
  double range_min_m_ = 0.0;
  double range_max_m_ = 0.0;
  Li2007Params params_;
};
static_assert(SonarModel<Li2007>);

/// The beam shape lambda: 1 on the axis, 0 at the edge of the cone (Li X. 2007, eq. (9)).
[[nodiscard]] double beam_weight(double theta_rad, double beam_width_rad);

/// Li X. 2007, eqs. (5)-(8), brought to sum 1 by `variant`; no discounting. rho_m below `range_min_m` or theta outside
/// the cone: vacuous.
[[nodiscard]] evidence::GridMass sonar_li2007(double rho_m, double theta_rad, double reading_m, double epsilon_m,
                                              double beam_width_rad, double range_min_m, double rho_v_per_m2,
                                              Variant variant);

}  // namespace credo::mapping
