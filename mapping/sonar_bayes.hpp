// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "mapping/sonar_li.hpp"

namespace credo::mapping {

struct BayesSonarParams {
  Li2007Params matched;  ///< one reading gives the same probability as this one's pignistic one
};

/// The baseline: the inverse sensor model of an occupancy grid, which adds log-odds. Its probabilities are the
/// pignistic ones of Li X. 2007, discounted by that model's reliabilities. As masses: simple ones whose weight is the
/// log-odds, so that the rule `bayes` reads the filter's probability. Where a pose or a repetition discounts further,
/// the mass is discounted.
class BayesSonar {
 public:
  /// \throws std::invalid_argument as Li2007
  BayesSonar(const sensors::SonarRing& ring, const BayesSonarParams& params = {});

  [[nodiscard]] evidence::GridMass mass(double rho_m, double theta_rad, double reading_m) const;
  [[nodiscard]] double reliability() const;
  [[nodiscard]] double reach(double reading_m) const { return matched_.reach(reading_m); }
  [[nodiscard]] const NoEcho& no_echo() const { return no_echo_; }

 private:
  Li2007 matched_;
  NoEcho no_echo_;
};
static_assert(SonarModel<BayesSonar>);

}  // namespace credo::mapping
