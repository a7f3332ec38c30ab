// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// What each of YES, NO and the frame gets of the conflict.
struct ConflictShares {
  double yes = 0.0;
  double no = 0.0;
  double unknown = 0.0;
};

/// Whether the frame is taken to be involved in a conflict where a source names it.
enum class FrameShare { kShares, kTakesNoPart };

/// What PCR6 (kShares) and PCR6+ (kTakesNoPart) give to each, for any number of sources and without their 3^s products.
///
/// A conflicting product P gives P m_i / S to what source i names, S the sum of its masses m_i. With
/// 1/S = ∫ e^(-tS) dt over t > 0 each source has a factor of its own, and one pass over the sources sums up all
/// products: of those that name YES, NO, both. In y = ln t the integrand is smooth and the trapezoidal rule of step h
/// is off by 2 |Γ(1 + 2πi/h)|, whatever S is: 1e-15 for h = 3/8 ln 2. This step makes the ninth node eight times the
/// first, so that e^(-8tm) is three squarings of e^(-tm) and no exponential function is evaluated. All below the first
/// node is one node more, of the same sum and mean.
///
/// All terms are positive; nothing cancels. Absolute error below 1e-12, relative to what was found in all.
/// \returns shares that are relative to each other: scale them to the conflict
[[nodiscard]] ConflictShares pcr6_shares(std::span<const BinaryMass> sources, FrameShare frame);

}  // namespace credo::evidence
