// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::evidence {

[[noreturn]] void refuse_reliability(double reliability);

/// The reliability of a source: the probability that it is to be believed.
/// \throws std::invalid_argument unless it is in [0, 1]
constexpr void check_reliability(double reliability) {
  if (!(reliability >= 0.0 && reliability <= 1.0)) refuse_reliability(reliability);
}

}  // namespace credo::evidence
