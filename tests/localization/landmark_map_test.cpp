// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/landmark_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::FloorPlan;
using geometry::Segment;
using perception::PrimitiveType;

FloorPlan l_shaped_room() {
  // (0,0) (4,0) (4,2) (2,2) (2,4) (0,4): five corners and, at (2,2), one edge.
  const std::vector<Vector2d> p{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  FloorPlan plan;
  for (std::size_t i = 0; i < p.size(); ++i) plan.walls.push_back({p[i], p[(i + 1) % p.size()]});
  return plan;
}

int count(const LandmarkMap& map, PrimitiveType type, const Vector2d& from) {
  int n = 0;
  for (const PointLandmark& point : map.points()) n += map.type_from(point, from) == type ? 1 : 0;
  return n;
}

TEST(LandmarkMap, JunctionsAreCornersInsideAndEdgesOutside) {
  const LandmarkMap map(l_shaped_room());
  EXPECT_EQ(map.walls().size(), 6U);
  EXPECT_EQ(map.points().size(), 6U);
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {1, 1}), 5);
  EXPECT_EQ(count(map, PrimitiveType::kEdge, {1, 1}), 1);
  const PointLandmark notch = map.point(map.point_id(3));
  ASSERT_LT((notch.position - Vector2d(2, 2)).norm(), 1e-9);
  EXPECT_EQ(map.type_from(notch, {3, 3}), PrimitiveType::kCorner) << "from the other side";
}

TEST(LandmarkMap, EndsWithinTheToleranceAreOneJunction) {
  FloorPlan plan = l_shaped_room();
  for (std::size_t i = 0; i < plan.walls.size(); ++i) plan.walls[i].a += Vector2d(0.01, -0.01);
  EXPECT_EQ(LandmarkMap(plan).points().size(), 6U);
  for (Segment& wall : plan.walls) wall.a += Vector2d(0.1, 0.1);
  EXPECT_GT(LandmarkMap(plan).points().size(), 6U);
}

TEST(LandmarkMap, CollinearJoinedWallsAreOneWallWithoutALandmarkBetween) {
  FloorPlan plan;
  plan.walls = {{{0, 0}, {2, 0.01}}, {{2, 0}, {5, 0}}, {{5.01, 0}, {9, 0}}};
  const LandmarkMap map(plan);
  ASSERT_EQ(map.walls().size(), 1U);
  EXPECT_NEAR(map.walls()[0].length_m, 9.0, 1e-3);
  EXPECT_EQ(count(map, PrimitiveType::kEdge, {4, 3}), 2) << "the two free ends";
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {4, 3}), 0);
}

TEST(LandmarkMap, WallAgainstTheMiddleOfAnotherIsACornerOnBothSides) {
  FloorPlan plan;
  plan.walls = {{{-3, 0}, {3, 0}}, {{0, 0.02}, {0, 2}}};
  const LandmarkMap map(plan);
  EXPECT_EQ(map.walls().size(), 2U);
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {1, 1}), 1);
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {-1, 1}), 1);
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {0.5, -1}), 0) << "from below it is a flat wall";
}

TEST(LandmarkMap, CurveGivesNeitherCornersNorEdgesNorWalls) {
  FloorPlan plan;
  const auto at = [](int i) {
    return Vector2d(0.25 * std::cos(i * std::numbers::pi / 8), 0.25 * std::sin(i * std::numbers::pi / 8));
  };
  for (int i = 0; i < 16; ++i) plan.walls.push_back({at(i), at(i + 1)});
  const LandmarkMap map(plan);
  EXPECT_TRUE(map.walls().empty());
  EXPECT_EQ(count(map, PrimitiveType::kEdge, {2, 1}), 0);
  EXPECT_EQ(count(map, PrimitiveType::kCorner, {2, 1}), 0);
  EXPECT_FALSE(map.sees({2, 0}, {-2, 0}, 0.05)) << "and still hides what is behind it";
}

TEST(LandmarkMap, VerticalsAreOthersFromEverywhere) {
  FloorPlan plan = l_shaped_room();
  plan.verticals = {{1, 0}};
  const LandmarkMap map(plan);
  EXPECT_EQ(count(map, PrimitiveType::kOther, {1, 1}), 1);
  EXPECT_EQ(map.point(map.point_id(6)).position, Vector2d(1, 0));
}

TEST(LandmarkMap, WallsCutAtPointsEndAtDoorFramesAndAtWallsThatMeetThem) {
  geometry::FloorPlan plan;
  plan.walls = {{{0, 0}, {8, 0}}, {{6, 0}, {6, 3}}};
  plan.verticals = {{2.0, 0.01}, {2.1, 0.0}, {4.0, 1.0}};  // a frame of 10 cm, and a mark that is not on the wall
  LandmarkMapParams params;
  EXPECT_EQ(LandmarkMap(plan, params).walls().size(), 2U);
  params.cut_walls_at_points = true;
  const LandmarkMap map(plan, params);
  std::vector<double> lengths;
  for (const WallLandmark& wall : map.walls()) lengths.push_back(wall.length_m);
  ASSERT_EQ(lengths.size(), 4U);  // the 10 cm between the frame's edges are no landmark
  EXPECT_NEAR(lengths[0], 2.0, 1e-9);
  EXPECT_NEAR(lengths[1], 3.9, 1e-9);
  EXPECT_NEAR(lengths[2], 2.0, 1e-9);
  EXPECT_NEAR(lengths[3], 3.0, 1e-9);
}

TEST(LandmarkMap, SeesUpToTheFirstWall) {
  const LandmarkMap map(l_shaped_room());
  EXPECT_TRUE(map.sees({1, 1}, {4, 1}, 0.01));
  EXPECT_FALSE(map.sees({3.5, 0.5}, {1, 3.9}, 0.01)) << "round the edge";
  EXPECT_FALSE(map.sees({1, 1}, {6, 1}, 0.01));
  EXPECT_NEAR(map.cast({1, 1}, Vector2d::UnitX(), 10.0), 3.0, 1e-12);
  EXPECT_TRUE(std::isinf(map.cast({1, 1}, Vector2d::UnitX(), 2.0)));
}

TEST(LandmarkMap, EmptyPlanIsAnEmptyMap) {
  const LandmarkMap map{FloorPlan{}};
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(map.sees({0, 0}, {5, 5}, 0.0));
}

TEST(WallLandmark, PlanCovarianceIsThatOfIndependentEnds) {
  WallLandmark wall;
  wall.length_m = 4.0;
  wall.plan_terms = {{.junction = 0, .offset = 1.0, .slope = -0.25}, {.junction = 1, .offset = 0.0, .slope = 0.25}};
  const Eigen::Matrix2d at_end = wall.plan_covariance(0.0, 0.01);
  EXPECT_NEAR(at_end(0, 0), 1e-4, 1e-12);
  const Eigen::Matrix2d at_middle = wall.plan_covariance(2.0, 0.01);
  EXPECT_NEAR(at_middle(0, 0), 0.5e-4, 1e-12);
  EXPECT_NEAR(at_middle(0, 1), 0.0, 1e-12);
  EXPECT_NEAR(at_middle(1, 1), 2e-4 / 16.0, 1e-12);
}

TEST(WallLandmark, IsOffWithTheJunctionsItIsDrawnThrough) {
  // Two pieces of one wall, which meet where a third wall leaves. Moving a junction moves the line as its term says.
  const double moved = 0.01;
  const auto plan = [&](double x_moved) {
    const auto y = [&](double x) { return x == x_moved ? moved : 0.0; };
    return FloorPlan{.walls = {{{0, y(0)}, {2, y(2)}}, {{2, y(2)}, {5, y(5)}}, {{2, y(2)}, {2, -1}}},
                     .verticals = {},
                     .uncertainty_m = 0.01};
  };
  const LandmarkMap straight{plan(-1)};
  const WallLandmark& wall = straight.walls().front();
  ASSERT_NEAR(wall.length_m, 5.0, 1e-9);
  EXPECT_EQ(wall.plan_terms.size(), 3U);
  for (const PlanTerm& term : wall.plan_terms) {
    const Vector2d junction = straight.points()[static_cast<std::size_t>(term.junction)].position;
    const WallLandmark other = LandmarkMap{plan(junction.x())}.walls().front();
    const double sign = wall.normal().y();
    for (const double along : {0.0, 2.5, 5.0}) {
      const Vector2d at = wall.extent.a + along * wall.direction;
      const double offset = -other.normal().dot(at - other.extent.a) * (other.normal().dot(wall.normal()) > 0 ? 1 : -1);
      EXPECT_NEAR(offset, sign * moved * (term.offset + term.slope * along), 1e-5) << junction.x() << " " << along;
    }
  }
}

}  // namespace
}  // namespace credo::localization
