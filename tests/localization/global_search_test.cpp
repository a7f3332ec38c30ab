// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/global_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/localization/places.hpp"

namespace credo::localization {
namespace {

using geometry::Pose2;
using test::scanned;
using test::scanned_with_walls;

double distance(const Pose2& a, const Pose2& b) { return (a.translation() - b.translation()).norm(); }
double turn(const Pose2& a, const Pose2& b) { return std::abs(geometry::angle_difference(a.theta, b.theta)); }

bool any_near(const std::vector<PoseCandidate>& candidates, const Pose2& pose) {
  return std::any_of(candidates.begin(), candidates.end(), [&](const PoseCandidate& candidate) {
    return distance(candidate.estimate.pose, pose) < 0.1 && turn(candidate.estimate.pose, pose) < 0.05;
  });
}

class GlobalSearchInARoom : public ::testing::Test {
 protected:
  LandmarkMap map_{test::odd_room()};
  DistanceField field_{map_.surfaces()};
  GlobalSearch search_{map_, field_, test::rig_with_range()};
};

TEST_F(GlobalSearchInARoom, TheBestCandidateIsThePoseFromWhereverItIs) {
  for (const Pose2& truth : {Pose2{2.0, 1.5, 0.4}, Pose2{6.5, 3.8, -2.3}, Pose2{4.6, 5.4, 1.6}, Pose2{0.6, 0.5, 3.0}}) {
    const auto& candidates = search_.search(scanned_with_walls(map_, truth));
    ASSERT_FALSE(candidates.empty()) << truth;
    EXPECT_LT(distance(candidates.front().estimate.pose, truth), 0.02) << truth;
    EXPECT_LT(turn(candidates.front().estimate.pose, truth), 0.005) << truth;
    EXPECT_GT(candidates.front().plausibility.log_ratio, 10.0) << truth;
  }
}

TEST_F(GlobalSearchInARoom, WithoutPrimitivesAllHeadingsAreTried) {
  const Pose2 truth{2.7, 2.2, 1.1};
  const auto& candidates = search_.search(scanned(map_, truth));
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT(distance(candidates.front().estimate.pose, truth), 0.02);
  EXPECT_LT(turn(candidates.front().estimate.pose, truth), 0.005);
}

TEST_F(GlobalSearchInARoom, APlanOfMoreCellsThanAreLaidBeginsWithCoarserOnes) {
  const Pose2 truth{2.7, 2.2, 1.1};
  for (const double most : {100.0, 20.0, 1.0}) {
    GlobalSearchParams params;
    params.most_cells = most;
    GlobalSearch search(map_, field_, test::rig_with_range(), params);
    const auto& candidates = search.search(scanned(map_, truth));
    ASSERT_FALSE(candidates.empty()) << most;
    EXPECT_LT(distance(candidates.front().estimate.pose, truth), 0.02) << most;
  }
}

TEST_F(GlobalSearchInARoom, CandidatesComeByFallingPlausibilityAndAreDifferentPlaces) {
  const auto& candidates = search_.search(scanned(map_, {2.7, 2.2, 1.1}));
  for (std::size_t i = 0; i + 1 < candidates.size(); ++i)
    EXPECT_GE(candidates[i].plausibility.log_ratio, candidates[i + 1].plausibility.log_ratio);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(distance(candidates[i].estimate.pose, candidates[j].estimate.pose) >= 0.5 ||
                  turn(candidates[i].estimate.pose, candidates[j].estimate.pose) >= 0.35);
}

TEST_F(GlobalSearchInARoom, TheSameSceneGivesTheSameCandidates) {
  const perception::Scene scene = scanned_with_walls(map_, {2.7, 2.2, 1.1});
  const std::vector<PoseCandidate> first = search_.search(scene);
  (void)search_.search(scanned_with_walls(map_, {6.0, 1.0, 0.1}));
  const std::vector<PoseCandidate>& second = search_.search(scene);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].estimate, second[i].estimate);
}

TEST_F(GlobalSearchInARoom, UnmappedThingsInFrontOfAThirdOfTheWallsDoNotHideThePose) {
  const Pose2 truth{3.0, 2.5, 0.7};
  perception::Scene scene = scanned_with_walls(map_, truth);
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (i % 30 < 10) scene.points[i].position = (scene.points[i].range_m *= 0.7) * scene.points[i].ray;
  EXPECT_LT(distance(search_.search(scene).front().estimate.pose, truth), 0.05);
}

TEST_F(GlobalSearchInARoom, WithoutAScanThereIsNoCandidate) {
  EXPECT_TRUE(search_.search({}).empty());
  perception::Scene scene = scanned(map_, {2.7, 2.2, 1.1});
  scene.range_finder_seen = false;
  EXPECT_TRUE(search_.search(scene).empty());
}

TEST_F(GlobalSearchInARoom, APoseThatLooksThroughWallsIsImplausible) {
  const Pose2 truth{3.0, 2.5, 0.7};
  const perception::Scene scene = scanned(map_, truth);
  EXPECT_GT(search_.log_plausibility(scene, truth), 15.0);
  EXPECT_LT(search_.log_plausibility(scene, {7.0, 4.0, 0.7}), -5.0);
  EXPECT_GT(search_.plausibility(scene, {7.0, 4.0, 0.7}).behind, 20);
}

TEST_F(GlobalSearchInARoom, SomethingBeforeAWallSpeaksLessAgainstAPoseThanSomethingBehind) {
  const Pose2 truth{3.0, 2.5, 0.7};
  perception::Scene before = scanned(map_, truth), behind = before;
  for (std::size_t i = 0; i < 40; ++i) {
    before.points[i].position = (before.points[i].range_m *= 0.7) * before.points[i].ray;
    behind.points[i].position = (behind.points[i].range_m *= 1.3) * behind.points[i].ray;
  }
  EXPECT_GT(search_.log_plausibility(before, truth), search_.log_plausibility(behind, truth) + 5.0);
}

TEST_F(GlobalSearchInARoom, RefiningFindsThePoseNearbyAndKnowsItBetterThanBefore) {
  const Pose2 truth{3.0, 2.5, 0.7};
  const geometry::PoseEstimate expected{{3.15, 2.4, 0.76}, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()};
  const PoseCandidate refined = search_.refine(scanned(map_, truth), expected);
  EXPECT_LT(distance(refined.estimate.pose, truth), 0.01);
  EXPECT_LT(turn(refined.estimate.pose, truth), 0.003);
  EXPECT_LT(refined.estimate.covariance.trace(), 0.1 * expected.covariance.trace());
}

TEST(GlobalSearchInASymmetricRoom, BothPosesAreCandidatesAndEquallyPlausible) {
  const LandmarkMap map(test::plain_room());
  const DistanceField field(map.surfaces());
  GlobalSearch search(map, field, test::rig_with_range());
  const Pose2 truth{1.7, 1.2, 0.5}, alias{6.0 - 1.7, 4.0 - 1.2, 0.5 - std::numbers::pi};
  const auto& candidates = search.search(scanned_with_walls(map, truth));
  EXPECT_TRUE(any_near(candidates, truth));
  EXPECT_TRUE(any_near(candidates, alias));
  EXPECT_NEAR(candidates[0].plausibility.log_ratio, candidates[1].plausibility.log_ratio, 0.2);
}

TEST(GlobalSearchInASymmetricRoom, AMarkThatTheCameraSeesTellsThePosesApart) {
  geometry::FloorPlan plan = test::plain_room();
  plan.verticals = {{2.2, 0.0}, {3.1, 0.0}, {4.8, 0.0}, {0.0, 1.3}};
  const LandmarkMap map(plan);
  const DistanceField field(map.surfaces());
  GlobalSearch search(map, field, test::rig_with_range());
  const Pose2 truth{1.7, 1.2, 0.5}, alias{6.0 - 1.7, 4.0 - 1.2, 0.5 - std::numbers::pi};
  perception::Scene scene = scanned_with_walls(map, truth);
  for (const PointLandmark& point : map.points()) {
    const Eigen::Vector2d way = truth.inverse() * point.position;
    scene.radial_lines.push_back({.azimuth = std::atan2(way.y(), way.x()), .sigma = 0.002});
  }
  EXPECT_GT(search.log_plausibility(scene, truth), search.log_plausibility(scene, alias) + 2.0);
  EXPECT_LT(distance(search.search(scene).front().estimate.pose, truth), 0.02);
}

TEST(GlobalSearchAmongPillars, WithoutAWallAllHeadingsAreTried) {
  geometry::FloorPlan plan;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0, 0), {4, 0.5}, {1, 3.5}, {5, 4.2}, {2.7, 1.9}}) {
    constexpr int kSides = 12;
    const auto corner = [&](int k) -> Eigen::Vector2d {
      const double angle = geometry::kTurn * k / kSides;
      return at + 0.25 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    };
    for (int i = 0; i < kSides; ++i) plan.walls.push_back({corner(i), corner(i + 1)});
  }
  const LandmarkMap map(plan);
  const DistanceField field(map.surfaces());
  sensors::Rig rig = test::rig_with_range();
  rig.range_finders.front().count = 720;
  rig.range_finders.front().angle_increment_rad = geometry::to_radians(0.5);
  GlobalSearchParams params;
  params.plausibility.most_beams = 720;
  GlobalSearch search(map, field, rig, params);
  const Pose2 truth{3.4, 3.0, -2.2};
  EXPECT_TRUE(any_near(search.search(scanned(map, truth, rig)), truth));
}

TEST(GlobalSearchWithoutAPlan, ThereIsNothingToSay) {
  const LandmarkMap nothing(geometry::FloorPlan{}), room(test::odd_room());
  const DistanceField field(nothing.surfaces());
  GlobalSearch search(nothing, field, test::rig_with_range());
  EXPECT_TRUE(search.search(scanned(room, {2.0, 1.5, 0.4})).empty());
}

TEST(GlobalSearchInACorridor, WhereNoEndIsInReachManyPlacesAreCandidates) {
  const LandmarkMap map(test::outline({{0, 0}, {30, 0}, {30, 2}, {0, 2}}));
  const sensors::Rig rig = test::rig_with_range(4.0);
  const DistanceField field(map.surfaces());
  GlobalSearch search(map, field, rig);
  const Pose2 truth{14.0, 0.9, 0.1};
  const auto candidates = search.search(scanned_with_walls(map, truth, rig));
  EXPECT_GT(candidates.size(), 50U);
  const auto nearest = std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
    return distance(a.estimate.pose, truth) < distance(b.estimate.pose, truth);
  });
  EXPECT_LT(distance(nearest->estimate.pose, truth), 0.5);
  // Beams that come back empty say that the ends are far.
  EXPECT_LT(search.log_plausibility(scanned(map, truth, rig), {1.5, 0.9, 0.1}),
            search.log_plausibility(scanned(map, truth, rig), truth) - 2.0);
}

}  // namespace
}  // namespace credo::localization
