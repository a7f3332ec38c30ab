// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/match_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace credo::evaluation {
namespace {

using perception::Primitive;
using perception::PrimitiveType;

/// An L: walls along y = 0 and x = 4, and their corner.
const localization::LandmarkMap& map() {
  static const localization::LandmarkMap value(
      geometry::FloorPlan{.walls = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}}, .verticals = {}});
  return value;
}
const geometry::Pose2 kPose{2.0, 1.0, 0.5};

tracking::LandmarkId corner_id() {
  for (std::size_t i = 0; i < map().points().size(); ++i) {
    if ((map().points()[i].position - Eigen::Vector2d(4, 0)).norm() < 1e-9) return map().point_id(i);
  }
  return tracking::kNoLandmark;
}

Primitive corner_seen(double azimuth_error, double range_error, double sigma_azimuth = 0.002,
                      double sigma_range = 0.01) {
  const Eigen::Vector2d p = kPose.inverse() * Eigen::Vector2d(4, 0);
  Primitive seen;
  seen.type = PrimitiveType::kCorner;
  seen.azimuth = std::atan2(p.y(), p.x()) + azimuth_error;
  seen.sigma_azimuth = sigma_azimuth;
  seen.range_m = p.norm() + range_error;
  seen.sigma_range_m = sigma_range;
  return seen;
}

bool wrong(const Primitive& seen, tracking::LandmarkId id, const Eigen::Vector2d& camera = Eigen::Vector2d::Zero()) {
  return is_wrong_match(seen, camera, map(), id, kPose);
}

TEST(MatchCheck, PointsAreJudgedByAzimuthAndRange) {
  ASSERT_NE(corner_id(), tracking::kNoLandmark);
  EXPECT_FALSE(wrong(corner_seen(0.0, 0.0), corner_id()));
  EXPECT_FALSE(wrong(corner_seen(0.016, 0.09), corner_id()));
  EXPECT_TRUE(wrong(corner_seen(0.019, 0.0), corner_id()));
  EXPECT_TRUE(wrong(corner_seen(0.0, 0.11), corner_id()));
}

TEST(MatchCheck, AnUnsureObservationIsNotWrong) {
  EXPECT_FALSE(wrong(corner_seen(0.019, 0.0, 0.01), corner_id()));
  EXPECT_FALSE(wrong(corner_seen(0.0, 0.3, 0.002, 0.1), corner_id()));
}

TEST(MatchCheck, ABearingStartsAtTheCamera) {
  const Eigen::Vector2d camera{0.0, 0.3}, p = kPose.inverse() * Eigen::Vector2d(4, 0) - camera;
  Primitive seen;
  seen.azimuth = std::atan2(p.y(), p.x());
  seen.sigma_azimuth = 0.001;
  seen.bearing_only = true;
  EXPECT_FALSE(wrong(seen, corner_id(), camera));
  EXPECT_TRUE(wrong(seen, corner_id()));
}

TEST(MatchCheck, WallsAreJudgedByTheirLine) {
  const auto seen = [](double across, double turn) {
    Primitive p;
    p.type = PrimitiveType::kWall;
    p.line.centroid = kPose.inverse() * Eigen::Vector2d(3.0, across);
    p.line.angle = -kPose.theta + turn + std::numbers::pi;
    p.line.sigma_across = 0.005;
    p.line.sigma_angle = 0.002;
    return p;
  };
  for (std::size_t i = 0; i < map().walls().size(); ++i) {
    const bool along_x = std::abs(map().walls()[i].direction.x()) > 0.9;
    EXPECT_EQ(wrong(seen(0.0, 0.0), map().wall_id(i)), !along_x);
    if (!along_x) continue;
    EXPECT_FALSE(wrong(seen(0.09, 0.016), map().wall_id(i)));
    EXPECT_TRUE(wrong(seen(0.11, 0.0), map().wall_id(i)));
    EXPECT_TRUE(wrong(seen(0.0, 0.02), map().wall_id(i)));
  }
}

TEST(MatchCheck, CountsWhatThePoseRestsOn) {
  perception::Scene scene;
  scene.primitives = {corner_seen(0, 0), corner_seen(0.2, 0), corner_seen(0.3, 0)};
  std::vector<localization::Observation> observations(3);
  observations[0].primitive = 0;
  for (int i = 0; i < 3; ++i) {
    observations[static_cast<std::size_t>(i)].primitive = i;
    observations[static_cast<std::size_t>(i)].landmark = corner_id();
  }
  localization::PoseSolution solution;
  solution.outlier = {false, false, true};
  const MatchCounts counts = check_matches(scene, observations, solution, {}, map(), kPose).total();
  EXPECT_EQ(counts.matches, 2);
  EXPECT_EQ(counts.wrong, 1);
  EXPECT_EQ(counts.wrong_share(), 0.5);
}

/// A right match, a wrong one and a wall that is the other one, in this order.
ClassedMatchCounts check_three(std::span<const double> beliefs, const MatchCheckParams& params = {}) {
  perception::Scene scene;
  scene.primitives = {corner_seen(0, 0), corner_seen(0.2, 0), corner_seen(0, 0)};
  scene.primitives[2].line.centroid = kPose.inverse() * Eigen::Vector2d(3.0, 0.0);
  std::vector<localization::Observation> observations(3);
  for (int i = 0; i < 3; ++i) {
    observations[static_cast<std::size_t>(i)].primitive = i;
    observations[static_cast<std::size_t>(i)].landmark = corner_id();
  }
  for (std::size_t i = 0; i < map().walls().size(); ++i)
    if (std::abs(map().walls()[i].direction.y()) > 0.9) observations[2].landmark = map().wall_id(i);
  localization::PoseSolution solution;
  solution.outlier = {false, false, false};
  return check_matches(scene, observations, solution, beliefs, map(), kPose, params);
}

TEST(MatchCheck, CountsByTheBeliefOfTheTracksAndWallsApart) {
  MatchCheckParams params;
  params.classes.point_faults = {{{0.0, {}}, {0.5, {}}, {0.8, {}}}};
  using Classes = std::array<MatchCounts, localization::kFaultClasses>;
  const MatchCounts none, right{.matches = 1, .wrong = 0}, wrong{.matches = 1, .wrong = 1};
  EXPECT_EQ(check_three(std::array{0.9, 0.2, 0.9}, params).classes, (Classes{wrong, none, right, wrong}));
  EXPECT_EQ(check_three(std::array{0.7, 0.8, 0.1}, params).classes, (Classes{none, right, wrong, wrong}));
  EXPECT_EQ(check_three(std::array{0.7, 0.8, 0.1}, params).total(), (MatchCounts{.matches = 3, .wrong = 2}));
}

TEST(MatchCheck, WithoutBeliefsPointsCountAsTheLeastBelieved) {
  EXPECT_EQ(check_three({}).classes.front(), (MatchCounts{.matches = 2, .wrong = 1}));
  EXPECT_EQ(check_three({}).classes.back(), (MatchCounts{.matches = 1, .wrong = 1}));
}

TEST(MatchCheck, ClassesAreCalledByWhereTheirBeliefBegins) {
  localization::IntegrityParams params;
  params.point_faults = {{{0.0, {}}, {0.5, {}}, {0.825, {}}}};
  EXPECT_EQ(fault_class_name(0, params), "points_from_0");
  EXPECT_EQ(fault_class_name(2, params), "points_from_0.825");
  EXPECT_EQ(fault_class_name(localization::kWallFaultClass, params), "walls");
}

TEST(MatchCheck, SumsClassByClass) {
  ClassedMatchCounts sum = check_three({});
  sum += check_three({});
  EXPECT_EQ(sum.classes.front(), (MatchCounts{.matches = 4, .wrong = 2}));
  EXPECT_EQ(sum.total(), (MatchCounts{.matches = 6, .wrong = 4}));
}

TEST(MatchCheck, TheShareOfWrongOnesHasItsInterval) {
  // Clopper and Pearson for 1 of 10: the roots of the binomial tails at 2.5 %.
  const Bounds interval = MatchCounts{.matches = 10, .wrong = 1}.wrong_among_all().interval();
  EXPECT_NEAR(interval.lower, 0.0025, 5e-5);
  EXPECT_NEAR(interval.upper, 0.4450, 5e-5);
}

TEST(MatchCheck, WhatIsMatchedToNoLandmarkIsNoMatch) {
  perception::Scene scene;
  scene.primitives = {corner_seen(0.0, 0.0), corner_seen(0.1, 0.0)};
  std::vector<localization::Observation> observations(3);
  observations[0].primitive = 0;
  observations[0].landmark = corner_id();
  observations[1].primitive = 1;
  observations[1].landmark = corner_id();
  observations[2].landmark = tracking::kNoLandmark;
  localization::PoseSolution solution;
  solution.outlier = {false, false, false};
  const MatchCounts counts = check_matches(scene, observations, solution, {}, map(), kPose).total();
  EXPECT_EQ(counts.matches, 2);
  EXPECT_EQ(counts.wrong, 1);
}

}  // namespace
}  // namespace credo::evaluation
