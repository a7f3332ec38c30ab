// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/consistency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace credo::evaluation {
namespace {

TEST(ChiSquare, BoundsOfTheAverageAreTheTabulatedOnes) {
  struct Case {
    int runs, dimension;
    double lower, upper;
  };
  for (const Case& c : {Case{1, 3, 0.216, 9.348},
                        {10, 3, 1.679, 4.698},
                        {20, 3, 2.024, 4.165},
                        {50, 3, 2.360, 3.716},
                        {100, 3, 2.539, 3.499},
                        {50, 2, 1.484, 2.591},
                        {100, 2, 1.627, 2.411}}) {
    const Bounds bounds = anees_bounds(c.runs, c.dimension);
    EXPECT_NEAR(bounds.lower, c.lower, 6e-4) << c.runs;
    EXPECT_NEAR(bounds.upper, c.upper, 6e-4) << c.runs;
  }
}

TEST(ChiSquare, DistributionOfTwoDegreesIsAnExponential) {
  for (const double x : {0.0, 0.1, 1.0, 3.0, 10.0, 60.0})
    EXPECT_NEAR(chi_square_cdf(x, 2), 1.0 - std::exp(-x / 2), 1e-14);
}

TEST(ChiSquare, QuantileInvertsTheDistribution) {
  for (const double degrees : {1.0, 3.0, 30.0, 3000.0}) {
    for (const double p : {0.001, 0.025, 0.5, 0.975, 0.999}) {
      EXPECT_NEAR(chi_square_cdf(chi_square_quantile(p, degrees), degrees), p, 1e-10);
    }
  }
}

geometry::PoseEstimate estimate(double x, double y, double theta, double sx, double sy, double st) {
  geometry::PoseEstimate result{.pose = {x, y, theta}};
  result.covariance.diagonal() << sx * sx, sy * sy, st * st;
  return result;
}

TEST(Nees, CountsSquaredSigmas) {
  const auto e = estimate(1.0, 2.0, 0.5, 0.1, 0.2, 0.05);
  const geometry::Pose2 truth{1.1, 1.6, 0.6};
  EXPECT_NEAR(nees(e, truth), 1.0 + 4.0 + 4.0, 1e-12);
  EXPECT_NEAR(position_nees(e, truth), 5.0, 1e-12);
  EXPECT_NEAR(heading_nees(e, truth), 4.0, 1e-12);
}

TEST(Nees, WrapsTheHeading) {
  const auto e = estimate(0, 0, std::numbers::pi - 0.01, 1, 1, 0.02);
  EXPECT_NEAR(nees(e, {0, 0, -std::numbers::pi + 0.01}), 1.0, 1e-9);
}

TEST(Nees, IsInfiniteWithoutACovariance) { EXPECT_EQ(nees({}, {}), std::numeric_limits<double>::infinity()); }

TEST(Nees, UsesTheCrossTerms) {
  auto e = estimate(0, 0, 0, 1, 1, 1);
  e.covariance(0, 1) = e.covariance(1, 0) = 0.9;
  EXPECT_NEAR(nees(e, {1, 1, 0}), 2.0 / 1.9, 1e-12);
  EXPECT_NEAR(nees(e, {1, -1, 0}), 2.0 / 0.1, 1e-9);
}

std::vector<std::vector<double>> drawn(double inflation, int runs, int indices) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> result(static_cast<std::size_t>(runs));
  for (auto& run : result) {
    for (int i = 0; i < indices; ++i) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) sum += std::pow(normal(random) * inflation, 2);
      run.push_back(sum);
    }
  }
  return result;
}

TEST(Consistency, IsMetByHonestErrorsAndMissedByOverconfidentAndPessimisticOnes) {
  const Consistency honest = consistency(drawn(1.0, 50, 400));
  EXPECT_NEAR(honest.share_inside, 0.95, 0.03);
  EXPECT_NEAR(honest.mean, 3.0, 0.1);
  EXPECT_TRUE(honest.met());
  EXPECT_FALSE(consistency(drawn(1.3, 50, 400)).met());
  EXPECT_FALSE(consistency(drawn(0.7, 50, 400)).met());
}

TEST(Consistency, StopsAtTheShortestRun) {
  const std::vector<std::vector<double>> runs{{1.0, 2.0, 3.0}, {3.0, 4.0}};
  EXPECT_EQ(consistency(runs).anees, (std::vector<double>{2.0, 3.0}));
  EXPECT_THROW((void)consistency({}), std::invalid_argument);
}

TEST(Consistency, ComparesAnIndexOnlyWhereEveryRunHasAnError) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> runs{{kNone, 2.0, 3.0}, {1.0, 4.0, 5.0}};
  const Consistency c = consistency(runs);
  EXPECT_EQ(c.indices, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(c.anees, (std::vector<double>{3.0, 4.0}));
  EXPECT_THROW((void)consistency(std::vector<std::vector<double>>{{kNone}, {1.0}}), std::invalid_argument);
}

TEST(Consistency, ExpectsTheDimension) {
  const std::vector<std::vector<double>> runs(50, std::vector<double>(10, 2.0));
  EXPECT_TRUE(consistency(runs, 2).met());
  EXPECT_NEAR(consistency(runs, 2).bounds.upper, 2.591, 6e-4);
  EXPECT_FALSE(consistency(runs, 1).met());
}

}  // namespace
}  // namespace credo::evaluation
