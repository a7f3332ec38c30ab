// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Belief that something exists that rests on two parts and on a judgement of its kind: rule(rule(part_a, part_b),
/// kind), as Clerentin et al., sec. 3.2, have it for corners, edges and others. Two weak parts reinforce each other.
/// \param kind  belief_in_kind of the decided kind
/// \returns nothing at total conflict under Dempster's rule; `conflict` is that of both steps.
[[nodiscard]] std::optional<FusedBinaryMass> joint_existence(const BinaryMass& part_a, const BinaryMass& part_b,
                                                             const BinaryMass& kind, FusionRule rule);

}  // namespace credo::evidence
