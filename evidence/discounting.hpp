// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <initializer_list>
#include <span>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Classical discounting (Shafer 1976; Li X. 2006, eq. (4)): every mass times the reliability of its source, the rest
/// to Θ. The literature's α is 1 - reliability.
/// \param reliability  probability that the source is to be believed, in [0, 1]
/// \throws std::invalid_argument for another
[[nodiscard]] MassFunction discount(const MassFunction& mass, double reliability);

/// Contextual discounting (Mercier, Quost and Denoeux 2008): how reliable the source is depends on the truth. m is
/// combined disjunctively with m_k(∅) = r_k, m_k(θ_k) = 1 - r_k of every element. Power sets only.
/// The number of focal elements may double with every element whose reliability is below 1.
/// \param reliabilities  where the truth is element k; size n, each in [0, 1]
/// \throws std::invalid_argument for others, and where more than 2^20 focal elements would be left
[[nodiscard]] MassFunction contextual_discount(const MassFunction& mass, std::span<const double> reliabilities);
[[nodiscard]] inline MassFunction contextual_discount(const MassFunction& mass,
                                                      std::initializer_list<double> reliabilities) {
  return contextual_discount(mass, std::span(reliabilities.begin(), reliabilities.size()));
}

/// Reliability of what was said a time ago: 2^(-age / half_life). Decaying in two steps is decaying in one.
/// \param age        >= 0, in the unit of half_life; infinity gives 0
/// \param half_life  > 0; infinity gives 1, whatever the age
/// \throws std::invalid_argument for others
[[nodiscard]] double reliability_after(double age, double half_life);

/// Temporal decay: discount(mass, reliability_after(age, half_life)).
[[nodiscard]] MassFunction decay(const MassFunction& mass, double age, double half_life);

}  // namespace credo::evidence
