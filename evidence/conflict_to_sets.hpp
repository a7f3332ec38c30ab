// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Rules that move the conflict of the conjunctive rule to larger sets. None is associative: all sources are combined
/// at once, and folding them gives another result. They are commutative, not idempotent. Every one has a result at
/// total conflict, and `conflict` says how much was moved.

/// Conflict to ignorance (Yager 1987; Clerentin et al., sec. 3.1): m(∅) of all sources together goes to Θ, once. The
/// vacuous mass function is neutral. Total conflict gives it.
[[nodiscard]] Fused conflict_to_ignorance(const Sources& sources);

/// Dubois and Prade (1988): a product whose sets meet nowhere goes to their union. Exact for any number of sources. The
/// vacuous mass function is neutral beside one source; beside two that conflict it is not, but on two elements. Where
/// all sets of a product are empty in the model, it stays on ∅.
[[nodiscard]] Fused dubois_prade(const Sources& sources);

/// DSm hybrid rule (Smarandache and Dezert, Advances and Applications of DSmT vol. 1, 2004, ch. 4: S1 + S2 + S3). A
/// product whose sets meet nowhere goes to their union; if all of them are empty under the constraints, to the union of
/// the elements that compose them; if these do not exist either, to Θ. On a power set the rule of Dubois and Prade.
/// Vacuous sources are neutral as there.
[[nodiscard]] Fused dsmh(const Sources& sources);

}  // namespace credo::evidence
