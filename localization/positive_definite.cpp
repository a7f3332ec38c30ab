// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/positive_definite.hpp"

#include <cassert>

namespace credo::localization {

bool invert(const PoseState::Matrix& matrix, PoseState::Matrix& inverse) {
  constexpr int n = PoseState::kSize;
  const PoseState::Matrix U = root<n>(matrix);
  PoseState::Matrix V = PoseState::Matrix::Zero();  // U^-1, upper triangular
  for (int j = 0; j < n; ++j) {
    if (!(U(j, j) > 0.0)) return false;
    V(j, j) = 1.0 / U(j, j);
    for (int i = j - 1; i >= 0; --i) {
      double sum = 0.0;
      for (int k = i + 1; k <= j; ++k) sum += U(i, k) * V(k, j);
      V(i, j) = -V(i, i) * sum;
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) {
      double sum = 0.0;
      for (int k = j; k < n; ++k) sum += V(i, k) * V(j, k);
      inverse(i, j) = inverse(j, i) = sum;  // V V^T
    }
  }
  return true;
}

PoseState::Matrix inverse(const PoseState::Matrix& positive) {
  PoseState::Matrix inverted = PoseState::Matrix::Zero();
  [[maybe_unused]] const bool is_positive = invert(positive, inverted);
  assert(is_positive);
  return inverted;
}

}  // namespace credo::localization
