// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Summarization (Lowrance, Garvey and Strat 1986): a mass function with at most `most` focal elements, for rules whose
/// work grows with their number. The largest masses stay, the others go to the union of their sets. It never says more
/// than the original: Bel falls, Pl rises. What is on ∅ stays there, beside the `most`.
/// \param most  >= 1; of equal masses the first propositions stay
/// \throws std::invalid_argument for 0
[[nodiscard]] MassFunction summarized(const MassFunction& mass, std::size_t most);

}  // namespace credo::evidence
