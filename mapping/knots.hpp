// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>

namespace credo::mapping {

/// A place between two knots of what is linear between them, and constant beyond the first and the last one.
struct BetweenKnots {
  std::size_t low = 0;
  double share_of_high = 0.0;
};

template <std::size_t N>
[[nodiscard]] constexpr BetweenKnots between(const std::array<double, N>& knots, double x) {
  if (!(x > knots.front())) return {0, 0.0};
  for (std::size_t i = 1; i < N; ++i)
    if (x < knots[i]) return {i - 1, (x - knots[i - 1]) / (knots[i] - knots[i - 1])};
  return {N - 2, 1.0};
}

}  // namespace credo::mapping
