// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace credo::evidence {

/// The rules on arrays of cells: a map, of which each cell holds a mass on {YES, NO}, takes in a reading, a mass for
/// each of its cells. One array for each mass, so that plain loops without branches and without allocation work on as
/// many cells at once as the processor has lanes. Real is float or double; the results are those of binary_rules.hpp
/// and binary_mass.hpp for two sources, to the bit in double.
///
/// For all: masses are those of normal mass functions, yes + no + unknown = 1 (not checked), and no two arrays overlap.
/// The conjunctive, the disjunctive, Dempster's and the cautious rule are associative; with the others a map is a
/// recursive filter, for which the order of its readings counts.
/// \throws std::invalid_argument unless all arrays are of one size; then nothing has been written

/// Views of three arrays of one size; of const Real where they are only read.
template <typename Real>
requires std::floating_point<std::remove_const_t<Real>>
struct BinaryCells {
  std::span<Real> yes, no, unknown;

  [[nodiscard]] std::size_t size() const { return yes.size(); }
  operator BinaryCells<const Real>() const requires(!std::is_const_v<Real>) { return {yes, no, unknown}; }
};

/// A reading for a map in Real.
template <std::floating_point Real>
using BinaryReading = BinaryCells<const std::type_identity_t<Real>>;

/// Conjunctive rule (TBM). \param conflict  the mass on the empty set, which belongs to the map as its other masses do:
///        0 for a map without conflict; what arises is added
template <std::floating_point Real>
void conjunctive(BinaryCells<Real> map, BinaryReading<Real> reading, std::span<std::type_identity_t<Real>> conflict);

/// Dempster's rule. At total conflict (or if what is left underflows) a cell keeps its old mass.
/// \returns how many cells did
template <std::floating_point Real>
std::size_t dempster(BinaryCells<Real> map, BinaryReading<Real> reading);

/// Conflict to ignorance (Yager), each reading by itself. Total conflict makes a cell vacuous.
template <std::floating_point Real>
void conflict_to_ignorance(BinaryCells<Real> map, BinaryReading<Real> reading);

/// Disjunctive rule.
template <std::floating_point Real>
void disjunctive(BinaryCells<Real> map, BinaryReading<Real> reading);

/// PCR2.
template <std::floating_point Real>
void pcr2(BinaryCells<Real> map, BinaryReading<Real> reading);

/// PCR5; of two sources PCR6, PCR5+ and PCR6+ are the same.
template <std::floating_point Real>
void pcr5(BinaryCells<Real> map, BinaryReading<Real> reading);

/// Cautious rule. \param conflict  as for conjunctive; what belongs to the result is written. A cell that is dogmatic
///        (unknown = 0), or whose reading is, keeps its old mass: neither has weights
/// \returns how many cells did
template <std::floating_point Real>
std::size_t cautious(BinaryCells<Real> map, BinaryReading<Real> reading,
                     std::span<std::type_identity_t<Real>> conflict);

/// Mean of both.
template <std::floating_point Real>
void average(BinaryCells<Real> map, BinaryReading<Real> reading);

/// Discounting of all cells: temporal decay of a map, or a source that is not quite to be believed.
/// \throws std::invalid_argument unless reliability is in [0, 1]
template <std::floating_point Real>
void discount(BinaryCells<Real> cells, std::type_identity_t<Real> reliability);

}  // namespace credo::evidence
