// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "evidence/grid_mass.hpp"

namespace credo::evidence {

/// All evidence about a cell as the logarithms of three commonalities, each <= 0. The conjunctive rule multiplies
/// commonalities, so taking evidence in is three additions, merging two cells too, and taking a contribution out again
/// three subtractions. {0, 0, 0} is the cell that nothing is known about. Masses never underflow: DSmC, TBM, Dempster's
/// and Bayes' rule are read-outs of the same cell (docs/equations.md).
template <typename Real>
struct BasicLogCommonality {
  Real empty = 0;     ///< ln(m(empty) + m(unknown))
  Real occupied = 0;  ///< ln(m(occupied) + m(unknown))
  Real unknown = 0;   ///< ln m(unknown); the lowest of the three

  constexpr BasicLogCommonality& operator+=(const BasicLogCommonality& other) {
    empty += other.empty;
    occupied += other.occupied;
    unknown += other.unknown;
    return *this;
  }
  constexpr BasicLogCommonality& operator-=(const BasicLogCommonality& other) {
    empty -= other.empty;
    occupied -= other.occupied;
    unknown -= other.unknown;
    return *this;
  }
  /// Conjunctive combination of independent evidence.
  friend constexpr BasicLogCommonality operator+(BasicLogCommonality a, const BasicLogCommonality& b) { return a += b; }
  /// Takes out `b`, which must have been merged into `a` before.
  friend constexpr BasicLogCommonality operator-(BasicLogCommonality a, const BasicLogCommonality& b) { return a -= b; }
  friend constexpr bool operator==(const BasicLogCommonality&, const BasicLogCommonality&) = default;

  template <typename Other>
  [[nodiscard]] constexpr BasicLogCommonality<Other> as() const {
    return {static_cast<Other>(empty), static_cast<Other>(occupied), static_cast<Other>(unknown)};
  }
};

using LogCommonality = BasicLogCommonality<double>;
using LogCommonalityF = BasicLogCommonality<float>;  ///< sums depend on their order in the last digits

/// The cell of a map: Q11.20 fixed point. Sums are bit-identical in any order, thread and robot.
/// One increment is off by at most 2^-21 in each logarithm. The range is [-2048, 0]; one update takes no more of it
/// than ln 0.01, its reliability being kMaxReliability at most (fixed_increment), so that there is room for 444 of the
/// strongest. Sums stop at the floor; they stay independent of the order, because contributions are never positive, but
/// what was beyond is lost: `saturated` tells.
struct FixedLogCommonality {
  static constexpr int kFractionBits = 20;
  static constexpr double kUnit = 1.0 / (1 << kFractionBits);
  static constexpr std::int32_t kFloor = std::numeric_limits<std::int32_t>::min();
  static constexpr double kMaxReliability = 0.99;  ///< of one update

  std::int32_t empty = 0;
  std::int32_t occupied = 0;
  std::int32_t unknown = 0;

  /// A channel has reached the floor: the read-outs are bounds, and nothing can be taken out any more.
  [[nodiscard]] constexpr bool saturated() const { return std::min({empty, occupied, unknown}) == kFloor; }

  [[nodiscard]] constexpr LogCommonality value() const { return {empty * kUnit, occupied * kUnit, unknown * kUnit}; }

  constexpr FixedLogCommonality& operator+=(const FixedLogCommonality& other) {
    empty = add(empty, other.empty);
    occupied = add(occupied, other.occupied);
    unknown = add(unknown, other.unknown);
    return *this;
  }
  constexpr FixedLogCommonality& operator-=(const FixedLogCommonality& other) {
    empty = subtract(empty, other.empty);
    occupied = subtract(occupied, other.occupied);
    unknown = subtract(unknown, other.unknown);
    return *this;
  }
  /// Conjunctive combination of independent evidence.
  friend constexpr FixedLogCommonality operator+(FixedLogCommonality a, const FixedLogCommonality& b) { return a += b; }
  /// Takes out `b`, which must have been merged into `a` before. A saturated channel stays as it is.
  friend constexpr FixedLogCommonality operator-(FixedLogCommonality a, const FixedLogCommonality& b) { return a -= b; }
  friend constexpr bool operator==(const FixedLogCommonality&, const FixedLogCommonality&) = default;

  /// One channel of `+=`, in a form that compilers vectorise in a loop over rows. Precondition: increment <= 0.
  static constexpr void accumulate(std::int32_t& channel, std::int32_t increment) {
    channel = std::max(channel, kFloor - increment) + increment;
  }

 private:
  // Stays in 32 bits, so that rows of cells are added four or eight at a time.
  static constexpr std::int32_t add(std::int32_t a, std::int32_t b) {
    const auto sum = static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    const bool overflow = ((a ^ sum) & (b ^ sum)) < 0;
    return overflow ? kFloor : sum;
  }
  static constexpr std::int32_t subtract(std::int32_t a, std::int32_t b) {
    return a == kFloor ? kFloor : static_cast<std::int32_t>(std::int64_t{a} - b);
  }
};
static_assert(sizeof(FixedLogCommonality) == 12 && std::is_trivially_copyable_v<FixedLogCommonality>);

/// The evidence of one reading, discounted: log q = ln(1 - r + r q), computed without cancellation. The vacuous mass
/// and reliability 0 give exactly {0, 0, 0}.
/// \param reliability  in [0, 1). It keeps every commonality above zero: with 1, a mass without ignorance would be a
///                     certainty that no later evidence could undo.
/// \throws std::invalid_argument unless 0 <= reliability < 1 and the mass is one.
[[nodiscard]] inline LogCommonality log_commonality(const GridMass& mass, double reliability) {
  if (!(reliability >= 0.0 && reliability < 1.0)) {
    throw std::invalid_argument("reliability must be in [0, 1): a source of reliability 1 could never be corrected");
  }
  const double sum = mass.empty + mass.occupied + mass.conflict + mass.unknown;
  if (!(mass.empty >= 0.0 && mass.occupied >= 0.0 && mass.conflict >= 0.0 && mass.unknown >= 0.0 &&
        std::abs(sum - 1.0) <= 1e-9)) {
    throw std::invalid_argument("not a mass: the four masses must be >= 0 and sum to 1");
  }
  // 0.0 - x, so that nothing is +0 and not -0. A sum that rounding has lifted over 1 stops at 1.
  const auto log_q = [reliability](double outside) { return std::log1p(0.0 - reliability * std::min(outside, 1.0)); };
  return {log_q(mass.occupied + mass.conflict), log_q(mass.empty + mass.conflict),
          log_q(mass.empty + mass.occupied + mass.conflict)};
}

/// To fixed point, rounded to nearest; what lies below the range is set to the floor, and saturated() then tells.
/// \throws std::invalid_argument if a logarithm is positive or nan.
[[nodiscard]] inline FixedLogCommonality quantise(const LogCommonality& cell) {
  const auto fixed = [](double log_q) {
    if (!(log_q <= 0.0)) throw std::invalid_argument("a log-commonality must be <= 0");
    const double scaled = log_q * (1 << FixedLogCommonality::kFractionBits);
    if (scaled <= FixedLogCommonality::kFloor) return FixedLogCommonality::kFloor;
    return static_cast<std::int32_t>(std::llround(scaled));
  };
  return {fixed(cell.empty), fixed(cell.occupied), fixed(cell.unknown)};
}

/// What one reading adds to a cell: its evidence in fixed point. What is said to be more reliable than kMaxReliability
/// counts as that, so that an update is never below ln 0.01.
/// \param reliability  in [0, 1]
/// \throws std::invalid_argument unless it is, and the mass is one
[[nodiscard]] inline FixedLogCommonality fixed_increment(const GridMass& mass, double reliability) {
  const bool exceeds = reliability > FixedLogCommonality::kMaxReliability && reliability <= 1.0;
  return quantise(log_commonality(mass, exceeds ? FixedLogCommonality::kMaxReliability : reliability));
}

/// The whole cell discounted (decay): ln(1 - r + r q). Does not commute with merging: what is merged must have been
/// discounted alike.
/// \param reliability  in [0, 1]; 1 keeps the cell, however much evidence it holds
[[nodiscard]] inline LogCommonality discount(const LogCommonality& cell, double reliability) {
  if (reliability == 1.0) return cell;
  // A small q by itself: beside 1 it would lose its digits, which count where 1 - r is as small.
  const auto decay = [reliability](double log_q) {
    return log_q > -0.5 ? std::log1p(reliability * std::expm1(log_q))
                        : std::log((1.0 - reliability) + reliability * std::exp(log_q));
  };
  return {decay(cell.empty), decay(cell.occupied), decay(cell.unknown)};
}

/// All that was said for one of the two and not for the other: ln(q(empty) / q(unknown)) >= 0, a sum over the readings.
/// A Bayes filter's log-odds of occupied are evidence_for_occupied - evidence_for_empty.
[[nodiscard]] constexpr double evidence_for_empty(const LogCommonality& cell) { return cell.empty - cell.unknown; }
[[nodiscard]] constexpr double evidence_for_occupied(const LogCommonality& cell) {
  return cell.occupied - cell.unknown;
}

/// How much of the evidence contradicts the rest: 2 min(v_e, v_o) / (v_e + v_o), v the evidence for each. 0: one-sided
/// or none; 1: balanced. Unlike the mass of the conflict it does not tend to 1 as readings accumulate.
[[nodiscard]] constexpr double contested(const LogCommonality& cell) {
  const double for_empty = std::max(0.0, evidence_for_empty(cell));
  const double for_occupied = std::max(0.0, evidence_for_occupied(cell));
  const double sum = for_empty + for_occupied;
  return sum > 0.0 ? 2.0 * std::min(for_empty, for_occupied) / sum : 0.0;
}

/// Mass of the conflict (DSmC: of the paradox; TBM: of the empty set), 1 - q_e - q_o + q_u, without cancellation:
/// (1 - q_e)(1 - q_o) + (q_u - q_e q_o). Rounding below 0, as quantisation causes, is set to 0.
[[nodiscard]] inline double conflict(const LogCommonality& cell) {
  const double both = cell.empty + cell.occupied;
  const double excess = cell.unknown - both;  // either sign; the factor in front is the larger of the two
  const double difference =
      excess > 0.0 ? -std::exp(cell.unknown) * std::expm1(-excess) : std::exp(both) * std::expm1(excess);
  return std::max(0.0, std::expm1(cell.empty) * std::expm1(cell.occupied) + difference);
}

/// The masses as DSmC and TBM leave them, conflict included; they sum to 1.
[[nodiscard]] inline GridMass masses(const LogCommonality& cell) {
  const GridMass raw{.empty = -std::exp(cell.empty) * std::expm1(std::min(0.0, cell.unknown - cell.empty)),
                     .occupied = -std::exp(cell.occupied) * std::expm1(std::min(0.0, cell.unknown - cell.occupied)),
                     .conflict = conflict(cell),
                     .unknown = std::exp(cell.unknown)};
  const double sum = raw.empty + raw.occupied + raw.conflict + raw.unknown;  // 1 but for rounding and quantisation
  return {raw.empty / sum, raw.occupied / sum, raw.conflict / sum, raw.unknown / sum};
}

/// The masses under Dempster's rule, conflict divided out. Exact however much evidence there is: exponents are taken
/// relative to the larger, so there is no total conflict in this form.
[[nodiscard]] inline GridMass normalised_masses(const LogCommonality& cell) {
  const double largest = std::max(cell.empty, cell.occupied);
  const double empty = -std::exp(cell.empty - largest) * std::expm1(std::min(0.0, cell.unknown - cell.empty));
  const double occupied = -std::exp(cell.occupied - largest) * std::expm1(std::min(0.0, cell.unknown - cell.occupied));
  const double unknown = std::exp(cell.unknown - largest);
  const double sum = empty + occupied + unknown;  // >= 1: the larger commonality
  return {empty / sum, occupied / sum, 0.0, unknown / sum};
}

/// Pignistic probability of occupied, of the normalised masses.
[[nodiscard]] inline double pignistic_occupied(const LogCommonality& cell) {
  const GridMass mass = normalised_masses(cell);
  return mass.occupied + 0.5 * mass.unknown;
}

/// Plausibility transform: Pl(occupied) / (Pl(empty) + Pl(occupied)), the logistic function of the log-odds.
[[nodiscard]] inline double plausibility_probability_occupied(const LogCommonality& cell) {
  return 1.0 / (1.0 + std::exp(cell.empty - cell.occupied));
}

}  // namespace credo::evidence
