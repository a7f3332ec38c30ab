// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/principal_axes.hpp"

#include <cmath>

namespace credo::geometry {

namespace {

/// Mohr's: the variance in any direction lies on it.
struct Circle {
  explicit Circle(const Eigen::Matrix2d& covariance)
      : mean(0.5 * (covariance(0, 0) + covariance(1, 1))),
        half(0.5 * (covariance(0, 0) - covariance(1, 1))),
        mixed(covariance(1, 0)),
        radius(std::sqrt(half * half + mixed * mixed)) {}

  double mean, half, mixed, radius;
};

}  // namespace

PrincipalAxes principal_axes(const Eigen::Matrix2d& covariance) {
  const Circle circle(covariance);
  return {.largest = circle.mean + circle.radius,
          .smallest = circle.mean - circle.radius,
          .angle = 0.5 * std::atan2(circle.mixed, circle.half)};
}

double largest_variance(const Eigen::Matrix2d& covariance) {
  const Circle circle(covariance);
  return circle.mean + circle.radius;
}

}  // namespace credo::geometry
