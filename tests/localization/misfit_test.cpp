// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace credo::localization {
namespace {

/// Bearings whose residuals have these squares.
void add(Misfit& misfit, const std::vector<double>& squares) {
  Observation bearing;
  bearing.kind = ObservationKind::kBearing;
  PoseSolution solution;
  solution.mahalanobis_squared = squares;
  misfit.add(std::vector<Observation>(squares.size(), bearing), solution);
}

TEST(Misfit, IsUsualBeforeAnythingIsSeen) {
  Misfit misfit;
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, 1.0);
  add(misfit, {});
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, 1.0);
  EXPECT_FALSE(misfit.contradicting());
}

TEST(Misfit, TellsByHowMuchErrorsAreLargerThanTheirModels) {
  const MisfitParams params{.usual = 1.0};
  for (const double scale : {0.9, 1.0, 1.5}) {
    Misfit misfit(params);
    std::mt19937_64 random(7);
    std::normal_distribution<double> error(0.0, scale);
    for (int i = 0; i < 50; ++i) {
      std::vector<double> squares(200);
      for (double& square : squares) square = std::pow(error(random), 2);
      add(misfit, squares);
    }
    EXPECT_NEAR(misfit.variance_factors().all, scale * scale, 0.1 * scale * scale) << scale;
  }
}

TEST(Misfit, CountsDimensions) {
  Misfit misfit({.usual = 1.0, .memory = 0.0});
  Observation point;
  point.kind = ObservationKind::kPoint;
  PoseSolution solution;
  solution.mahalanobis_squared = {2.0, 6.0};
  misfit.add(std::vector<Observation>(2, point), solution);
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, 2.0);
}

TEST(Misfit, OfWallsIsTheirOwn) {
  Misfit misfit({.usual = 1.0, .memory = 0.0});
  std::vector<Observation> seen(2);
  seen[0].kind = ObservationKind::kWall;
  seen[1].kind = ObservationKind::kBearing;
  PoseSolution solution;
  solution.mahalanobis_squared = {4.0, 2.0};
  misfit.add(seen, solution);
  EXPECT_DOUBLE_EQ(misfit.variance_factors().walls, 2.0);
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, 2.0);
  solution.mahalanobis_squared = {8.0};
  misfit.add({&seen[1], 1}, solution);
  EXPECT_DOUBLE_EQ(misfit.variance_factors().walls, 2.0) << "none is seen";
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, 8.0);
}

TEST(Misfit, ManyContradictOneIsAnOutlier) {
  Misfit one, many;
  std::vector<double> squares(20, 1.0);
  squares[3] = 1e6;
  for (int i = 0; i < 5; ++i) {
    add(one, squares);
    add(many, std::vector<double>(20, 9.0));
  }
  EXPECT_FALSE(one.contradicting());
  EXPECT_TRUE(many.contradicting());
}

TEST(Misfit, OfFewLandmarksThatThePoseFollowsSaysLittle) {
  Misfit misfit;
  for (int i = 0; i < 20; ++i) add(misfit, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(misfit.variance_factors().all, MisfitParams{}.least);
}

TEST(Misfit, ANumberThatIsNoneCountsAsAnOutlier) {
  Misfit none, outlier;
  add(none, {1.0, std::numeric_limits<double>::quiet_NaN()});
  add(outlier, {1.0, 1e6});
  EXPECT_DOUBLE_EQ(none.variance_factors().all, outlier.variance_factors().all);
}

TEST(Misfit, Fades) {
  Misfit misfit;
  add(misfit, std::vector<double>(20, 16.0));
  double before = misfit.variance_factors().all;
  for (int i = 0; i < 20; ++i) {
    add(misfit, std::vector<double>(20, 1.3));
    EXPECT_LT(misfit.variance_factors().all, before);
    before = misfit.variance_factors().all;
  }
  EXPECT_NEAR(before, 1.0, 0.01);
}

}  // namespace
}  // namespace credo::localization
