// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Conjunctive rule: m(A) = Σ Π m_i(X_i) over all X_1 ∩ … ∩ X_s = A; the conflict stays as m(∅). All sources are
/// reliable and independent. On a free model it is the DSm classic rule (Li X. 2006, eq. (3)), where intersections
/// exist and nothing is in conflict; on a power set the unnormalised rule of the TBM (Smets 1990).
/// Associative, commutative, not idempotent; the vacuous mass function is neutral. Total conflict is m(∅) = 1.
/// Dense sources on power sets go through commonalities, in O(n 2^n); rounding then is relative to 1.
/// \throws std::invalid_argument unless all sources have one frame; this holds for all rules
[[nodiscard]] MassFunction conjunctive(const Sources& sources);

/// Dempster's rule (Shafer 1976; Li X. 2007, eq. (12)): the conjunctive rule without m(∅), divided by the sum of the
/// rest, not by 1 - m(∅), which has no digits left near total conflict. Exact for any number of opposed sources.
/// Associative, commutative, not idempotent; the vacuous mass function is neutral.
/// \returns nothing at total conflict, or where all that one source leaves of the others is below the smallest double
[[nodiscard]] std::optional<Fused> dempster(const Sources& sources);

/// What is left of a mass function if the truth is known to be in `event`: Dempster's conditioning, m combined with the
/// categorical mass function of the event. \returns nothing if m contradicts it totally
[[nodiscard]] std::optional<Fused> condition(const MassFunction& mass, const Proposition& event);

/// Takes `part` out of what the conjunctive rule made of it and others: q = q_whole / q_part (Smets 1995). Not of
/// Dempster's result, whose conflict is gone. Power sets of up to kMaxDenseElements elements.
/// \returns nothing where the quotient is no mass function: `part` cannot have been in `whole`
/// \throws std::invalid_argument for a dogmatic part (m(Θ) = 0), whose evidence cannot be taken out
[[nodiscard]] std::optional<MassFunction> decombine(const MassFunction& whole, const MassFunction& part);

}  // namespace credo::evidence
