// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/tracker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using ::testing::IsEmpty;

TEST(Tracker, FollowsAConstantChangeOfAzimuth) {
  // The first step of a track is predicted without a rate: the paper's breakpoints let it be no more than 2.2 degrees.
  for (const auto& [params, rate] : {std::pair(TrackerParams{}, 8.0), std::pair(paper(), 2.0)}) {
    Tracker tracker(params);
    for (int t = 0; t < 10; ++t) follow(tracker, scene({at(kEdge, 20.0 + rate * t)}));
    ASSERT_EQ(tracker.tracks().size(), 1u);
    EXPECT_EQ(tracker.tracks()[0].id, 0);
    EXPECT_EQ(tracker.tracks()[0].hits, 10);
    EXPECT_EQ(tracker.tracks()[0].state, TrackState::kTracked);
    EXPECT_EQ(tracker.tracks()[0].primitive, 0);
    EXPECT_NEAR(tracker.tracks()[0].azimuth, (20.0 + 9.0 * rate) * kDegree, 1e-12);
  }
}

TEST(Tracker, FollowsThroughTheWrapAtPi) {
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    Tracker tracker(params);
    for (int t = 0; t < 16; ++t) follow(tracker, scene({at(kCorner, 165.0 + 2.0 * t)}));
    ASSERT_EQ(tracker.tracks().size(), 1u);
    EXPECT_EQ(tracker.tracks()[0].hits, 16);
  }
}

TEST(Tracker, PredictsByTheLineThroughTheLastObservationsUnderThePapersMethod) {
  TrackerParams params = paper();
  params.prediction.observations_paper = 3;
  Tracker tracker(params);
  for (const double azimuth : {10.0, 11.0, 13.0}) follow(tracker, scene({at(kEdge, azimuth)}));
  tracker.predict(std::nullopt);
  EXPECT_NEAR(tracker.tracks()[0].azimuth, (4.0 * 13.0 + 11.0 - 2.0 * 10.0) / 3.0 * kDegree, 1e-12);
}

TEST(Tracker, PredictsByTheMotionWhereThereIsOne) {
  Tracker tracker;
  const Eigen::Vector2d landmark(2.0, 1.0);
  follow(tracker, scene({point(kEdge, landmark)}));
  const auto step = motion(0.5, 0.1, 30.0);
  tracker.predict(step);
  const Eigen::Vector2d expected = step.pose.inverse() * landmark;
  EXPECT_NEAR(tracker.tracks()[0].azimuth, std::atan2(expected.y(), expected.x()), 1e-12);
  EXPECT_GT(tracker.tracks()[0].sigma_azimuth, 0.5 * kDegree);  // the turn alone is only known that well
}

TEST(Tracker, ComposesMotionsOverMissedScenes) {
  Tracker tracker;
  const Eigen::Vector2d landmark(3.0, 1.5);
  follow(tracker, scene({point(kEdge, landmark)}));
  geometry::Pose2 robot;
  for (int t = 0; t < 3; ++t) {
    const auto step = motion(0.3, 0.0, 15.0);
    robot = robot * step.pose;
    follow(tracker, scene({}), step);
  }
  EXPECT_EQ(tracker.tracks()[0].misses_in_a_row, 3);
  robot = robot * motion(0.3, 0.0, 15.0).pose;
  follow(tracker, scene({point(kEdge, robot.inverse() * landmark)}), motion(0.3, 0.0, 15.0));
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].hits, 2);
  EXPECT_EQ(tracker.tracks()[0].misses_in_a_row, 0);
}

TEST(Tracker, SurvivesABigTurnWithOdometryOnly) {
  const auto turn = [](Tracker& tracker, bool with_motion) {
    const Eigen::Vector2d landmark(3.0, 0.5);
    for (int t = 0; t < 4; ++t) {
      const auto rest = with_motion ? std::optional(motion(0.0, 0.0, 0.0)) : std::nullopt;
      follow(tracker, scene({point(kEdge, landmark)}), rest);
    }
    const auto big = motion(0.0, 0.0, 70.0);
    follow(tracker, scene({point(kEdge, big.pose.inverse() * landmark)}),
           with_motion ? std::optional(big) : std::nullopt);
    return tracker.tracks()[0].hits;
  };
  Tracker by_odometry, by_extrapolation(paper());
  EXPECT_EQ(turn(by_odometry, true), 5);
  EXPECT_EQ(turn(by_extrapolation, false), 4);
}

TEST(Tracker, IgnoresTheMotionUnderThePapersMethod) {
  Tracker tracker(paper());
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
  tracker.predict(motion(0.0, 0.0, 70.0));
  EXPECT_NEAR(tracker.tracks()[0].azimuth, 10.0 * kDegree, 1e-12);
}

TEST(Tracker, KeepsALandmarkThatIsPassedCloselyWithoutOdometry) {
  Tracker tracker;  // 1 m aside, 30 cm steps
  for (int t = 0; t < 20; ++t) {
    follow(tracker, scene({point(kEdge, Eigen::Vector2d(3.0 - 0.3 * t, 1.0))}));
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].hits, 20);
}

TEST(Tracker, TakesAnExpectationFromOutsideForItsPrediction) {
  Tracker tracker;
  follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
  tracker.predict(motion(0.0, 0.0, 0.0));
  tracker.expect(0, 40.0 * kDegree, 1.0 * kDegree);
  EXPECT_NEAR(tracker.tracks()[0].azimuth, 40.0 * kDegree, 1e-12);
  const Scene seen = scene({at(kEdge, 39.0), at(kEdge, 10.0)});
  EXPECT_EQ(tracker.associate(seen).at(0).primitive, 0);
}

TEST(Tracker, TakesAnExpectedPositionForItsPrediction) {
  Tracker tracker;
  follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
  tracker.predict(motion(0.0, 0.0, 0.0));
  tracker.expect_point(0, {0.0, 2.0}, 1e-4 * Eigen::Matrix2d::Identity());
  const Scene seen = scene({at(kEdge, 90.0, 2.5), at(kEdge, 90.0, 2.0)});
  EXPECT_EQ(tracker.associate(seen).at(0).primitive, 1);
}

TEST(Tracker, LivesWithEmptyScenes) {
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    Tracker tracker(params);
    for (int t = 0; t < 3; ++t) EXPECT_THAT(follow(tracker, scene({})), IsEmpty());
    EXPECT_THAT(tracker.tracks(), IsEmpty());
    EXPECT_THAT(tracker.appeared(), IsEmpty());
  }
}

TEST(Tracker, GivesTheSameForTheSame) {
  const auto run = [](const TrackerParams& params) {
    Tracker tracker(params);
    std::ostringstream out;
    out.precision(17);
    for (int t = 0; t < 30; ++t) {
      std::vector<Primitive> primitives;
      for (int i = 0; i < 12; ++i) {
        if ((t + i) % 5 != 0)
          primitives.push_back(at(i % 2 ? kEdge : kCorner, 31.0 * i + std::sin(t * (i + 1.0)), 1.0 + 0.4 * i));
      }
      follow(tracker, scene(primitives));
      for (const Track& track : tracker.tracks()) out << track << '\n';
    }
    return out.str();
  };
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    const std::string first = run(params);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, run(params));
  }
}

TEST(Tracker, RefusesParametersOutOfTheirRange) {
  TrackerParams params;
  params.prediction.observations = 0;
  EXPECT_THROW(Tracker{params}, std::invalid_argument);
  params = {};
  params.association.min_margin = 1.0;
  EXPECT_THROW(Tracker{params}, std::invalid_argument);
  params = {};
  params.association.floor_position_m = 0.0;
  EXPECT_THROW(Tracker{params}, std::invalid_argument);
}

TEST(Track, PrintsReadably) {
  Track track;
  track.id = 4;
  track.landmark = 2;
  std::ostringstream out;
  out << track;
  EXPECT_THAT(out.str(), ::testing::HasSubstr("track 4 (other, tracked, azimuth 0 +- 0 deg"));
  EXPECT_THAT(out.str(), ::testing::HasSubstr("landmark 2"));
}

}  // namespace
}  // namespace credo::tracking
