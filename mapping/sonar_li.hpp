// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "mapping/sonar_model.hpp"

namespace credo::mapping {

// The three DSmT sonar models: each gives a cell masses of empty, occupied, conflict (where the two cross) and
// ignorance.

struct Li2006SonarParams {
  double epsilon_m = 0.05;    ///< range error; not in the paper
  double rho_v_per_m2 = 100;  ///< narrowness of the occupied lobe; 1 in print, which makes walls half a metre thick
  double reliability = 0.7;   ///< p of eq. (4); not in the paper
  NoEchoParams no_echo{};
  Variant variant = Variant::kResolved;
};

struct Li2007Params {
  double epsilon_m = 0.05;    ///< range error
  double rho_v_per_m2 = 100;  ///< as of Li2006SonarParams
  double reliability = 0.8;   ///< discounts every reading; below 1 no reading is dogmatic
  NoEchoParams no_echo{};
  Variant variant = Variant::kResolved;
};

struct LiPParams {
  double epsilon_m = 0.1;  ///< range error; not in the paper
  double rho_e = 0.35;     ///< width of the empty lobe, as a share of the reading
  double rho_o = 0.1;      ///< width of the occupied lobe [m^0.5]
  double rho_c = 80.0;     ///< narrowness of the conflict
  double rho_i = 10.0;     ///< slope of the ignorance
  double reliability = 0.8;
  NoEchoParams no_echo{};
  Variant variant = Variant::kResolved;
};

/// Li X. 2006, eqs. (5)-(9), without discounting. Resolved: the radial profile completed, then discounted by lambda: in
/// print lambda cancels. rho_m outside of the ring's range, or theta outside of the cone: vacuous.
[[nodiscard]] evidence::GridMass sonar_li2006(double rho_m, double theta_rad, double reading_m,
                                              const sensors::SonarRing& ring, double epsilon_m, double rho_v_per_m2,
                                              Variant variant);

/// Li X. 2007, eqs. (5)-(9), without discounting. Resolved: lambda on the conflict too, and completed. rho_m below the
/// ring's range_min or theta outside of the cone: vacuous.
[[nodiscard]] evidence::GridMass sonar_li2007(double rho_m, double theta_rad, double reading_m,
                                              const sensors::SonarRing& ring, double epsilon_m, double rho_v_per_m2,
                                              Variant variant);

/// Li P., eqs. (7)-(12), without discounting. Resolved: lambda on the conflict too, and completed.
[[nodiscard]] evidence::GridMass sonar_lip(double rho_m, double theta_rad, double reading_m,
                                           const sensors::SonarRing& ring, const LiPParams& params);

/// A sonar that one of the formulas above is the model of.
template <typename Params>
class FormulaSonar {
 public:
  /// \throws std::invalid_argument if a parameter is out of its range, or the ring cannot be mapped (check_ring).
  FormulaSonar(const sensors::SonarRing& ring, const Params& params = {});

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const;
  [[nodiscard]] double reliability() const { return params_.reliability; }
  [[nodiscard]] double reach(double reading_m) const;
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }

 private:
  sensors::SonarRing ring_;
  Params params_;
  NoEcho no_echo_;
};

using Li2006Sonar = FormulaSonar<Li2006SonarParams>;
using Li2007 = FormulaSonar<Li2007Params>;
using LiPSonar = FormulaSonar<LiPParams>;
static_assert(SonarModel<Li2006Sonar> && SonarModel<Li2007> && SonarModel<LiPSonar>);

}  // namespace credo::mapping
