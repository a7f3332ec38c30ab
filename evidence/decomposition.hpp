// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// A mass function as the conjunction of simple ones, A with the weight w(A) on Θ and 1 - w(A) on A, one for each
/// A ≠ Θ (Smets 1995). Weights over 1 take evidence back. Power sets of up to kMaxDenseElements elements; entry `bits`
/// belongs to the subset whose elements are the bits that are set.
struct CanonicalDecomposition {
  Frame frame;
  std::vector<double> log_weights;  ///< ln w(A); size 2^n, 0 where A does not occur and at Θ

  friend bool operator==(const CanonicalDecomposition&, const CanonicalDecomposition&) = default;
};

/// ln w(A) = -Σ over B ⊇ A of (-1)^(|B| - |A|) ln q(B). A sum of up to 2^n logarithms: a mass recomposed from it is
/// good to some 1e-12 on sparse mass functions, 1e-8 on dense ones of 14 elements.
/// \throws std::invalid_argument for a dogmatic mass function (m(Θ) = 0), which has no weights: discount it first; on
///         another model than Shafer's
[[nodiscard]] CanonicalDecomposition decompose(const MassFunction& mass);

/// The conjunction of the simple ones. \throws std::invalid_argument where the weights make none
[[nodiscard]] MassFunction recompose(const CanonicalDecomposition& decomposition);

/// Cautious rule (Denoeux 2008): the smallest weight that a source gives to each simple one. For reliable sources that
/// may share evidence. Associative, commutative, idempotent; the vacuous mass function is neutral only for mass
/// functions whose weights are <= 1 (separable ones). Conflict stays as m(∅), total conflict cannot arise.
/// \throws std::invalid_argument as decompose
[[nodiscard]] MassFunction cautious(const Sources& sources);

/// Bold rule (Denoeux 2008): the disjunctive counterpart. For sources that may share evidence and of which one is
/// reliable. Associative, commutative, idempotent; conflict cannot arise.
/// \throws std::invalid_argument for a source without mass on ∅, where it is not defined; on another model than Shafer's
[[nodiscard]] MassFunction bold(const Sources& sources);

/// The mass function of the complements: m'(A) = m(¬A). Power sets only. \throws std::invalid_argument on other models
[[nodiscard]] MassFunction negation(const MassFunction& mass);

}  // namespace credo::evidence
