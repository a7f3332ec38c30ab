// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/ray_index.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "localization/landmark_map.hpp"
#include "tests/localization/sightings.hpp"

namespace credo::localization {
namespace {

using Eigen::Vector2d;

TEST(RayIndex, WithoutWallsNothingIsMet) {
  EXPECT_TRUE(std::isinf(RayIndex({}).cast({0.0, 0.0}, Vector2d::UnitX(), 10.0).range_m));
}

TEST(RayIndex, TheFirstOfTwoWallsIsMetAndItsNormalFacesTheRay) {
  const std::vector<geometry::Segment> walls{{{5, -1}, {5, 1}}, {{3, 1}, {3, -1}}};
  const RayHit hit = RayIndex(walls).cast({0.0, 0.2}, Vector2d::UnitX(), 10.0);
  EXPECT_DOUBLE_EQ(hit.range_m, 3.0);
  EXPECT_NEAR((hit.normal - Vector2d(-1.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(RayIndex, WhatIsBeyondTheLargestRangeIsNotMet) {
  const std::vector<geometry::Segment> walls{{{3, -1}, {3, 1}}};
  EXPECT_TRUE(std::isinf(RayIndex(walls).cast({0.0, 0.0}, Vector2d::UnitX(), 2.9).range_m));
}

TEST(RayIndex, ARayFromOutsideThePlanReachesIt) {
  const std::vector<geometry::Segment> walls{{{3, -1}, {3, 1}}};
  EXPECT_DOUBLE_EQ(RayIndex(walls).cast({-40.0, 0.0}, Vector2d::UnitX(), 100.0).range_m, 43.0);
}

TEST(RayIndex, AgreesWithLookingAtEveryWall) {
  test::Random random(7);
  geometry::FloorPlan plan;
  for (int i = 0; i < 60; ++i) plan.walls.push_back(random.segment());
  const LandmarkMap map(plan);
  const RayIndex rays(map.surfaces());
  for (int i = 0; i < 3000; ++i) {
    const Vector2d origin = 1.5 * random.place();
    const double angle = random(-3.14, 3.14);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const double expected = map.cast(origin, direction, 12.0);
    const double range = rays.cast(origin, direction, 12.0).range_m;
    if (std::isinf(expected))
      EXPECT_TRUE(std::isinf(range)) << origin.transpose() << " " << angle;
    else
      EXPECT_NEAR(range, expected, 1e-9) << origin.transpose() << " " << angle;
  }
}

TEST(RayIndex, ARayAlongAnAxisThroughCellBordersIsNotLost) {
  const std::vector<geometry::Segment> walls{{{0, 0}, {0, 8}}, {{8, 0}, {8, 8}}, {{0, 8}, {8, 8}}};
  const RayIndex rays(walls);
  for (double y = 0.5; y < 8.0; y += 0.25) {
    EXPECT_NEAR(rays.cast({1.0, y}, Vector2d::UnitX(), 20.0).range_m, 7.0, 1e-12);
    EXPECT_NEAR(rays.cast({1.0, y}, Vector2d::UnitY(), 20.0).range_m, 8.0 - y, 1e-12);
  }
}

}  // namespace
}  // namespace credo::localization
