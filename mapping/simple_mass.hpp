// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>

#include "evidence/log_commonality.hpp"

namespace credo::mapping {

/// What all readings are discounted by in the end: no reading is a certainty (evidence::fixed_increment).
inline constexpr double kFullTrust = evidence::FixedLogCommonality::kMaxReliability;

/// A weight of evidence for one of the two: 1 - exp(-|weight|) on "occupied" above 0, on "empty" below. Dempster's rule
/// adds such weights up, and the log-odds of its plausibilities are their sum.
[[nodiscard]] inline evidence::GridMass simple_mass(double weight) {
  const double mass = -std::expm1(-std::abs(weight));
  return {.empty = weight < 0.0 ? mass : 0.0,
          .occupied = weight > 0.0 ? mass : 0.0,
          .conflict = 0.0,
          .unknown = 1.0 - mass};
}

/// The mass that, discounted by kFullTrust, is this one. One whose ignorance is below 1 - kFullTrust keeps so much.
[[nodiscard]] inline evidence::GridMass before_full_trust(const evidence::GridMass& mass) {
  const double committed = mass.empty + mass.occupied + mass.conflict;
  const double by = std::max(kFullTrust, committed);
  return {.empty = mass.empty / by,
          .occupied = mass.occupied / by,
          .conflict = mass.conflict / by,
          .unknown = 1.0 - committed / by};
}

/// What a Bayes filter of log-odds adds for a reading of this mass, discounted: the log-odds of its pignistic
/// probability of "occupied", its conflict divided out.
[[nodiscard]] inline double pignistic_log_odds(const evidence::GridMass& mass, double reliability) {
  const double occupied = evidence::pignistic(evidence::discount(mass, reliability), evidence::GridElement::kOccupied,
                                              evidence::GridModel::kExclusive);
  return std::log(occupied / (1.0 - occupied));
}

}  // namespace credo::mapping
