// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/principal_axes.hpp"

#include <cmath>

namespace credo::geometry {

PrincipalAxes principal_axes(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half = 0.5 * (covariance(0, 0) - covariance(1, 1)), mixed = covariance(1, 0);
  const double radius = std::hypot(half, mixed);  // of Mohr's circle
  return {.largest = mean + radius, .smallest = mean - radius, .angle = 0.5 * std::atan2(mixed, half)};
}

}  // namespace credo::geometry
