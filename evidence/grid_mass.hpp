// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <iosfwd>
#include <optional>
#include <span>

namespace credo::evidence {

/// Masses on the free frame of a grid cell, {empty, occupied}, whose two elements may overlap: `conflict` is the mass
/// of empty-and-occupied (the paradox), `unknown` that of empty-or-occupied. They sum to 1. Under Shafer's model the
/// overlap is the empty set and `conflict` is its mass: on two elements the DSm classic rule and the TBM conjunctive
/// rule are the same table.
struct GridMass {
  double empty = 0.0;
  double occupied = 0.0;
  double conflict = 0.0;
  double unknown = 1.0;

  [[nodiscard]] static constexpr GridMass vacuous() { return {}; }
  /// From the committed masses; the rest is ignorance.
  /// \throws std::invalid_argument unless all are >= 0 and sum to at most 1 (tolerance 1e-9: a sum that exceeds 1 by
  ///         less is divided out).
  [[nodiscard]] static GridMass from(double empty, double occupied, double conflict = 0.0);

  friend constexpr bool operator==(const GridMass&, const GridMass&) = default;
};

/// Which of the Venn regions of {empty, occupied} exist.
enum class GridModel {
  kFree,      ///< the overlap exists (free DSm model)
  kExclusive  ///< it does not: Shafer's model, and the hybrid model with the constraint empty-and-occupied = nothing
};

/// The non-empty elements of the frame. kConflict is one under the free model only.
enum class GridElement { kEmpty, kOccupied, kConflict, kUnknown };

/// DSm classic rule, closed form: associative, commutative, the vacuous mass is neutral (Li X. 2006, eq. (3); Li X.
/// 2007, eq. (4)). The conflict absorbs: it never shrinks, so decide by normalised masses, not by Bel.
[[nodiscard]] GridMass dsmc(const GridMass& a, const GridMass& b);
/// n-ary; no source gives the vacuous mass.
[[nodiscard]] GridMass dsmc(std::span<const GridMass> sources);

/// The mass with the conflict divided out: Dempster's read-out.
/// \returns nothing at total conflict.
[[nodiscard]] std::optional<GridMass> without_conflict(const GridMass& mass);

/// Classical discounting of all but the ignorance.
/// \param reliability  in [0, 1]; 1 keeps the mass, 0 makes it vacuous.
[[nodiscard]] constexpr GridMass discount(const GridMass& mass, double reliability) {
  return {.empty = reliability * mass.empty,
          .occupied = reliability * mass.occupied,
          .conflict = reliability * mass.conflict,
          .unknown = (1.0 - reliability) + reliability * mass.unknown};
}

/// Bel: the mass of all that implies the element. Under the free model the conflict implies both, empty and occupied.
[[nodiscard]] double belief(const GridMass& mass, GridElement element, GridModel model);
/// Pl: the mass of all that meets the element; always 1 under the free model.
[[nodiscard]] double plausibility(const GridMass& mass, GridElement element, GridModel model);
/// q: the mass of all that the element implies.
[[nodiscard]] double commonality(const GridMass& mass, GridElement element, GridModel model);
/// Generalised pignistic probability: masses are shared by the number of Venn regions (DSm cardinality).
/// \throws std::domain_error at total conflict under the exclusive model.
[[nodiscard]] double pignistic(const GridMass& mass, GridElement element, GridModel model);
/// DSmP: masses are shared in proportion to what the single regions were given, plus epsilon each; 0/0 takes its limit,
/// the pignistic share. Under the exclusive model the conflict is divided out first.
/// \param epsilon  >= 0, finite. \throws std::invalid_argument for another
/// \throws std::domain_error at total conflict under the exclusive model.
[[nodiscard]] double dsmp(const GridMass& mass, GridElement element, GridModel model, double epsilon);

std::ostream& operator<<(std::ostream& out, const GridMass& mass);

}  // namespace credo::evidence
