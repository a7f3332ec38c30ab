// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Generalized Bayesian theorem (Smets 1993): what an observation says about the elements, given how plausible it is
/// where each of them is the truth; no prior is needed. m(A) = Π over A of l_k · Π over the rest of (1 - l_k): the
/// conjunction of one mass function for each element, which gives 1 - l_k to its complement. Not normalised: m(∅) says
/// how little the observation fits any of them. Combined by Dempster's rule with a Bayesian prior it is Bayes' theorem.
/// Power sets of up to kMaxDenseElements elements.
/// \param plausibilities  of the observation where the truth is element k; size n, in [0, 1]
/// \throws std::invalid_argument for others
[[nodiscard]] MassFunction generalized_bayes(const Frame& frame, std::span<const double> plausibilities);

}  // namespace credo::evidence
