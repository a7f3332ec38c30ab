// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/tracker.hpp"

#include <gtest/gtest.h>

#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

TEST(Tracker, FollowsABearingWithoutARange) {
  Tracker tracker;
  const Eigen::Vector2d landmark(4.0, 2.0);
  geometry::Pose2 robot;
  for (int t = 0; t < 12; ++t) {
    const Eigen::Vector2d p = robot.inverse() * landmark;
    const auto step = motion(0.3, 0.0, 5.0);
    follow(tracker, scene({bearing(std::atan2(p.y(), p.x()) / kDegree)}), t == 0 ? std::nullopt : std::optional(step));
    robot = robot * step.pose;
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].hits, 12);
}

TEST(Tracker, FindsTheRangeOfABearingByParallax) {
  Tracker tracker;
  const Eigen::Vector2d landmark(2.0, 2.0);
  double first_sigma = 0.0;
  for (int t = 0; t < 8; ++t) {
    const Eigen::Vector2d p = landmark - Eigen::Vector2d(0.3 * t, 0.0);
    if (t > 0) tracker.predict(motion(0.3, 0.0, 0.0));
    if (t == 1) first_sigma = tracker.tracks()[0].sigma_azimuth;
    if (t > 1) {
      EXPECT_LT(tracker.tracks()[0].sigma_azimuth, 0.5 * first_sigma);
    }
    const Scene seen = scene({bearing(std::atan2(p.y(), p.x()) / kDegree)});
    tracker.associate(seen);
    if (t == 0) {
      ASSERT_TRUE(tracker.start(seen, 0, 0.0, kNoLandmark));
    }
    tracker.update(seen);
  }
  EXPECT_GT(first_sigma, 3.0 * kDegree) << "0.5 m or infinity: nobody knows yet";
  EXPECT_EQ(tracker.tracks()[0].hits, 8);
}

TEST(Tracker, MatchesABearingFromWhereTheCameraIs) {
  Tracker tracker;
  Scene ranged = scene({point(kOther, {2.0, 1.0})});
  ranged.camera_origin = {0.5, 0.0};
  follow(tracker, ranged, motion(0.0, 0.0, 0.0));
  Scene by_camera = scene({bearing(std::atan2(1.0, 1.5) / kDegree), bearing(std::atan2(1.0, 2.0) / kDegree)});
  by_camera.camera_origin = {0.5, 0.0};
  const auto matches = follow(tracker, by_camera, motion(0.0, 0.0, 0.0));
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].primitive, 0);
}

TEST(Tracker, FollowsAWallWhoseVisiblePartChanges) {
  Tracker tracker;  // the middle jumps by metres, the line stays
  follow(tracker, scene({wall(5.0, 2.0, -5.0, 2.0)}), motion(0.0, 0.0, 0.0));
  follow(tracker, scene({wall(4.7, 2.0, 1.0, 2.0)}), motion(0.3, 0.0, 0.0));
  follow(tracker, scene({wall(4.4, 2.0, -3.0, 2.0)}), motion(0.3, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].hits, 3);
}

TEST(Tracker, KeepsParallelWallsApart) {
  Tracker tracker;
  for (int t = 0; t < 4; ++t) {
    follow(tracker, scene({wall(3.0, 1.0, -3.0, 1.0), wall(-3.0, -1.0, 3.0, -1.0), wall(3.0, 1.4, -3.0, 1.4)}),
           motion(0.0, 0.0, 0.0));
  }
  ASSERT_EQ(tracker.tracks().size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(tracker.tracks()[i].primitive, i);
}

TEST(Tracker, KeepsTheWallsBesideADoorApart) {
  Tracker tracker;  // one line, two walls
  const auto motion_between = motion(0.3, 0.0, 0.0);
  for (int t = 0; t < 5; ++t) {
    const double x = -0.3 * t;
    follow(tracker, scene({wall(5.0 + x, 2.0, 2.9 + x, 2.0), wall(2.0 + x, 2.0, -1.0 + x, 2.0)}),
           t == 0 ? std::nullopt : std::optional(motion_between));
  }
  ASSERT_EQ(tracker.tracks().size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(tracker.tracks()[i].primitive, i);
    EXPECT_EQ(tracker.tracks()[i].hits, 5);
  }
}

TEST(Tracker, FollowsAWallThatFallsIntoPiecesAndIsWholeAgain) {
  Tracker tracker;
  follow(tracker, scene({wall(5.0, 2.0, -5.0, 2.0)}), motion(0.0, 0.0, 0.0));
  follow(tracker, scene({wall(5.0, 2.0, 1.0, 2.0), wall(0.0, 2.0, -5.0, 2.0)}), motion(0.0, 0.0, 0.0));
  EXPECT_EQ(tracker.tracks()[0].primitive, 1) << "the longer piece";
  follow(tracker, scene({wall(5.0, 2.0, -5.0, 2.0)}), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].hits, 3);
  EXPECT_EQ(tracker.tracks()[1].misses_in_a_row, 1);
}

TEST(Tracker, FollowsWallsWithoutOdometry) {
  Tracker tracker;  // a corridor, driven at 30 cm a step while turning slowly
  geometry::Pose2 robot;
  const geometry::Segment left{{8.0, 1.0}, {-2.0, 1.0}}, right{{-2.0, -1.0}, {8.0, -1.0}};
  for (int t = 0; t < 10; ++t) {
    const geometry::Pose2 T_base_map = robot.inverse();
    follow(tracker, scene({wall(T_base_map * left), wall(T_base_map * right)}));
    robot = robot * geometry::Pose2{0.3, 0.0, 2.0 * kDegree};
  }
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].hits, 10);
  EXPECT_EQ(tracker.tracks()[1].hits, 10);
}

}  // namespace
}  // namespace credo::tracking
