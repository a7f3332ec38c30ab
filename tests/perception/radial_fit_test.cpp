// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/radial_fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/seeded.hpp"

namespace credo::perception {
namespace {

constexpr double kHorizon_px = 120.0;
constexpr int kRows = 80;
constexpr double kAnySlope = 100.0;  ///< 1-sigma of a slope of which nothing is known beforehand [rad px]

double lever(int row) { return 1.0 / (64.0 + 2.0 * row) - 1.0 / kHorizon_px; }

/// The points of a line on all rows, off by noise of `noise_sigmas` of their sigma, which is 1 mrad.
std::vector<RadialPoint> line(double azimuth, double slope, double noise_sigmas = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<RadialPoint> points;
  for (int row = 0; row < kRows; ++row) {
    const double at = azimuth + slope * lever(row) + 0.001 * noise_sigmas * normal(random);
    points.push_back({.azimuth = at, .sigma = 0.001, .lever = lever(row), .row = row, .step = 20.0});
  }
  return points;
}

RadialFit fit_radial_line(std::span<const RadialPoint> points, double start, double sigma_slope,
                          const RadialFitParams& params) {
  return perception::fit_radial_line(RadialPoints(points), start, sigma_slope, params);
}

TEST(RadialFit, WithoutPointsHasNoRows) {
  const RadialFit fit = fit_radial_line({}, 0.3, kAnySlope, {});
  EXPECT_EQ(fit.rows, 0);
  EXPECT_EQ(fit.azimuth, 0.3);
  EXPECT_EQ(fit.contrast, 0.0);
}

TEST(RadialFit, WithPointsThatAreAllTooFarHasNoRows) {
  EXPECT_EQ(fit_radial_line(line(0.5, 0.0), 0.0, kAnySlope, {}).rows, 0);
}

TEST(RadialFit, FindsAzimuthAndSlopeFromAStartBesideTheLine) {
  const RadialFit fit = fit_radial_line(line(0.002, 0.4), -0.008, kAnySlope, {});
  EXPECT_NEAR(fit.azimuth, 0.002, 1e-7);
  EXPECT_NEAR(fit.slope, 0.4, 1e-4);
  EXPECT_EQ(fit.rows, kRows);
  EXPECT_EQ(fit.first_row, 0);
  EXPECT_EQ(fit.last_row, kRows - 1);
  EXPECT_DOUBLE_EQ(fit.contrast, 20.0);
  EXPECT_DOUBLE_EQ(fit.scale, 1.0) << "never better than was said";
}

TEST(RadialFit, OutliersNeitherPullTheLineNorSupportIt) {
  std::vector<RadialPoint> points = line(0.0, 0.2, 0.5);
  for (int row = 0; row < kRows; row += 6) {
    points[static_cast<std::size_t>(row)].azimuth += 0.012;
    points[static_cast<std::size_t>(row)].step = 90.0;
  }
  const RadialFit fit = fit_radial_line(points, 0.0, kAnySlope, {});
  EXPECT_NEAR(fit.azimuth, 0.0, 3.0 * fit.sigma);
  EXPECT_NEAR(fit.slope, 0.2, 3.0 * fit.sigma_slope);
  EXPECT_LT(fit.sigma, 0.0005);
  EXPECT_EQ(fit.rows, kRows - 14);
  EXPECT_EQ(fit.first_row, 1);
  EXPECT_DOUBLE_EQ(fit.contrast, 20.0);
}

TEST(RadialFit, ASlopeThatIsKnownBeforehandIsKept) {
  const std::vector<RadialPoint> points = line(0.0, 0.5);
  EXPECT_NEAR(fit_radial_line(points, 0.0, 1e-3, {}).slope, 0.0, 1e-3);
  EXPECT_NEAR(fit_radial_line(points, 0.0, 1.0, {}).slope, 0.5, 1e-2);
  const RadialFit one = fit_radial_line(std::span(points).first(1), 0.0, 0.1, {});
  EXPECT_EQ(one.rows, 1);
  EXPECT_LT(one.sigma_slope, 0.2) << "one point says nothing of it: the expectation stays";
}

TEST(RadialFit, ARowThatIsSeenTwiceCountsOnce) {
  std::vector<RadialPoint> points;
  for (const RadialPoint& point : line(0.0, 0.0)) points.insert(points.end(), 2, point);
  EXPECT_EQ(fit_radial_line(points, 0.0, kAnySlope, {}).rows, kRows);
}

TEST(RadialFit, ScaleSaysByHowMuchThePointsAreWorseThanTheySaid) {
  const RadialFit fit = fit_radial_line(line(0.0, 0.0, 3.0), 0.0, kAnySlope, {});
  EXPECT_NEAR(fit.scale, 3.0, 0.5);
  EXPECT_GT(fit.sigma, 2.0 * fit_radial_line(line(0.0, 0.0), 0.0, kAnySlope, {}).sigma);
}

TEST(RadialFit, SigmaCoversTheErrors) {
  double square = 0.0, square_slope = 0.0;
  constexpr unsigned kDraws = 200;
  for (unsigned seed = 0; seed < kDraws; ++seed) {
    const RadialFit fit = fit_radial_line(line(0.001, 0.3, 1.0, seed), 0.0, kAnySlope, {});
    square += std::pow((fit.azimuth - 0.001) / fit.sigma, 2) / kDraws;
    square_slope += std::pow((fit.slope - 0.3) / fit.sigma_slope, 2) / kDraws;
  }
  const double expected = 1.0 / RadialFitParams{}.error_inflation;
  EXPECT_NEAR(std::sqrt(square), expected, 0.15);
  EXPECT_NEAR(std::sqrt(square_slope), expected, 0.15);
}

RC_GTEST_PROP(RadialFit, TurnsWithItsPointsAndIsMirroredWithThem, (unsigned seed)) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double turn = 0.5 * uniform(random);
  std::vector<RadialPoint> points = line(0.002 * uniform(random), 0.5 * uniform(random), 1.0, seed);
  for (std::size_t i = 0; i < points.size(); i += 5) points[i].azimuth += 0.02 * uniform(random);
  std::vector<RadialPoint> turned = points, mirrored = points;
  for (RadialPoint& point : turned) point.azimuth += turn;
  for (RadialPoint& point : mirrored) point.azimuth = -point.azimuth;
  const RadialFit a = fit_radial_line(points, 0.001, kAnySlope, {});
  const RadialFit b = fit_radial_line(turned, 0.001 + turn, kAnySlope, {});
  const RadialFit c = fit_radial_line(mirrored, -0.001, kAnySlope, {});
  RC_ASSERT(std::abs(b.azimuth - turn - a.azimuth) < 1e-9 && std::abs(c.azimuth + a.azimuth) < 1e-9);
  RC_ASSERT(std::abs(b.slope - a.slope) < 1e-6 && std::abs(c.slope + a.slope) < 1e-6);
  RC_ASSERT(std::abs(b.sigma - a.sigma) < 1e-9 && std::abs(c.sigma - a.sigma) < 1e-9);
  RC_ASSERT(a.rows > kRows / 2 && b.rows == a.rows && c.rows == a.rows);
}

}  // namespace
}  // namespace credo::perception
