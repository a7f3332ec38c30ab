// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// What a mass function says about one proposition. All are sums over focal elements: no enumeration, any frame.
/// (Shafer 1976; Li X. 2007, eq. (2) and (3)).

/// Bel(A): the mass of all that implies A; what is on ∅ counts nowhere.
[[nodiscard]] double belief(const MassFunction& mass, const Proposition& set);
/// Pl(A): the mass of all that meets A. On a free model 1 for every A.
[[nodiscard]] double plausibility(const MassFunction& mass, const Proposition& set);
/// q(A): the mass of all that A implies; q(∅) = 1.
[[nodiscard]] double commonality(const MassFunction& mass, const Proposition& set);
/// b(A) = Bel(A) + m(∅).
[[nodiscard]] double implicability(const MassFunction& mass, const Proposition& set);

/// How much a mass function leaves open, in bits. They need m(∅) = 0, or count it as nothing.

/// Σ m(A) log2 |A|: what is not decided between the elements (Dubois and Prade 1985). |A| is the DSm cardinality.
[[nodiscard]] double nonspecificity(const MassFunction& mass);
/// -Σ m(A) log2 Pl(A): what contradicts the rest (Yager 1983). 0 on free models.
[[nodiscard]] double dissonance(const MassFunction& mass);
/// -Σ m(A) log2 Σ m(B) |A ∩ B| / |A|: contradiction by degrees (strife; Klir and Parviz 1992).
[[nodiscard]] double strife(const MassFunction& mass);
/// Shannon's entropy of the (generalised) pignistic probabilities of the Venn regions.
/// \throws std::domain_error at m(∅) = 1
[[nodiscard]] double pignistic_entropy(const MassFunction& mass);
/// Shannon's entropy of the plausibility transform + nonspecificity (Jirousek and Shenoy 2018). Power sets only.
/// \throws std::domain_error at m(∅) = 1; std::invalid_argument on another model
[[nodiscard]] double jirousek_shenoy_entropy(const MassFunction& mass);

/// m(∅) of the two under the conjunctive rule: the degree of conflict, in [0, 1]. Not a distance: it may be > 0 between
/// equal ones.
[[nodiscard]] double conflict_between(const MassFunction& a, const MassFunction& b);
/// Jousselme, Grenier and Bosse (2001): sqrt((a - b)' D (a - b) / 2), D(A, B) = |A ∩ B| / |A ∪ B|. A metric in [0, 1].
[[nodiscard]] double jousselme_distance(const MassFunction& a, const MassFunction& b);

}  // namespace credo::evidence
