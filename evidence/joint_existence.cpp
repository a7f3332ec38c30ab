// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/joint_existence.hpp"

namespace credo::evidence {

std::optional<FusedBinaryMass> joint_existence(const BinaryMass& part_a, const BinaryMass& part_b,
                                               const BinaryMass& kind, FusionRule rule) {
  const std::optional<FusedBinaryMass> parts = fuse({part_a, part_b}, rule);
  if (!parts) return std::nullopt;
  std::optional<FusedBinaryMass> whole = fuse({parts->mass, kind}, rule);
  if (whole) whole->conflict += parts->conflict - whole->conflict * parts->conflict;
  return whole;
}

}  // namespace credo::evidence
