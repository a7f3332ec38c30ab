// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>

namespace credo::perception {

/// Tukey's biweight: 1 for a residual of 0, falling to 0 at `limit` and beyond.
[[nodiscard]] inline double tukey_weight(double residual, double limit) {
  if (std::abs(residual) >= limit) return 0.0;
  const double rest = 1.0 - (residual / limit) * (residual / limit);
  return rest * rest;
}

}  // namespace credo::perception
