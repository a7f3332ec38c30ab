// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Belief that the next of a series of independent trials succeeds, from the ones before: the predictive belief
/// function of Denoeux (2006) for two outcomes. Bel and Pl of YES are the bounds of the success probability by Clopper
/// and Pearson (1934), so [Bel, Pl] holds the true probability in at least the share `confidence` of all series,
/// however short; the ignorance is the width of the interval and shrinks with the number of trials. No trial gives the
/// vacuous mass. Symmetric: failures for successes swaps YES and NO. \param confidence  in (0, 1)
/// \throws std::invalid_argument for another confidence, or for more successes than trials
[[nodiscard]] BinaryMass predictive_belief(std::size_t successes, std::size_t trials, double confidence);

}  // namespace credo::evidence
