// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Segment;

TEST(DistanceField, IsTheDistanceToTheNearestWallWithinReach) {
  const std::vector<Segment> walls{
      {{0, 0}, {6, 0}}, {{6, 0}, {6, 4}}, {{1, 1}, {4, 3.5}}, {{2, -1}, {2, -1.5}}, {{5, 3}, {4.5, 2}}};
  const DistanceField field(walls);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-1.0, 7.0), y(-2.5, 5.0);
  for (int i = 0; i < 20'000; ++i) {
    const Vector2d point(x(random), y(random));
    double nearest = DistanceField::kReach_m;
    for (const Segment& wall : walls) nearest = std::min(nearest, geometry::distance(point, wall));
    // A cell's centre is at most half a diagonal away, and units are rounded down.
    ASSERT_NEAR(field(point), nearest, 0.75 * field.resolution_m()) << point.transpose();
  }
}

TEST(DistanceField, WithoutWallsEverythingIsFar) {
  const DistanceField field({});
  EXPECT_DOUBLE_EQ(field({0, 0}), DistanceField::kReach_m);
}

TEST(DistanceField, OutsideOfThePlanEverythingIsFar) {
  const std::vector<Segment> walls{{{0, 0}, {1, 0}}};
  const DistanceField field(walls);
  for (const Vector2d& point : {Vector2d(1e9, 0), Vector2d(-1e9, 0), Vector2d(0, -3), Vector2d(NAN, 0)})
    EXPECT_DOUBLE_EQ(field(point), DistanceField::kReach_m) << point.transpose();
}

TEST(DistanceField, AFarWallDoesNotCoarsenTheOthers) {
  const std::vector<Segment> walls{{{0, 0}, {5, 0}}, {{2000, 1000}, {2005, 1000}}};
  const DistanceField field(walls);
  EXPECT_DOUBLE_EQ(field.resolution_m(), 0.05);
  EXPECT_NEAR(field({2.5, 0.2}), 0.2, 0.04);
  EXPECT_NEAR(field({2002, 1000.1}), 0.1, 0.04);
}

TEST(DistanceField, AnEnormousPlanGetsCoarserCells) {
  const std::vector<Segment> walls{{{0, 0}, {5, 0}}, {{1e6, 1e6}, {1e6 + 5, 1e6}}};
  const DistanceField field(walls);
  EXPECT_GT(field.resolution_m(), 1.0);
  EXPECT_LE(field({2.5, 0.2}), DistanceField::kReach_m);
}

}  // namespace
}  // namespace credo::localization
