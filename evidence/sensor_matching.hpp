// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/binary_mass.hpp"
#include "evidence/grid_mass.hpp"

namespace credo::evidence {

/// One reading said to a belief function and to a Bayes filter alike, so that what then differs is the rule and not the
/// sensor (docs/decisions/004-matched-comparisons.md). Which probability stands for a mass is a choice; with y, n and u
/// the masses of YES, NO and the frame:
///
/// Dempster's rule multiplies the odds Pl(YES) / Pl(NO) = (y + u) / (n + u), as Bayes' rule multiplies those of
/// probabilities. Matched by plausibility, the two agree on PlP after any number of readings (Cobb and Shenoy 2006).
/// Matched by pignistic probability they agree on each reading alone, and no longer after several: one reading repeated
/// leaves the Bayes filter the surer of the two.
enum class Matching {
  kPignistic,    ///< BetP(YES) = y + u / 2
  kPlausibility  ///< PlP(YES) = (y + u) / (1 + u): the plausibilities divided by their sum
};

/// The probability of YES that stands for the mass, in [0, 1]; 1/2 for the vacuous mass. Precondition of all that take
/// a mass: it is one.
[[nodiscard]] double matched_probability(const BinaryMass& mass, Matching matching);
/// ln(p / (1 - p)) of that probability, from the masses, so that certainties of 1 - 1e-300 keep their digits: what a
/// Bayes filter adds for the reading. ±infinity if all mass is on one side; discount such a reading first.
[[nodiscard]] double matched_log_odds(const BinaryMass& mass, Matching matching);

/// Of occupied. The conflict is divided out first: it speaks for neither side, and the ratio of the two commonalities
/// that a LogCommonality adds up does not contain it. Both: \throws std::domain_error at total conflict
[[nodiscard]] double matched_probability(const GridMass& mass, Matching matching);
[[nodiscard]] double matched_log_odds(const GridMass& mass, Matching matching);

/// The largest mass of the frame that a mass with this probability can have: 2 min(p, 1 - p) by pignistic matching,
/// min(p, 1 - p) / max(p, 1 - p) by plausibility. 1 at p = 1/2, 0 at certainty.
/// \throws std::invalid_argument unless the probability is in [0, 1]
[[nodiscard]] double largest_unknown_with(double probability, Matching matching);

/// The mass with this probability of YES and this mass of the frame: inverse of matched_probability.
/// \throws std::invalid_argument unless the probability is in [0, 1] and `unknown` in [0, largest_unknown_with]
///         (tolerance 1e-9), saying how large it may be
[[nodiscard]] BinaryMass mass_with(double probability, double unknown, Matching matching);
/// The least committed one: mass on one side and on the frame only.
/// \throws std::invalid_argument unless the probability is in [0, 1]
[[nodiscard]] BinaryMass most_unknown_with(double probability, Matching matching);

/// The same for a cell, with a given mass of the conflict: what is left, 1 - conflict, is shared as a BinaryMass would
/// be, `unknown` being the mass in the result.
/// Both: \throws std::invalid_argument also unless the conflict is in [0, 1)
[[nodiscard]] GridMass grid_mass_with(double probability, double unknown, double conflict, Matching matching);
[[nodiscard]] GridMass most_unknown_grid_mass_with(double probability, double conflict, Matching matching);

}  // namespace credo::evidence
