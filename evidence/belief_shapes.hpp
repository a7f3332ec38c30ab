// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// 1 until `full_until`, 0 from `zero_from`, linear between. With full_until > zero_from it grows instead: 0 until
/// `zero_from`, 1 from `full_until`. Equal breakpoints make a step that still is 1 at the breakpoint.
[[nodiscard]] constexpr double falling(double x, double full_until, double zero_from) {
  if (full_until == zero_from) return x <= full_until ? 1.0 : 0.0;
  const double share = (zero_from - x) / (zero_from - full_until);
  return share <= 0.0 ? 0.0 : share >= 1.0 ? 1.0 : share;
}

/// 1 - falling(x, zero_until, full_from): 0 until `zero_until`, 1 from `full_from`.
[[nodiscard]] constexpr double rising(double x, double zero_until, double full_from) {
  return 1.0 - falling(x, zero_until, full_from);
}

/// Belief as a piecewise linear function of one measured quantity: the shape of every criterion of Clerentin et al.
/// (figs. 7, 9, 12, 14). The unit of the breakpoints is the caller's. Breakpoints may run either way: for a quantity
/// that is the better the larger, yes_full_until > yes_zero_from and no_zero_until > no_full_from.
struct RampBelief {
  double max_yes = 0.0;
  double yes_full_until = 0.0;
  double yes_zero_from = 1.0;
  double max_no = 0.0;
  double no_zero_until = 0.0;
  double no_full_from = 1.0;

  /// nan, a quantity that could not be measured, gives the vacuous mass.
  [[nodiscard]] constexpr BinaryMass operator()(double x) const {
    if (x != x) return BinaryMass::vacuous();
    const double yes = max_yes * falling(x, yes_full_until, yes_zero_from);
    const double no = max_no * rising(x, no_zero_until, no_full_from);
    const double unknown = 1.0 - yes - no;
    return {.yes = yes, .no = no, .unknown = unknown > 0.0 ? unknown : 0.0};
  }

  friend bool operator==(const RampBelief&, const RampBelief&) = default;
};

/// For parameters that a user has set.
/// \throws std::invalid_argument  that begins with `name` and says what was found, unless all breakpoints are finite,
///   both ramps run the same way and yes + no <= 1 everywhere
void check(const RampBelief& shape, const char* name);

}  // namespace credo::evidence
