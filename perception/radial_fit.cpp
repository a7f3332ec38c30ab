// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/radial_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/tukey_weight.hpp"

namespace credo::perception {
namespace {

struct Normal {  // equations of the two unknowns azimuth and slope
  double aa = 0.0, ap = 0.0, pp = 0.0, ya = 0.0, yp = 0.0;
  double weighted_square = 0.0, weight = 0.0;
};

double residual(const RadialPoint& point, const RadialFit& fit) {
  return (point.azimuth - fit.azimuth - fit.slope * point.lever) / point.sigma;
}

Normal accumulate(std::span<const RadialPoint> points, const RadialFit& fit, double limit) {
  Normal sum;
  for (const RadialPoint& point : points) {
    const double z = residual(point, fit);
    const double share = tukey_weight(z, limit);
    const double weight = share / (point.sigma * point.sigma);
    sum.aa += weight;
    sum.ap += weight * point.lever;
    sum.pp += weight * point.lever * point.lever;
    sum.ya += weight * point.azimuth;
    sum.yp += weight * point.azimuth * point.lever;
    sum.weighted_square += share * z * z;
    sum.weight += share;
  }
  return sum;
}

/// Of the residuals, in expected standard deviations, by the median of some of them: up to half of the points may be
/// outliers. >= 1.
double spread(std::span<const RadialPoint> points, const RadialFit& fit) {
  constexpr std::size_t kMost = 32;
  std::array<double, kMost> magnitudes{};
  const std::size_t step = 1 + (points.size() - 1) / kMost;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += step) magnitudes[count++] = std::abs(residual(points[i], fit));
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(1.0, 1.4826 * *middle);
}

void count_support(std::span<const RadialPoint> points, const RadialFitParams& params, RadialFit& fit) {
  int last = -1;
  int count = 0;
  for (const RadialPoint& point : points) {
    if (!supports(point, fit, params)) continue;
    fit.contrast += point.step;
    ++count;
    if (point.row == last) continue;
    if (last < 0) fit.first_row = point.row;
    last = fit.last_row = point.row;
    ++fit.rows;
  }
  if (count > 0) fit.contrast /= count;
}

}  // namespace

bool supports(const RadialPoint& point, const RadialFit& fit, const RadialFitParams& params) {
  return std::abs(residual(point, fit)) <= params.support_sigmas * fit.scale;
}

RadialFit fit_radial_line(std::span<const RadialPoint> points, double start, double sigma_slope,
                          const RadialFitParams& params) {
  RadialFit fit{.azimuth = start};
  const double prior = 1.0 / (sigma_slope * sigma_slope);
  double limit = 4.0 * params.tukey;  // wide first, so that a start beside the line is drawn in
  for (int i = 0; i < params.iterations; ++i) {
    const Normal sum = accumulate(points, fit, limit);
    const double pp = sum.pp + prior;
    const double determinant = sum.aa * pp - sum.ap * sum.ap;
    if (!(sum.aa > 0.0) || !(determinant > 0.0)) return fit;
    const double before = fit.azimuth;
    fit.azimuth = (pp * sum.ya - sum.ap * sum.yp) / determinant;
    fit.slope = (sum.aa * sum.yp - sum.ap * sum.ya) / determinant;
    fit.scale = std::max(1.0, std::sqrt(sum.weighted_square / std::max(1.0, sum.weight - 2.0)));
    fit.sigma = params.error_inflation * fit.scale * std::sqrt(pp / determinant);
    fit.sigma_slope = params.error_inflation * fit.scale * std::sqrt(sum.aa / determinant);
    const double settled = params.tukey * std::min(spread(points, fit), 3.0);
    if (limit <= settled && std::abs(fit.azimuth - before) < params.settled_sigmas * fit.sigma) break;
    limit = std::max(settled, 0.5 * limit);
  }
  count_support(points, params, fit);
  return fit;
}

}  // namespace credo::perception
