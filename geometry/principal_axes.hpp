// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

namespace credo::geometry {

/// The eigenvalues of a covariance of two unknowns, and the direction of the largest.
struct PrincipalAxes {
  double largest = 0.0;   ///< variance; not a number where the covariance is not
  double smallest = 0.0;  ///< variance
  double angle = 0.0;     ///< of the axis of `largest`, in (-pi/2, pi/2] [rad]
};

/// In closed form: Eigen's decomposition gives the same and takes seconds to compile.
/// \param covariance  symmetric
[[nodiscard]] PrincipalAxes principal_axes(const Eigen::Matrix2d& covariance);
/// PrincipalAxes::largest alone: without an arc tangent.
[[nodiscard]] double largest_variance(const Eigen::Matrix2d& covariance);

}  // namespace credo::geometry
