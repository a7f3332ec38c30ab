// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/map_matching.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "tests/localization/matching.hpp"
#include "tests/support/seeded.hpp"

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Pose2;
using geometry::Segment;
using perception::Method;
using perception::Scene;
using tracking::LandmarkId;
using namespace test;  // NOLINT: the helpers of these tests

constexpr auto kCorner = PrimitiveType::kCorner;
constexpr auto kOther = PrimitiveType::kOther;

constexpr Method kBoth[] = {Method::kDefault, Method::kPaper};

// ---------------------------------------------------------------------------------------------- by both methods

TEST(MapMatching, WhatIsSeenWhereTheMapHasItIsMatched) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    for (int k = 0; k < 4; ++k) {
      const Segment& wall = matching.plan.walls[static_cast<std::size_t>(k)];
      const auto walls = matching.walls({wall_seen(wall, kPose)});
      ASSERT_EQ(walls.size(), 1U) << "wall " << k;
      EXPECT_EQ(walls[0].landmark, k);
      EXPECT_GT(walls[0].yes, 0.8);
      const auto corners = matching.points({point_seen(kCorner, wall.a, kPose)});
      ASSERT_EQ(corners.size(), 1U) << "corner " << k;
      EXPECT_EQ(corners[0].landmark, kFirstCorner + k);
      EXPECT_GT(corners[0].yes, 0.8);
    }
  }
}

TEST(MapMatching, WhatIsFarFromAllLandmarksIsNotMatched) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    EXPECT_TRUE(matching.walls({wall_seen({{0, -2}, {6, -2}}, kPose)}).empty()) << "parallel, 2 m behind";
    EXPECT_TRUE(matching.walls({wall_seen({{1, -2}, {5, 2}}, kPose)}).empty())
        << "across a wall's middle, at 45 degrees";
    EXPECT_TRUE(matching.points({point_seen(kCorner, {0.0, 2.0}, kPose)}).empty()) << "amid a wall";
  }
}

TEST(MapMatching, WhatIsHiddenIsNotMatched) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    const Segment behind{{1, 5}, {5, 5}};
    const Vector2d mark(3.0, 5.0);
    for (const bool hidden : {true, false}) {
      matching.plan = {};
      matching.plan.walls = {behind};
      matching.plan.verticals = {mark};
      if (hidden) matching.plan.walls.push_back({{-3, 2.2}, {9, 2.2}});
      EXPECT_EQ(matching.walls({wall_seen(behind, kPose)}).empty(), hidden);
      EXPECT_EQ(matching.points({point_seen(kOther, mark, kPose)}).empty(), hidden);
    }
  }
}

TEST(MapMatching, TheLandmarkThatIsTakenIsNotMatchedAgain) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    const std::vector<Primitive> seen{point_seen(kCorner, {0, 0}, kPose), point_seen(kCorner, {6, 0}, kPose)};
    ASSERT_EQ(matching.points(seen).size(), 2U);
    const auto matches = matching.points(seen, {kFirstCorner});
    ASSERT_EQ(matches.size(), 1U);
    EXPECT_EQ(matches[0].primitive, 1);
    EXPECT_EQ(matches[0].landmark, kFirstCorner + 1);
  }
}

TEST(MapMatching, OfTwoPrimitivesThatClaimAPointTheNearerHasIt) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    const auto matches = matching.points({point_seen(kCorner, {0.1, 0.1}, kPose), point_seen(kCorner, {0, 0}, kPose)});
    ASSERT_EQ(matches.size(), 1U);
    EXPECT_EQ(matches[0].primitive, 1);
  }
}

TEST(MapMatching, OnlyThePrimitivesAskedForAreMatched) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    const LandmarkMap map(room());
    MapMatcher matcher(map, matching.params);
    Scene scene;
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(6, 0), Vector2d(6, 4)})
      scene.primitives.push_back(point_seen(kCorner, corner, kPose));
    const auto& matches = matcher.match_points(scene, std::array{2}, matching.pose, {});
    ASSERT_EQ(matches.size(), 1U);
    EXPECT_EQ(matches[0].primitive, 2);
    EXPECT_TRUE(matcher.match_points(scene, {}, matching.pose, {}).empty()) << "nothing of the call before is left";
  }
}

TEST(MapMatching, WallsAndPointsAreNotMatchedWithEachOther) {
  for (const Method method : kBoth) {
    const Matching matching = by(method);
    EXPECT_TRUE(matching.points({point_seen(PrimitiveType::kWall, {0, 0}, kPose)}).empty());
    Primitive no_wall = wall_seen(matching.plan.walls[0], kPose);
    no_wall.type = kOther;
    EXPECT_TRUE(matching.walls({no_wall}).empty());
  }
}

TEST(MapMatching, NothingIsMatchedWithoutASceneOrAMap) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    EXPECT_TRUE(matching.walls({}).empty());
    EXPECT_TRUE(matching.points({}).empty());
    const Segment wall = matching.plan.walls[0];
    matching.plan = {};
    EXPECT_TRUE(matching.walls({wall_seen(wall, kPose)}).empty());
    EXPECT_TRUE(matching.points({point_seen(kCorner, wall.a, kPose)}).empty());
  }
}

// ---------------------------------------------------------------------------------------------- default

TEST(MapMatching, WallsTenCentimetresApartAreContestedWhereThePoseDoesNotTell) {
  Matching matching;
  matching.plan = {};
  matching.plan.walls = {{{0, 3}, {6, 3}}, {{0, 3.1}, {6, 3.1}}};
  matching.map_params.visibility_margin_m = 0.2;
  const std::vector<Primitive> between{wall_seen({{1, 3.05}, {5, 3.05}}, kPose)};
  matching.pose = believed(kPose, 0.05);
  EXPECT_TRUE(matching.walls(between).empty());
  matching.params.min_margin = 0.0;
  EXPECT_EQ(matching.walls(between).size(), 1U) << "it is the margin that withheld it";
  matching.params = {};
  matching.pose = believed(kPose, 0.005, 0.002);
  const auto matches = matching.walls({wall_seen({{1, 3.1}, {5, 3.1}}, kPose)});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].landmark, 1) << "a sure pose tells";
}

TEST(MapMatching, PiecesOfAWallAreAllThatWall) {
  const auto matches = Matching{}.walls({wall_seen({{0.5, 0}, {2, 0}}, kPose), wall_seen({{5.5, 0}, {3, 0}}, kPose)});
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].landmark, 0);
  EXPECT_EQ(matches[1].landmark, 0);
}

TEST(MapMatching, AWallThatGoesOnBeyondTheMapsIsAnotherOne) {
  Matching matching;
  matching.plan = {};
  matching.plan.walls = {{{1, 0}, {4, 0}}};
  EXPECT_EQ(matching.walls({wall_seen({{1.5, 0}, {4.1, 0}}, kPose)}).size(), 1U);
  EXPECT_TRUE(matching.walls({wall_seen({{1.5, 0}, {6, 0}}, kPose)}).empty());
  matching.pose = believed(kPose, 0.3);
  EXPECT_TRUE(matching.walls({wall_seen({{4.1, 0}, {4.6, 0}}, kPose)}).empty())
      << "past its end on the same line, however unsure the pose is";
}

TEST(MapMatching, HowFarOffIsTooFarIsAMatterOfThePosesSigma) {
  Matching matching;
  const std::vector<Primitive> wall{wall_seen({{1, 0.3}, {5, 0.3}}, kPose)};
  const std::vector<Primitive> corner{point_seen(kCorner, {0.2, 0.2}, kPose)};
  const std::vector<Primitive> turned_wall{wall_seen({{1, -0.2}, {5, 0.2}}, kPose)};
  const std::vector<Primitive> turned{point_seen(kCorner, {6, 4}, {kPose.x, kPose.y, kPose.theta - 0.1})};
  for (const bool sure : {true, false}) {
    matching.pose = believed(kPose, sure ? 0.02 : 0.3);
    EXPECT_EQ(matching.walls(wall).empty(), sure);
    EXPECT_EQ(matching.points(corner).empty(), sure);
    matching.pose = believed(kPose, 0.02, sure ? 0.01 : 0.1);
    EXPECT_EQ(matching.points(turned).empty(), sure);
    EXPECT_EQ(matching.walls(turned_wall).empty(), sure);
  }
}

TEST(MapMatching, AnotherTypeWeakensAMatchAndIsNoneForThePaper) {
  const std::vector<Primitive> corner{point_seen(kCorner, {0, 0}, kPose)};
  const std::vector<Primitive> edge{point_seen(PrimitiveType::kEdge, {0, 0}, kPose)};
  const auto matches = Matching{}.points(edge);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_LT(matches[0].yes, Matching{}.points(corner).at(0).yes);
  EXPECT_TRUE(by(Method::kPaper).points(edge).empty());
}

TEST(MapMatching, ABearingIsTakenFromTheCameraAndIsNoneForThePaper) {
  const Vector2d mark = kPose * Vector2d(1.0, 0.0), camera(0.5, 0.2);
  const std::vector<Primitive> seen{bearing_seen(mark, kPose, camera, 0)};
  for (const Method method : kBoth) {
    Matching matching = by(method);
    matching.plan = room({mark});
    matching.camera_origin = camera;
    const auto matches = matching.points(seen);
    ASSERT_EQ(matches.size(), method == Method::kDefault ? 1U : 0U);
    for (const MapMatch& match : matches) EXPECT_EQ(match.landmark, kFirstMark);
    matching.camera_origin = Vector2d::Zero();
    EXPECT_TRUE(matching.points(seen).empty()) << "from there it points elsewhere";
  }
}

TEST(MapMatching, WhatIsContestedIsWithheldByTheDefaultAndGivenAwayByThePaper) {
  for (const Method method : kBoth) {
    Matching matching = by(method);
    matching.pose = believed({4.0, 1.0, std::numbers::pi / 2.0}, 0.05);
    const std::size_t expected = method == Method::kDefault ? 0U : 1U;
    matching.plan = room({{3.95, 3.0}, {4.05, 3.0}});
    const Pose2& from = matching.pose.pose;
    EXPECT_EQ(matching.points({point_seen(kOther, {4.0, 3.0}, from)}).size(), expected) << "by two landmarks";
    matching.plan = room({{4.0, 3.0}});
    EXPECT_EQ(matching.points({point_seen(kOther, {3.95, 3.0}, from), point_seen(kOther, {4.05, 3.0}, from)}).size(),
              expected)
        << "by two primitives";
  }
}

// ---------------------------------------------------------------------------------------------- paper

TEST(MapMatching, ThePaperRefusesWhatItsCriteriaConflictOverTooMuch) {
  Matching matching = by(Method::kPaper);
  const evidence::RampBelief always_yes{.max_yes = 1.0, .yes_full_until = 1e3, .yes_zero_from = 1e4};
  evidence::RampBelief always_no{.max_no = 0.0, .no_zero_until = -2.0, .no_full_from = -1.0};
  matching.params.paper_wall_angle_deg = matching.params.paper_point_range_m = always_yes;
  matching.params.paper_wall_length_m = {};
  const std::vector<Primitive> wall{wall_seen(matching.plan.walls[0], kPose)};
  const std::vector<Primitive> corner{point_seen(kCorner, {0, 0}, kPose)};
  for (const double conflict : {0.69, 0.71}) {
    always_no.max_no = conflict;
    matching.params.paper_wall_center_m = matching.params.paper_point_azimuth_deg = always_no;
    EXPECT_EQ(matching.walls(wall).size(), conflict < 0.7 ? 1U : 0U);
    EXPECT_EQ(matching.points(corner).size(), conflict < 0.7 ? 1U : 0U);
  }
}

// ---------------------------------------------------------------------------------------------- laws

RC_GTEST_PROP(MapMatching, GivesAPointToOnePrimitiveAtMostAndThatOneItsPointOnly, (unsigned seed, bool paper)) {
  Random random(seed);
  Matching matching = by(kBoth[paper ? 1 : 0]);
  std::vector<Vector2d> marks;
  std::vector<Primitive> seen;
  for (int k = 0; k < 12; ++k) {
    marks.emplace_back(random(3.0, 5.0), random(1.5, 3.5));
    seen.push_back(point_seen(kOther, marks.back() + Vector2d(random(-0.1, 0.1), random(-0.1, 0.1)), kPose));
  }
  matching.plan = room(marks);
  matching.pose = believed(kPose, 0.1);
  std::set<int> primitives;
  std::set<LandmarkId> landmarks;
  for (const MapMatch& match : matching.points(seen)) {
    RC_ASSERT(primitives.insert(match.primitive).second);
    RC_ASSERT(landmarks.insert(match.landmark).second);
    RC_ASSERT(match.landmark >= kFirstMark);
    RC_ASSERT(match.yes > 0.0 && match.yes <= 1.0);
  }
  RC_CLASSIFY(primitives.size() >= 4, "four or more");
}

RC_GTEST_PROP(MapMatching, DoesNotDependOnTheMapsFrame, (unsigned seed, bool paper)) {
  Random random(seed);
  const Pose2 T{random(-20.0, 20.0), random(-20.0, 20.0), random(-3.0, 3.0)};
  Matching here = by(kBoth[paper ? 1 : 0]);
  here.plan.uncertainty_m = 0.01;
  Matching there = here;
  for (Segment& wall : there.plan.walls) wall = T * wall;
  there.pose.pose = T * here.pose.pose;
  std::vector<Primitive> seen;
  for (const Segment& wall : here.plan.walls) {
    const Pose2 off{random(-0.05, 0.05), random(-0.05, 0.05), random(-0.02, 0.02)};
    seen.push_back(wall_seen(off * wall, kPose));
    seen.push_back(point_seen(kCorner, off * wall.a, kPose));
  }
  const auto same = [](const MapMatch& a, const MapMatch& b) {
    return a.primitive == b.primitive && a.landmark == b.landmark && std::abs(a.yes - b.yes) < 1e-6;
  };
  RC_ASSERT(std::ranges::equal(here.walls(seen), there.walls(seen), same));
  RC_ASSERT(std::ranges::equal(here.points(seen), there.points(seen), same));
}

}  // namespace
}  // namespace credo::localization
