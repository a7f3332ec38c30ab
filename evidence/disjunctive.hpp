// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Disjunctive rule: m(A) = Σ Π m_i(X_i) over all X_1 ∪ … ∪ X_s = A (Dubois and Prade 1986). At least one source is
/// reliable, nobody knows which. No conflict arises, at total conflict neither. Associative, commutative, not
/// idempotent; the vacuous mass function absorbs all others (neutral would be m(∅) = 1).
[[nodiscard]] MassFunction disjunctive(const Sources& sources);

}  // namespace credo::evidence
