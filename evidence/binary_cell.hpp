// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <concepts>
#include <limits>

namespace credo::evidence::cell {

/// The rules of two sources on the frame {YES, NO} in any floating type and without branches: what binary_rules.hpp
/// gives for two sources and what binary_batch.hpp does to every cell of an array, in one place.

/// Masses and the mass of the empty set; they sum to 1. `conflict` is 0 in what is called normal.
template <std::floating_point Real>
struct Open {
  Real yes = 0;
  Real no = 0;
  Real unknown = 1;
  Real conflict = 0;
};

/// What YES gets of the product yes · no where the two share it in proportion: yes² no / (yes + no), 0 for 0/0.
template <std::floating_point Real>
[[nodiscard]] constexpr Real proportional_share(Real yes, Real no) {
  const Real sum = yes + no;
  return yes * no * (sum > 0 ? yes / sum : Real(0));
}

/// Conjunctive rule. \param b  normal; `a` may carry conflict, which stays
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> conjunctive(const Open<Real>& a, const Open<Real>& b) {
  return {.yes = a.yes * (b.yes + b.unknown) + a.unknown * b.yes,
          .no = a.no * (b.no + b.unknown) + a.unknown * b.no,
          .unknown = a.unknown * b.unknown,
          .conflict = a.conflict + (a.yes * b.no + a.no * b.yes)};
}

/// Disjunctive rule of normal masses.
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> disjunctive(const Open<Real>& a, const Open<Real>& b) {
  return {.yes = a.yes * b.yes,
          .no = a.no * b.no,
          .unknown = a.unknown + (a.yes * (b.no + b.unknown) + a.no * (b.yes + b.unknown)),
          .conflict = 0};
}

/// Conflict to ignorance (Yager) of normal masses.
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> conflict_to_ignorance(const Open<Real>& a, const Open<Real>& b) {
  const Open<Real> open = conjunctive(a, b);
  return {.yes = open.yes, .no = open.no, .unknown = open.unknown + open.conflict, .conflict = 0};
}

/// PCR2 of what the conjunctive rule left, with the sums of the masses that the sources gave to each.
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> pcr2(const Open<Real>& open, Real sum_yes, Real sum_no) {
  const Real sum = sum_yes + sum_no;
  const Real unit = sum > 0 ? open.conflict / sum : Real(0);
  return {.yes = open.yes + unit * sum_yes, .no = open.no + unit * sum_no, .unknown = open.unknown, .conflict = 0};
}

/// PCR5 = PCR6 = PCR5+ = PCR6+ of two normal masses.
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> pcr5(const Open<Real>& a, const Open<Real>& b) {
  const Open<Real> open = conjunctive(a, b);
  return {.yes = open.yes + (proportional_share(a.yes, b.no) + proportional_share(b.yes, a.no)),
          .no = open.no + (proportional_share(a.no, b.yes) + proportional_share(b.no, a.yes)),
          .unknown = open.unknown,
          .conflict = 0};
}

/// A mass in simple ones (canonical decomposition, Smets 1995), and complements that keep their digits. With q the
/// commonality, w(YES) = q(Θ) / q(YES), w(NO) = q(Θ) / q(NO), w(∅) = q(YES) q(NO) / q(Θ).
template <std::floating_point Real>
struct Weights {
  Real yes, no;          ///< w, in (0, 1]
  Real for_yes, for_no;  ///< 1 - w
  Real none;             ///< w(∅) > 0, and of the mass that it comes from:
  Real none_either;      ///< w(YES) + w(NO) - w(YES) w(NO)
  Real none_conflict;    ///< the mass on ∅, 1 - none · none_either
};

/// Whether a mass has weights: its ignorance is a normal number, and q(YES) q(NO) / q(Θ) does not overflow.
template <std::floating_point Real>
[[nodiscard]] constexpr bool has_weights(const Open<Real>& mass) {
  return mass.unknown >= std::numeric_limits<Real>::min();
}

/// Precondition: has_weights(mass).
template <std::floating_point Real>
[[nodiscard]] constexpr Weights<Real> weights(const Open<Real>& mass) {
  const Real q_yes = mass.yes + mass.unknown, q_no = mass.no + mass.unknown;
  const Real yes = mass.unknown / q_yes, no = mass.unknown / q_no;
  const Real for_yes = mass.yes / q_yes, for_no = mass.no / q_no;
  return {.yes = yes,
          .no = no,
          .for_yes = for_yes,
          .for_no = for_no,
          .none = q_yes * (q_no / mass.unknown),
          .none_either = yes + for_yes * no,
          .none_conflict = mass.conflict};
}

/// The smaller weight of each: the cautious rule (Denoeux 2008).
template <std::floating_point Real>
[[nodiscard]] constexpr Weights<Real> least(const Weights<Real>& a, const Weights<Real>& b) {
  const bool first = a.none <= b.none;
  return {.yes = std::min(a.yes, b.yes),
          .no = std::min(a.no, b.no),
          .for_yes = std::max(a.for_yes, b.for_yes),
          .for_no = std::max(a.for_no, b.for_no),
          .none = first ? a.none : b.none,
          .none_either = first ? a.none_either : b.none_either,
          .none_conflict = first ? a.none_conflict : b.none_conflict};
}

/// The mass that has these weights. Weights that are the least of several make one: nothing here gets negative.
template <std::floating_point Real>
[[nodiscard]] constexpr Open<Real> recompose(const Weights<Real>& w) {
  return {.yes = w.none * w.no * w.for_yes,
          .no = w.none * w.yes * w.for_no,
          .unknown = w.none * w.no * w.yes,
          .conflict = w.none_conflict + w.none * std::max(Real(0), w.none_either - (w.yes + w.for_yes * w.no))};
}

}  // namespace credo::evidence::cell
