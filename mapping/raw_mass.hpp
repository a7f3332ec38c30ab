// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/grid_mass.hpp"

namespace credo::mapping {

// The papers give four numbers for a cell that need not sum to 1.

/// Divided by their sum, as the print asks; vacuous where there is next to nothing.
[[nodiscard]] inline evidence::GridMass divided(const evidence::GridMass& raw) {
  constexpr double kNothing = 1e-12;
  const double sum = raw.empty + raw.occupied + raw.conflict + raw.unknown;
  if (sum <= kNothing) return evidence::GridMass::vacuous();
  return {raw.empty / sum, raw.occupied / sum, raw.conflict / sum, raw.unknown / sum};
}

/// As resolved: what is missing to 1 is ignorance, a sum above 1 is divided out.
[[nodiscard]] inline evidence::GridMass completed(const evidence::GridMass& raw) {
  const double sum = raw.empty + raw.occupied + raw.conflict + raw.unknown;
  if (sum > 1.0) return divided(raw);
  return {raw.empty, raw.occupied, raw.conflict, raw.unknown + (1.0 - sum)};
}

}  // namespace credo::mapping
