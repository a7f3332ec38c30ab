// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
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

/// What a transform there and back may leave of a mass that is 0.
inline constexpr double kTransformRounding = 1e-14;

/// Elements of a power set up to which functions are kept dense: 2^20 numbers, 8 MB.
inline constexpr std::size_t kMaxDenseElements = 20;

/// The masses of all 2^n subsets.
/// \throws std::invalid_argument unless the frame is a power set of up to kMaxDenseElements elements
[[nodiscard]] std::vector<double> to_dense(const MassFunction& mass);
/// Masses below `negligible`, as transforms leave by rounding, are set to 0, then the sum to 1.
/// \param values  size 2^n. \throws std::invalid_argument for another size or frame, a mass below -negligible, nan, or
///        a sum that differs from 1 by more than kMassTolerance
[[nodiscard]] MassFunction from_dense(const Frame& frame, std::span<const double> values,
                                      double negligible = kTransformRounding);

}  // namespace credo::evidence
