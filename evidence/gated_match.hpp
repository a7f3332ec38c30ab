// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Whether two things are the same, by several criteria that are left in conflict (TBM).
struct GatedMatch {
  OpenBinaryMass mass;
  bool match = false;
};

/// Largest conflict between the criteria at which a match is accepted (Clerentin et al., sec. 4.2).
inline constexpr double kMaxMatchConflict = 0.7;

/// Match where the criteria do not conflict too much and say YES more than NO. Conflict equal to the limit passes; YES
/// equal to NO does not (both to 1e-12).
[[nodiscard]] GatedMatch gated_match(std::span<const BinaryMass> criteria, double max_conflict = kMaxMatchConflict);

}  // namespace credo::evidence
