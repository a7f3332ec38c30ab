// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <cstdint>

#include "evidence/grid_mass.hpp"
#include "evidence/log_commonality.hpp"
#include "sensors/time.hpp"

namespace credo::mapping {

/// How a cell takes readings in, one after the other: a fold. Its result depends on their order, unlike that of
/// evidence::FixedLogCommonality, which stands for all rules that do not. A new `Cell` is vacuous. `time` is that of
/// the reading. A rule forgets if the latest readings outweigh what it holds however much that is; such a one takes
/// each reading in full, as it could not follow from a robot at rest otherwise (Freshness).
template <typename Rule>
concept CellRule = requires(const Rule& rule, typename Rule::Cell& cell, const typename Rule::Cell& known,
                            const evidence::GridMass& reading, sensors::Timestamp time) {
  /// False where the reading was abandoned: total conflict, the cell is as it was.
  { rule.update(cell, reading, time) } -> std::same_as<bool>;
  { rule.masses(known) } -> std::same_as<evidence::GridMass>;
  requires std::same_as<decltype(Rule::kForgets), const bool>;
};

/// DSm classic rule in linear masses (Li X. 2007, eq. (4)): the masses of both elements tend to 0 as the conflict
/// absorbs.
struct DsmcFold {
  using Cell = evidence::GridMass;
  static constexpr bool kForgets = false;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell; }
};

/// Dempster's rule (Li X. 2007, eq. (12)); a sensor's own conflict is conflict.
struct DempsterFold {
  using Cell = evidence::GridMass;
  static constexpr bool kForgets = false;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell; }
};

/// Dempster's rule as the sum that the map without an order is, in floats. Each reading leaves an ignorance of 1 % at
/// least, as there. What floats lose: sums depend on their order in the last of 24 bits, so equal readings give equal
/// maps only in equal order, and beside much evidence little is rounded away. What they gain: no end of the range.
struct DempsterFloatFold {
  using Cell = evidence::LogCommonalityF;
  static constexpr bool kForgets = false;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const;
};

/// PCR2 (Li P., eq. (6)).
struct Pcr2Fold {
  using Cell = evidence::GridMass;
  static constexpr bool kForgets = true;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell; }
};

/// PCR5, which is PCR6 here.
struct Pcr5Fold {
  using Cell = evidence::GridMass;
  static constexpr bool kForgets = true;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell; }
};

/// DSm hybrid rule: what contradicts goes to ignorance.
struct DsmhFold {
  using Cell = evidence::GridMass;
  static constexpr bool kForgets = true;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell; }
};

/// Bayes' filter of log-odds, from the same readings: each one's probability is its pignistic one (its conflict
/// divided out), as close to 0 and 1 as `certain_at`.
struct BayesFold {
  using Cell = double;  ///< ln (P(occupied) / P(empty)), from 0
  static constexpr bool kForgets = false;
  double certain_at = 1e-6;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  /// Bayesian masses.
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const;
};

/// How the small numbers of Zhu, eqs. (8), (9), depend on how often the cell was found empty and full before.
enum class Approximation {
  kFixed,     ///< not at all: exponent 1 (what Zhu compares himself with)
  kAdaptive,  ///< resolved: evidence against the history is weakened by all of e, evidence with it hardly
  kFaceValue  ///< the accumulators as their names say, which has the reverse effect
};

struct ApproximationParams {
  double e1 = 0.01, e2 = 0.01, e3 = 0.01;  ///< e of eqs. (8), (9), in [0, 1); not in the paper
  Approximation approximation = Approximation::kAdaptive;
};

/// Zhu, eqs. (8), (9): a reading of `empty` or of `occupied` alone, with the certainty taken out. Each small number is
/// at most a quarter of the mass that it is taken from: in print that mass can become negative.
/// \param found_empty, found_full  how often the cell was found so, this reading included
[[nodiscard]] evidence::GridMass approximated(const evidence::GridMass& reading, int found_empty, int found_full,
                                              const ApproximationParams& params);

/// The improved Dempster's rule of Zhu. Readings are taken as of his regions: empty before the arc, occupied on it.
struct ApproximatedDempsterFold {
  struct Cell {
    evidence::GridMass mass;
    std::int32_t found_empty = 0, found_full = 0;
  };
  static constexpr bool kForgets = false;
  ApproximationParams params;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time = 0) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell.mass; }
};

struct ZhuDecisionParams {
  double least_margin = 0.05;  ///< e4; not in the paper
  double most_ignorance =
      0.3;  ///< e5; not in the paper, which asks for a very small number: it decides next to nothing
};

enum class ZhuState { kUnknown, kEmpty, kOccupied };

/// Zhu, eq. (10): the larger of the two, if by more than e4, with an ignorance below e5 and below it.
[[nodiscard]] ZhuState decide_zhu(const evidence::GridMass& mass, const ZhuDecisionParams& params = {});

static_assert(CellRule<DsmcFold> && CellRule<DempsterFold> && CellRule<DempsterFloatFold> && CellRule<Pcr2Fold> &&
              CellRule<Pcr5Fold> && CellRule<DsmhFold> && CellRule<BayesFold> && CellRule<ApproximatedDempsterFold>);

}  // namespace credo::mapping
