// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

namespace credo::localization {

/// What is estimated: the pose and what all readings of an instrument have in common.
struct PoseState {
  enum Index { kX, kY, kTheta, kRangeX, kRangeY, kRangeTheta, kCameraTheta, kCameraCos, kCameraSin, kSize };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Jacobian = Eigen::Matrix<double, 2, kSize>;  ///< of a residual
  using Pair = Eigen::Matrix<double, kSize, 2>;      ///< covariance with two errors, or a gain
};

}  // namespace credo::localization
