// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace credo::evaluation {
namespace {

Eigen::Vector3d error_of(const geometry::Pose2& estimate, const geometry::Pose2& truth) {
  return {truth.x - estimate.x, truth.y - estimate.y, geometry::angle_difference(truth.theta, estimate.theta)};
}

template <int N>
double quadratic_form(const Eigen::Matrix<double, N, 1>& e, const Eigen::Matrix<double, N, N>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(covariance);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::Matrix<double, N, 1> whitened = factor.matrixL().solve(e);
  return whitened.squaredNorm();
}

/// Regularised lower incomplete gamma function P(a, x): the series below a + 1, the continued fraction above
/// (Abramowitz and Stegun 6.5.29, 6.5.31; the fraction by Lentz's method).
double lower_gamma(double a, double x) {
  constexpr double kPrecision = 1e-15;
  if (x <= 0.0) return 0.0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (double n = a + 1.0; term > sum * kPrecision; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return front * sum;
  }
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, h = d;
  for (int i = 1; i < 10'000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    h *= d * c;
    if (std::abs(d * c - 1.0) < kPrecision) break;
  }
  return 1.0 - front * h;
}

}  // namespace

double nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth) {
  return quadratic_form<3>(error_of(estimate.pose, truth), estimate.covariance);
}

double position_nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth) {
  const Eigen::Vector2d e = error_of(estimate.pose, truth).head<2>();
  const Eigen::Matrix2d covariance = estimate.covariance.topLeftCorner<2, 2>();
  return quadratic_form<2>(e, covariance);
}

double heading_nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth) {
  const double e = error_of(estimate.pose, truth).z();
  const double variance = estimate.covariance(2, 2);
  return variance > 0.0 ? e * e / variance : std::numeric_limits<double>::infinity();
}

double chi_square_cdf(double x, double degrees) { return lower_gamma(0.5 * degrees, 0.5 * x); }

double chi_square_quantile(double probability, double degrees) {
  double low = 0.0, high = degrees + 10.0;
  while (chi_square_cdf(high, degrees) < probability) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_cdf(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Bounds anees_bounds(int runs, int dimension, double probability) {
  const double tail = 0.5 * (1.0 - probability), degrees = static_cast<double>(runs) * dimension;
  return {.lower = chi_square_quantile(tail, degrees) / runs, .upper = chi_square_quantile(1.0 - tail, degrees) / runs};
}

Consistency consistency(std::span<const std::vector<double>> nees_by_run, int dimension) {
  Consistency result{.runs = static_cast<int>(nees_by_run.size()), .dimension = dimension};
  std::size_t shortest = nees_by_run.empty() ? 0 : std::numeric_limits<std::size_t>::max();
  for (const auto& run : nees_by_run) shortest = std::min(shortest, run.size());
  for (std::size_t i = 0; i < shortest; ++i) {
    double sum = 0.0;
    for (const auto& run : nees_by_run) sum += run[i];
    if (std::isnan(sum)) continue;
    result.indices.push_back(i);
    result.anees.push_back(sum / result.runs);
  }
  if (result.indices.empty())
    throw std::invalid_argument("no acquisition has a pose in the map and a ground truth in every run: no NEES");
  result.bounds = anees_bounds(result.runs, dimension);
  const auto count = static_cast<double>(result.indices.size());
  for (const double anees : result.anees) {
    result.mean += anees / count;
    result.share_inside += anees >= result.bounds.lower && anees <= result.bounds.upper ? 1.0 / count : 0.0;
  }
  return result;
}

}  // namespace credo::evaluation
