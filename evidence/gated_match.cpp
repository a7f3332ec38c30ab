// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/gated_match.hpp"

namespace credo::evidence {

GatedMatch gated_match(std::span<const BinaryMass> criteria, double max_conflict) {
  constexpr double kRounding = 1e-12;
  const OpenBinaryMass mass = conjunctive(criteria);
  return {mass, mass.conflict <= max_conflict + kRounding && mass.yes > mass.no + kRounding};
}

}  // namespace credo::evidence
