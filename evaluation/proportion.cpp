// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/proportion.hpp"

#include "evidence/predictive_belief.hpp"

namespace credo::evaluation {

std::optional<double> Proportion::share() const {
  if (of == 0) return {};
  return static_cast<double>(count) / static_cast<double>(of);
}

Bounds Proportion::interval() const {
  const evidence::BinaryMass next = evidence::predictive_belief(count, of, 0.95);
  return {.lower = next.belief(), .upper = next.plausibility()};
}

// Of the 10 % outside of a two-sided interval at 90 %, half lies above it.
double Proportion::upper_bound() const { return evidence::predictive_belief(count, of, 0.90).plausibility(); }

}  // namespace credo::evaluation
