// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "evidence/mass_function.hpp"
#include "evidence/probability.hpp"

namespace credo::evidence {

/// Decisions by what they are worth. A mass function allows many probabilities; of a quantity whose value is known for
/// every element it gives the expectations under the worst and the best of them (Dempster 1967; Shafer 1981).
/// All: power sets only; m(∅) is divided out. \param values  of each element; size n, finite
/// \throws std::invalid_argument for others; std::domain_error at m(∅) = 1

[[nodiscard]] double lower_expectation(const MassFunction& mass, std::span<const double> values);  ///< Σ m(A) min
[[nodiscard]] double upper_expectation(const MassFunction& mass, std::span<const double> values);  ///< Σ m(A) max
[[nodiscard]] double pignistic_expectation(const MassFunction& mass, std::span<const double> values);

/// The act of the largest pessimism · lower + (1 - pessimism) · upper expectation (Hurwicz; Jaffray 1988): 1 is
/// maximin, 0 maximax. Never rejected; of equal ones the first.
/// \param utilities  acts × n, act by act: what an act is worth where the truth is that element
/// \param pessimism  in [0, 1]
/// \throws std::invalid_argument also for no act and for another number of utilities
[[nodiscard]] Decision best_act(const MassFunction& mass, std::span<const double> utilities, double pessimism);
/// The act of the largest pignistic expectation: Bayes' choice after the belief was formed (Smets and Kennes 1994).
[[nodiscard]] Decision best_act_pignistic(const MassFunction& mass, std::span<const double> utilities);
/// The acts that no other beats for certain (interval dominance): whose upper expectation reaches the largest lower
/// one. \returns their indices, ascending; at least one
[[nodiscard]] std::vector<std::size_t> undominated_acts(const MassFunction& mass, std::span<const double> utilities);

}  // namespace credo::evidence
