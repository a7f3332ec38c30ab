// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "evidence/grid_mass.hpp"
#include "evidence/source_list.hpp"

namespace credo::evidence {

/// The rules of rules.hpp on the frame {empty, occupied} whose elements may overlap, in closed form; dsmc is in
/// grid_mass.hpp. All are commutative.

using GridSources = SourceList<GridMass>;

/// Disjunctive rule: the union of what the sources name. Associative, the same under both models: the overlap, that
/// exists or is the empty set, is part of all and neutral. No source gives all mass to it.
[[nodiscard]] GridMass disjunctive(const GridSources& sources);

/// Mean of the masses, the same under both models. \throws std::invalid_argument for no source
[[nodiscard]] GridMass average(const GridSources& sources);

/// What follows is under the exclusive model, where nothing is both empty and occupied: what a source itself gives to
/// the overlap is conflict as well (Li P., eq. (6)). Results have none of it left. No source gives the vacuous mass.

/// A mass without conflict, and the conflict that was met (and moved or divided out) on the way to it.
struct FusedGridMass {
  GridMass mass;
  double conflict = 0.0;

  friend constexpr bool operator==(const FusedGridMass&, const FusedGridMass&) = default;
};

/// Dempster's rule. Associative; exact for any number of opposed sources.
/// \returns nothing at total conflict
[[nodiscard]] std::optional<FusedGridMass> dempster(const GridSources& sources);

/// Conflict to ignorance (Yager), all at once. Total conflict gives the vacuous mass.
[[nodiscard]] FusedGridMass conflict_to_ignorance(const GridSources& sources);

/// DSm hybrid rule (Smarandache and Dezert 2004): a conflicting product goes to the union of what exists of it, one of
/// overlaps alone to ignorance.
[[nodiscard]] FusedGridMass dsmh(const GridSources& sources);

/// PCR2 (Smarandache and Dezert 2005; Li P., eq. (6)): all conflict goes to empty and occupied, in proportion to the
/// sums of their masses over the sources; to ignorance if no source gives them any.
[[nodiscard]] FusedGridMass pcr2(const GridSources& sources);

/// PCR5 and PCR6, which are the same for two sources: each product of empty and occupied is shared in proportion to its
/// two masses; one with an overlap goes to the other set, one of two overlaps to ignorance.
[[nodiscard]] FusedGridMass pcr5(const GridMass& a, const GridMass& b);

}  // namespace credo::evidence
