// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "mapping/knots.hpp"
#include "mapping/sonar_model.hpp"

namespace credo::mapping {

/// What a weight of evidence depends on: linear between knots, constant beyond the first and the last one.
struct SonarKnots {
  /// Where a cell lies beyond the reading. [m] Farther than the last one a reading says nothing.
  static constexpr std::array<double, 16> kPast{-2.4,   -1.6,    -1.1, -0.7,   -0.45, -0.3,  -0.2, -0.125,
                                                -0.075, -0.0375, 0.0,  0.0375, 0.075, 0.125, 0.2,  0.3};
  static constexpr std::array<double, 4> kOffAxis{0.0, 0.35, 0.7, 1.0};           ///< |theta| / half the beam width
  static constexpr std::array<double, 6> kReading{0.2, 0.5, 0.9, 1.4, 2.0, 3.0};  ///< [m]
  static constexpr std::array<double, 8> kRho{0.2, 0.5, 0.9, 1.3, 1.7, 2.1, 2.5, 3.0};  ///< of no echo: distance [m]

  static constexpr std::size_t kEcho = kPast.size() * kOffAxis.size() * kReading.size();
  static constexpr std::size_t kCount = kEcho + kRho.size() * kOffAxis.size();
};

/// Calls visit(index of the weight, share) for the weights that an echo's evidence is the sum of.
template <typename Visit>
void for_each_echo_weight(double rho_m, double off_axis, double reading_m, const Visit& visit);
/// The same where nothing came back.
template <typename Visit>
void for_each_no_echo_weight(double rho_m, double off_axis, const Visit& visit);

/// Those of the simulated 16-sonar ring (sim/worlds/README.md, pioneer-16), from `credo calibrate sonar`.
[[nodiscard]] std::vector<double> default_sonar_weights();

struct CalibratedSonarParams {
  std::vector<double> weights = default_sonar_weights();  ///< SonarKnots::kCount of them
  double reliability = 1.0;  ///< the weights know how far to trust a reading, and that readings from one place repeat
                             ///< each other's errors
};

/// A sonar model learned from readings whose truth is known: each reading adds a weight of evidence to a cell, for
/// "occupied" where it is above 0, for "empty" below: masses 1 - exp(-|w|). Dempster's rule sums them up, and the
/// weights are those of a logistic regression on all readings of a cell (Denoeux 2019, "Logistic regression, neural
/// networks and Dempster-Shafer theory"): unlike a sensor model made from single readings they count what repeats
/// itself once.
class CalibratedSonar {
 public:
  /// \throws std::invalid_argument if there are not SonarKnots::kCount finite weights, the reliability is not in
  ///         [0, 1], or the ring cannot be mapped (check_ring)
  CalibratedSonar(const sensors::SonarRing& ring, const CalibratedSonarParams& params = {});

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const;
  [[nodiscard]] double reliability() const { return params_.reliability; }
  [[nodiscard]] double reach(double reading_m) const { return reading_m + SonarKnots::kPast.back(); }
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }

 private:
  double half_width_rad_;
  CalibratedSonarParams params_;
  NoEcho no_echo_;
};
static_assert(SonarModel<CalibratedSonar>);

// What follows is how it is done.

template <typename Visit>
void for_each_echo_weight(double rho_m, double off_axis, double reading_m, const Visit& visit) {
  const BetweenKnots past = between(SonarKnots::kPast, rho_m - reading_m);
  const BetweenKnots aside = between(SonarKnots::kOffAxis, off_axis), far = between(SonarKnots::kReading, reading_m);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k) {
        const double share = (i ? past.share_of_high : 1.0 - past.share_of_high) *
                             (j ? aside.share_of_high : 1.0 - aside.share_of_high) *
                             (k ? far.share_of_high : 1.0 - far.share_of_high);
        if (share > 0.0)
          visit(((past.low + i) * SonarKnots::kOffAxis.size() + aside.low + j) * SonarKnots::kReading.size() + far.low +
                    k,
                share);
      }
}

template <typename Visit>
void for_each_no_echo_weight(double rho_m, double off_axis, const Visit& visit) {
  const BetweenKnots far = between(SonarKnots::kRho, rho_m), aside = between(SonarKnots::kOffAxis, off_axis);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double share =
          (i ? far.share_of_high : 1.0 - far.share_of_high) * (j ? aside.share_of_high : 1.0 - aside.share_of_high);
      if (share > 0.0) visit(SonarKnots::kEcho + (far.low + i) * SonarKnots::kOffAxis.size() + aside.low + j, share);
    }
}

}  // namespace credo::mapping
