// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <concepts>

#include "evidence/log_commonality.hpp"

namespace credo::mapping {

/// Reliabilities are rounded to this many steps, so that increments come from tables.
inline constexpr int kLevels = 32;

/// The nearest step to a reliability in [0, 1]; 0 is no evidence, kLevels full reliability.
template <std::floating_point Real>
[[nodiscard]] int level_of(Real reliability) {
  return static_cast<int>(reliability * Real{kLevels} + Real{0.5});
}
[[nodiscard]] constexpr double reliability_of(int level) { return static_cast<double>(level) / kLevels; }

/// What a mass adds to a cell, at every level of `reliability`.
[[nodiscard]] inline std::array<evidence::FixedLogCommonality, kLevels + 1> increments(const evidence::GridMass& mass,
                                                                                       double reliability) {
  std::array<evidence::FixedLogCommonality, kLevels + 1> table;
  for (int level = 0; level <= kLevels; ++level)
    table[level] = evidence::fixed_increment(mass, reliability * reliability_of(level));
  return table;
}

}  // namespace credo::mapping
