// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Rules that give the conflict back to those that caused it, in proportion to what they claimed. None is associative:
/// all sources are combined at once; a fold depends on the order of its sources, and remembers two or three of them.
/// All are commutative, none is idempotent, all have a result at total conflict. `conflict` says how much was
/// redistributed.
///
/// With three sources and more the vacuous mass function is not neutral in PCR5 and PCR6, whose ignorant sources get a
/// share too: leave vacuous sources out. In PCR2 it is neutral; in PCR5+ and PCR6+, which are here for two elements
/// (evidence/binary_rules.hpp), too.

/// PCR2 (Smarandache and Dezert 2005; Li P., eq. (6)): all conflict together, to the sets that are involved in it,
/// in proportion to the sums of their masses over the sources. Involved is what a conflicting product names and what
/// contains nothing else that it names; a set that a constraint empties stands for the elements that compose it.
[[nodiscard]] Fused pcr2(const Sources& sources);

/// PCR5 (Smarandache and Dezert 2005): each conflicting product goes to the sets in it, in proportion to the product of
/// the masses that its sources give to each. Sets of which nothing exists have no share; if none does, as in DSmH.
/// \throws std::invalid_argument if there are more than kMaxProducts products of focal elements
[[nodiscard]] Fused pcr5(const Sources& sources);

/// PCR6 (Martin and Osswald 2006): as PCR5, in proportion to the sum of these masses. The same for two sources; for
/// categorical sources the share of votes.
[[nodiscard]] Fused pcr6(const Sources& sources);

inline constexpr double kMaxProducts = 1e8;

}  // namespace credo::evidence
