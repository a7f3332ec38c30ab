// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/radial_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace credo::perception {
namespace {

using Block = RadialPoints::Block;
using Lanes = RadialPoints::Lanes;

struct Normal {  // equations of the two unknowns azimuth and slope
  double aa = 0.0, ap = 0.0, pp = 0.0, ya = 0.0, yp = 0.0;
  double weighted_square = 0.0, weight = 0.0;
};

Lanes residuals(const Block& block, const RadialFit& fit) {
  return (block.azimuth - fit.azimuth - fit.slope * block.lever) * block.inverse_sigma;
}

double residual(std::span<const Block> blocks, std::size_t point, const RadialFit& fit) {
  const Block& block = blocks[point / RadialPoints::kLanes];
  const auto lane = static_cast<Eigen::Index>(point % RadialPoints::kLanes);
  return (block.azimuth[lane] - fit.azimuth - fit.slope * block.lever[lane]) * block.inverse_sigma[lane];
}

/// With Tukey's biweight: 1 for a residual of 0, falling to 0 at `limit` and beyond.
Normal accumulate(std::span<const Block> blocks, const RadialFit& fit, double limit) {
  Lanes aa = Lanes::Zero(), ap = aa, pp = aa, ya = aa, yp = aa, weighted_square = aa, shares = aa;
  const double inverse_limit = 1.0 / limit;
  for (const Block& block : blocks) {
    const Lanes z = residuals(block, fit);
    const Lanes share = (1.0 - (z * inverse_limit).square()).max(0.0).square();
    const Lanes weight = share * block.inverse_sigma.square();
    const Lanes by_lever = weight * block.lever;
    aa += weight;
    ap += by_lever;
    pp += by_lever * block.lever;
    ya += weight * block.azimuth;
    yp += by_lever * block.azimuth;
    weighted_square += share * z.square();
    shares += share;
  }
  return {aa.sum(), ap.sum(), pp.sum(), ya.sum(), yp.sum(), weighted_square.sum(), shares.sum()};
}

/// Of the residuals, in expected standard deviations, by the median of some of them: up to half of the points may be
/// outliers. >= 1.
double spread(const RadialPoints& points, const RadialFit& fit) {
  constexpr double kOfMedian = 1.4826;  // of a normal distribution
  constexpr std::size_t kMost = 32;
  std::array<double, kMost> magnitudes{};
  const std::size_t step = 1 + (points.size() - 1) / kMost;
  std::size_t count = 0, expected = 0, of = points.blocks().size();
  Lanes of_block;
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (const std::size_t block = i / RadialPoints::kLanes; block != of) {
      of = block;
      of_block = kOfMedian * residuals(points.blocks()[of], fit).abs();
    }
    const double magnitude = of_block[static_cast<Eigen::Index>(i % RadialPoints::kLanes)];
    expected += magnitude <= 1.0 ? 1 : 0;
    magnitudes[count++] = magnitude;
  }
  if (expected > count / 2) return 1.0;  // whatever the median is
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(1.0, *middle);
}

void count_support(const RadialPoints& points, const RadialFitParams& params, RadialFit& fit) {
  int last = -1;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(residual(points.blocks(), i, fit)) > params.support_sigmas * fit.scale) continue;
    fit.contrast += points.steps()[i];
    ++count;
    const int row = points.rows()[i];
    if (row == last) continue;
    if (last < 0) fit.first_row = row;
    last = fit.last_row = row;
    ++fit.rows;
  }
  if (count > 0) fit.contrast /= count;
}

}  // namespace

RadialPoints::RadialPoints(std::span<const RadialPoint> points) {
  for (const RadialPoint& point : points) push_back(point);
}

void RadialPoints::reserve(std::size_t points) {
  blocks_.reserve(points / kLanes + 1);
  rows_.reserve(points);
  steps_.reserve(points);
}

void RadialPoints::clear() {
  blocks_.clear();
  rows_.clear();
  steps_.clear();
}

RadialPoint RadialPoints::operator[](std::size_t i) const {
  const Block& block = blocks_[i / kLanes];
  const auto lane = static_cast<Eigen::Index>(i % kLanes);
  return {block.azimuth[lane], 1.0 / block.inverse_sigma[lane], block.lever[lane], rows_[i], steps_[i]};
}

RadialFit fit_radial_line(const RadialPoints& points, double start, double sigma_slope, const RadialFitParams& params) {
  RadialFit fit{.azimuth = start};
  const double prior = 1.0 / (sigma_slope * sigma_slope);
  double limit = 4.0 * params.tukey;  // wide first, so that a start beside the line is drawn in
  for (int i = 0; i < params.iterations; ++i) {
    const Normal sum = accumulate(points.blocks(), fit, limit);
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
