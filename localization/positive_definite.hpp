// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "localization/pose_state.hpp"

namespace credo::localization {

/// U, upper triangular, with U^T U = positive, so that |U e|^2 = e^T positive e. Cholesky's decomposition in plain
/// numbers: Eigen's takes seconds to compile for each size, and microseconds to run. A pivot that is rounded below 0 is
/// 0. Reads the upper triangle alone.
template <int kRows>
[[nodiscard]] Eigen::Matrix<double, kRows, kRows> root(const Eigen::Matrix<double, kRows, kRows>& positive) {
  Eigen::Matrix<double, kRows, kRows> U = Eigen::Matrix<double, kRows, kRows>::Zero();
  for (int i = 0; i < kRows; ++i) {
    for (int j = i; j < kRows; ++j) {
      double rest = positive(i, j);
      for (int k = 0; k < i; ++k) rest -= U(k, i) * U(k, j);
      U(i, j) = i == j ? std::sqrt(std::max(0.0, rest)) : rest / U(i, i);
    }
  }
  return U;
}

/// The inverse of a symmetric matrix, exactly symmetric.
/// \returns whether the matrix is positive definite; `inverse` is left alone where it is not
[[nodiscard]] bool invert(const PoseState::Matrix& matrix, PoseState::Matrix& inverse);
/// The same of a matrix that is known to be positive definite.
[[nodiscard]] PoseState::Matrix inverse(const PoseState::Matrix& positive);

}  // namespace credo::localization
