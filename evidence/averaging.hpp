// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <span>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Sum of the weights of an average; without weights each source has 1.
/// \throws std::invalid_argument unless there are none, or one for each source, >= 0, finite and not all 0
[[nodiscard]] double total_weight(std::span<const double> weights, std::size_t sources);

/// Mean of the mass functions, set by set. For sources of which nothing is known, dependent or not. Idempotent,
/// commutative, not associative; the vacuous mass function is not neutral: it dilutes. No conflict arises.
/// \param weights  none for equal ones; else one for each source, >= 0, not all 0
/// \throws std::invalid_argument for others
[[nodiscard]] MassFunction average(const Sources& sources, std::span<const double> weights = {});

/// Murphy's rule (2000): the mean of s sources, combined with itself s - 1 times by Dempster's rule: sharpens where
/// they agree, without letting one veto. Commutative; neither associative nor idempotent. `conflict` is what the mean
/// had with itself. \returns nothing if all mass of all sources is on ∅
[[nodiscard]] std::optional<Fused> murphy(const Sources& sources);

}  // namespace credo::evidence
