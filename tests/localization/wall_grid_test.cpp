// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/wall_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Segment;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// Walls in all directions, some along the grid's lines, in 30 m x 20 m.
std::vector<Segment> random_walls(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> x(-10.0, 20.0), y(-5.0, 15.0), share(0.0, 1.0);
  std::vector<Segment> walls;
  for (int i = 0; i < count; ++i) {
    Segment wall{{x(random), y(random)}, {x(random), y(random)}};
    if (share(random) < 0.3) wall.a = {std::round(wall.a.x()), std::round(wall.a.y())};
    if (share(random) < 0.3) wall.b.y() = wall.a.y();
    if (share(random) < 0.3) wall.b.x() = wall.a.x() + (wall.b.y() == wall.a.y() ? 1.0 : 0.0);
    walls.push_back(wall);
  }
  return walls;
}

/// By the definition: origin + d direction = a + s (b - a).
double crossing(const Vector2d& origin, const Vector2d& direction, const Segment& wall) {
  Eigen::Matrix2d sides;
  sides << direction, wall.a - wall.b;
  if (std::abs(sides.determinant()) < 1e-12) return kNowhere;
  const Vector2d found = sides.inverse() * (wall.a - origin);
  return found.x() > 0.0 && found.y() >= 0.0 && found.y() <= 1.0 ? found.x() : kNowhere;
}

RC_GTEST_PROP(WallGrid, FindsTheFirstWallOfAll, (unsigned seed)) {
  std::mt19937 random(seed);
  const std::vector<Segment> walls = random_walls(random, 1 + static_cast<int>(seed % 30));
  const WallGrid grid(walls);
  std::uniform_real_distribution<double> place(-15.0, 25.0), angle(-4.0, 4.0), reach(0.5, 40.0);
  for (int i = 0; i < 20; ++i) {
    const Vector2d origin(place(random), place(random));
    const double theta = i % 4 == 0 ? 0.5 * std::numbers::pi * i / 4 : angle(random), farthest = reach(random);
    const Vector2d direction(std::cos(theta), std::sin(theta));
    double nearest = kNowhere;
    for (const Segment& wall : walls) nearest = std::min(nearest, crossing(origin, direction, wall));
    if (std::abs(nearest - farthest) < 1e-6) continue;
    const double found = grid.first_crossing(origin, direction, farthest);
    const bool right = nearest < farthest ? std::abs(found - nearest) < 1e-6 : std::isinf(found);
    RC_ASSERT(right);
    RC_ASSERT(grid.any_crossing(origin, direction, farthest) == (nearest < farthest));
  }
}

RC_GTEST_PROP(WallGrid, KnowsWhetherAWallIsNearAndWhich, (unsigned seed)) {
  std::mt19937 random(seed);
  const std::vector<Segment> walls = random_walls(random, 1 + static_cast<int>(seed % 30));
  const WallGrid grid(walls);
  std::uniform_real_distribution<double> place(-15.0, 25.0), reach(0.01, 3.0);
  std::vector<int> listed;
  for (int i = 0; i < 20; ++i) {
    const Vector2d point(place(random), place(random));
    const double distance = reach(random);
    grid.list_near(point, distance, listed);
    RC_ASSERT(std::is_sorted(listed.begin(), listed.end()));
    bool any = false;
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (geometry::distance(point, walls[w]) > distance) continue;
      any = true;
      RC_ASSERT(std::count(listed.begin(), listed.end(), static_cast<int>(w)) == 1);
    }
    RC_ASSERT(grid.any_near(point, distance) == any);
  }
}

TEST(WallGrid, WithoutWallsHasNothing) {
  const WallGrid grid(std::span<const Segment>{});
  std::vector<int> listed{1};
  grid.list_near({0, 0}, 1.0, listed);
  EXPECT_THAT(listed, IsEmpty());
  EXPECT_FALSE(grid.any_near({0, 0}, 1e9));
  EXPECT_EQ(grid.first_crossing({0, 0}, {1, 0}, 1e9), kNowhere);
  EXPECT_TRUE(std::isinf(grid.first_hit({0, 0}, {1, 0}, 1e9).range_m));
}

TEST(WallGrid, TheFirstOfTwoWallsIsMetAndItsNormalFacesTheRay) {
  const std::vector<Segment> walls{{{5, -1}, {5, 1}}, {{3, 1}, {3, -1}}};
  for (const bool turned : {false, true}) {
    const WallGrid grid(turned ? std::vector<Segment>{walls[0], {walls[1].b, walls[1].a}} : walls);
    const RayHit hit = grid.first_hit({0.0, 0.2}, Vector2d::UnitX(), 10.0);
    EXPECT_DOUBLE_EQ(hit.range_m, 3.0);
    EXPECT_NEAR((hit.normal - Vector2d(-1.0, 0.0)).norm(), 0.0, 1e-12);
  }
}

TEST(WallGrid, WhatIsBeyondTheReachIsNotMet) {
  const std::vector<Segment> walls{{{3, -1}, {3, 1}}};
  EXPECT_TRUE(std::isinf(WallGrid(walls).first_hit({0.0, 0.0}, Vector2d::UnitX(), 2.9).range_m));
}

TEST(WallGrid, ARayFromOutsideThePlanReachesIt) {
  const std::vector<Segment> walls{{{3, -1}, {3, 1}}};
  EXPECT_DOUBLE_EQ(WallGrid(walls).first_hit({-40.0, 0.0}, Vector2d::UnitX(), 100.0).range_m, 43.0);
}

TEST(WallGrid, ARayAlongAnAxisThroughBordersIsNotLost) {
  const std::vector<Segment> walls{{{0, 0}, {0, 8}}, {{8, 0}, {8, 8}}, {{0, 8}, {8, 8}}};
  const WallGrid grid(walls);
  for (double y = 0.5; y < 8.0; y += 0.25) {
    EXPECT_NEAR(grid.first_crossing({1.0, y}, Vector2d::UnitX(), 20.0), 7.0, 1e-12);
    EXPECT_NEAR(grid.first_crossing({1.0, y}, Vector2d::UnitY(), 20.0), 8.0 - y, 1e-12);
  }
}

TEST(WallGrid, ARayAlongABorderOfItsSquaresMissesNothing) {
  const std::vector<Segment> walls{{{0, 0}, {8, 0}}, {{3, -1}, {3, 5}}, {{8, 0}, {8, 8}}};
  const WallGrid grid(walls);
  for (const double y : {0.5, 0.996, 0.998, 1.0, 1.002, 3.998, 4.0})
    EXPECT_NEAR(grid.first_crossing({1.0, y}, {1, 0}, 20.0), 2.0, 1e-12) << y;
  EXPECT_NEAR(grid.first_crossing({-5, 6}, {1, 0}, 20.0), 13.0, 1e-12) << "from outside";
}

TEST(WallGrid, AnEnormousPlanHasLargerSquaresNotMoreOfThem) {
  const std::vector<Segment> walls{{{0, 0}, {1, 0}}, {{1e7, 1e7}, {1e7, 1e7 + 5}}};
  const WallGrid grid(walls);
  EXPECT_NEAR(grid.first_crossing({1e7 - 3, 1e7 + 1}, {1, 0}, 10.0), 3.0, 1e-6);
  std::vector<int> listed;
  grid.list_near({0.5, 0.1}, 0.2, listed);
  EXPECT_THAT(listed, ElementsAre(0));
}

}  // namespace
}  // namespace credo::localization
