// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Dense functions on a power set: entry `bits` belongs to the subset whose elements are the bits that are set. All
/// transforms work in place in n 2^n / 2 additions (fast Möbius transform; Kennes 1992). Precondition: the size is a
/// power of two.

void mass_to_commonality(std::span<double> values);    ///< q(A) = sum of m(B), B ⊇ A
void commonality_to_mass(std::span<double> values);    ///< its inverse
void mass_to_implicability(std::span<double> values);  ///< b(A) = sum of m(B), B ⊆ A, ∅ among them
void implicability_to_mass(std::span<double> values);  ///< its inverse

/// Elements of a power set up to which functions are kept dense: 2^20 numbers, 8 MB.
inline constexpr std::size_t kMaxDenseElements = 20;

/// The masses of all 2^n subsets.
/// \throws std::invalid_argument unless the frame is a power set of up to kMaxDenseElements elements
[[nodiscard]] std::vector<double> to_dense(const MassFunction& mass);
/// \param values  the masses of all 2^n subsets. \throws std::invalid_argument for another size or frame, and as the
///        constructor of MassFunction
[[nodiscard]] MassFunction from_dense(const Frame& frame, std::span<const double> values);

/// Masses are differences of commonalities, rounded in proportion to q(A), the largest of them: below this share of it
/// a mass counts as 0. What Θ and other large sets have stays, however little it is.
inline constexpr double kTransformRounding = 1e-12;

/// The mass function with these commonalities.
/// \param commonalities  of all 2^n subsets; q(∅) = 1
/// \returns nothing where they are those of no mass function: q(∅) is not 1 (tolerance kMassTolerance), or a mass would
///          be negative
/// \throws std::invalid_argument for another size or frame
[[nodiscard]] std::optional<MassFunction> from_commonality(const Frame& frame, std::vector<double> commonalities);

/// Whether combining the sources by transforms takes less than going through the pairs of their focal elements.
[[nodiscard]] bool dense_is_faster(const Sources& sources);

}  // namespace credo::evidence
