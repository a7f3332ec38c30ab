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
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr auto kCorner = PrimitiveType::kCorner;
constexpr auto kEdge = PrimitiveType::kEdge;
constexpr auto kOther = PrimitiveType::kOther;

// ---------------------------------------------------------------------------------------------- one landmark

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

// ---------------------------------------------------------------------------------------------- several landmarks

TEST(Tracker, KeepsTracksApartWhoseAzimuthsCross) {
  // A near landmark overtakes a far one; ranges tell them apart where azimuths do not.
  Tracker tracker;
  std::vector<int> order;
  for (int t = 0; t < 14; ++t) {
    const Eigen::Vector2d near(3.1 - 0.3 * t, 1.0), far(7.1 - 0.3 * t, 5.0);
    follow(tracker, scene({point(kEdge, near), point(kEdge, far)}),
           t == 0 ? std::nullopt : std::optional(motion(0.3, 0.0, 0.0)));
  }
  ASSERT_EQ(tracker.tracks().size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(tracker.tracks()[i].id, i);
    EXPECT_EQ(tracker.tracks()[i].primitive, i);
    EXPECT_EQ(tracker.tracks()[i].hits, 14);
  }
}

TEST(Tracker, GivesOnePrimitiveToOneTrackOnly) {
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    Tracker tracker(params);
    for (int t = 0; t < 4; ++t) follow(tracker, scene({at(kEdge, 10.0), at(kEdge, 13.0)}), motion(0.0, 0.0, 0.0));
    const auto matches = follow(tracker, scene({at(kEdge, 10.1)}), motion(0.0, 0.0, 0.0));
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_EQ(matches[0].track, 0);
    EXPECT_EQ(tracker.tracks()[1].misses_in_a_row, 1);
  }
}

TEST(Tracker, TakesTheNearerOfTwoPrimitives) {
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    Tracker tracker(params);
    for (int t = 0; t < 4; ++t) follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
    tracker.predict(motion(0.0, 0.0, 0.0));
    const Scene seen = scene({at(kEdge, 12.0), at(kEdge, 10.2)});
    const auto& matches = tracker.associate(seen);
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_EQ(matches[0].primitive, 1);
    EXPECT_THAT(tracker.appeared(), ElementsAre(0));
  }
}

TEST(Tracker, IsUndecidedBetweenEqualPrimitivesTwiceAtMost) {
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
  const auto before = tracker.tracks()[0].existence;
  const Scene pair = scene({at(kEdge, 9.5), at(kEdge, 10.5)});
  for (int t = 0; t < 2; ++t) {
    EXPECT_THAT(follow(tracker, pair, motion(0.0, 0.0, 0.0)), IsEmpty());
    ASSERT_EQ(tracker.tracks().size(), 1u) << "what the track may own has not appeared";
    EXPECT_EQ(tracker.tracks()[0].state, TrackState::kUndecided);
    EXPECT_EQ(tracker.tracks()[0].existence, before);
    EXPECT_EQ(tracker.tracks()[0].misses_in_a_row, 0);
  }
  follow(tracker, pair, motion(0.0, 0.0, 0.0));
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::kMissed);
  EXPECT_EQ(tracker.tracks()[0].misses_in_a_row, 1);
  EXPECT_EQ(tracker.tracks().size(), 3u) << "now they have";
}

TEST(Tracker, TellsAPairOfLandmarksApartThatTheRowsAloneWouldNot) {
  // Both have moved by half their distance: to the second track both are equally near, to the pair they are not.
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 10.0), at(kEdge, 11.0)}), motion(0.0, 0.0, 0.0));
  const auto matches = follow(tracker, scene({at(kEdge, 10.5), at(kEdge, 11.5)}), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(matches.size(), 2u);
  for (const Match& match : matches) EXPECT_EQ(match.track, match.primitive);
}

TEST(Tracker, WithholdsAPrimitiveThatTwoTracksClaimAlike) {
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 9.5), at(kEdge, 10.5)}), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 2u);
  const Scene one = scene({at(kEdge, 10.0)});
  for (int t = 0; t < 2; ++t) {
    follow(tracker, one, motion(0.0, 0.0, 0.0));
    EXPECT_EQ(tracker.tracks()[0].state, TrackState::kUndecided);
    EXPECT_EQ(tracker.tracks()[1].state, TrackState::kUndecided);
  }
  follow(tracker, one, motion(0.0, 0.0, 0.0));  // the assignment decides in the end, and starts no third
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_NE(tracker.tracks()[0].state, TrackState::kUndecided);
  EXPECT_NE(tracker.tracks()[0].state, tracker.tracks()[1].state);
}

TEST(Tracker, KeepsTheMassAtTotalConflict) {
  TrackerParams params;
  params.association.sigmas = {.max_yes = 1.0,
                               .yes_full_until = 2.0,
                               .yes_zero_from = 3.0,
                               .max_no = 1.0,
                               .no_zero_until = 3.0,
                               .no_full_from = 6.0};
  Tracker tracker(params);
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 10.0)}), motion(0.0, 0.0, 0.0));
  const auto before = tracker.tracks()[0].existence;
  follow(tracker, scene({at(kEdge, 9.9), at(kEdge, 10.1)}), motion(0.0, 0.0, 0.0));
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::kUndecided);
  EXPECT_EQ(tracker.tracks()[0].existence, before);
}

// ---------------------------------------------------------------------------------------------- types

TEST(Tracker, SurvivesAnErrorOfType) {
  Tracker tracker;
  for (const auto type : {kCorner, kCorner, kOther, kCorner, kEdge, kCorner}) {
    follow(tracker, scene({at(type, 30.0)}), motion(0.0, 0.0, 0.0));
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].type, kCorner);
  EXPECT_EQ(tracker.tracks()[0].hits, 6);
}

TEST(Tracker, ChangesItsTypeAfterTwoSightingsInARow) {
  Tracker tracker;
  for (const auto type : {kCorner, kEdge, kEdge}) follow(tracker, scene({at(type, 30.0)}), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].type, kEdge);
}

TEST(Tracker, PrefersThePrimitiveOfItsOwnType) {
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kCorner, 30.0)}), motion(0.0, 0.0, 0.0));
  const auto matches = follow(tracker, scene({at(kOther, 30.2), at(kCorner, 29.7)}), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].primitive, 1);
}

TEST(Tracker, NeverCrossesTypesUnderThePapersMethod) {
  Tracker tracker(paper());
  follow(tracker, scene({at(kCorner, 30.0)}));
  EXPECT_THAT(follow(tracker, scene({at(kEdge, 30.0)})), IsEmpty());
  EXPECT_EQ(tracker.tracks().size(), 2u);
}

TEST(Tracker, TellsLinesOfOppositePolarityApart) {
  // The two sides of a door post, midway between the predictions: only the polarity says which is which.
  const auto post = [](double first, double second) {
    Scene s = scene({bearing(first), bearing(second)});
    s.radial_lines.resize(2);
    s.radial_lines[0].polarity = 1, s.radial_lines[1].polarity = -1;
    s.primitives[0].radial_line = 0, s.primitives[1].radial_line = 1;
    return s;
  };
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, post(10.0, 11.5), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 2u);
  Scene one = post(10.75, 11.5);
  one.primitives.pop_back();
  const auto matches = follow(tracker, one, motion(0.0, 0.0, 0.0));
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].track, 0);
}

// ------------------------------------------------------------------------------------------ bearings without a range

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

// ---------------------------------------------------------------------------------------------- walls

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

// ---------------------------------------------------------------------------------------------- life

TEST(Tracker, DiesAtTheFifthOrSixthMiss) {
  // Clerentin et al., fig. 21: tracked until acquisition 7, lost at 12. Masses as in their table 1.
  for (const double yes : {0.72, 0.70, 0.64}) {
    Tracker tracker(paper());
    Scene seen = scene({at(kEdge, 30.0)});
    seen.primitives[0].existence = evidence::BinaryMass::from(yes, 0.08);
    tracker.predict(std::nullopt);
    tracker.associate(seen);
    tracker.start_given(seen, 0, 6);
    tracker.update(seen);
    for (int t = 2; t <= 7; ++t) follow(tracker, seen);
    int misses = 0;
    while (!tracker.tracks().empty()) {
      follow(tracker, scene({}));
      ASSERT_LE(++misses, 6);
    }
    EXPECT_GE(misses, 5);
  }
}

TEST(Tracker, OutlivesManyMissesUnderDempstersRule) {
  TrackerParams params = paper();
  params.belief.rule = evidence::FusionRule::kDempster;
  Tracker tracker(params);
  for (int t = 0; t < 8; ++t) follow(tracker, scene({at(kEdge, 30.0)}), std::nullopt, 0.8);
  for (int t = 0; t < 6; ++t) follow(tracker, scene({}));
  EXPECT_EQ(tracker.tracks().size(), 1u);
}

TEST(Tracker, ComesBackAfterATemporaryDisappearance) {
  for (const TrackerParams& params : {TrackerParams{}, paper()}) {
    Tracker tracker(params);
    for (int t = 0; t < 5; ++t) follow(tracker, scene({at(kEdge, 30.0 + t)}));
    follow(tracker, scene({}));
    EXPECT_EQ(tracker.tracks()[0].state, TrackState::kMissed);
    EXPECT_EQ(tracker.tracks()[0].primitive, -1);
    EXPECT_EQ(tracker.tracks()[0].last_seen_time, 0);
    EXPECT_NEAR(tracker.tracks()[0].azimuth, 35.0 * kDegree, 1e-9) << "predicted while missed";
    follow(tracker, scene({}));
    follow(tracker, scene({at(kEdge, 37.0)}));
    ASSERT_EQ(tracker.tracks().size(), 1u);
    EXPECT_EQ(tracker.tracks()[0].state, TrackState::kTracked);
    EXPECT_EQ(tracker.tracks()[0].hits, 6);
  }
}

TEST(Tracker, NeverUsesAnIdAgain) {
  Tracker tracker;
  follow(tracker, scene({at(kEdge, 30.0)}));
  for (int t = 0; t < 10; ++t) follow(tracker, scene({}));
  ASSERT_THAT(tracker.tracks(), IsEmpty());
  follow(tracker, scene({at(kEdge, 30.0)}));
  EXPECT_EQ(tracker.tracks()[0].id, 1);
}

TEST(Tracker, StartsNoTrackWithWhatIsBelievedNotToBe) {
  Tracker tracker;
  Scene seen = scene({at(kEdge, 30.0), at(kEdge, 60.0), at(kEdge, 90.0)});
  seen.primitives[0].existence = {.yes = 0.1, .no = 0.6, .unknown = 0.3};
  seen.primitives[1].existence = {.yes = 0.3, .no = 0.3, .unknown = 0.4};
  tracker.predict(std::nullopt);
  tracker.associate(seen);
  EXPECT_EQ(tracker.start(seen, 0, 0.0, 7), std::nullopt);
  EXPECT_EQ(tracker.start(seen, 1, 0.0, 8), 0) << "equality is not against it";
  EXPECT_EQ(tracker.start(seen, 2, 0.9, 9), 1);
  EXPECT_THAT(tracker.appeared(), ElementsAre(0, 1, 2)) << "it may be gone through while tracks are started";
  tracker.update(seen);
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].landmark, 8);
  EXPECT_EQ(tracker.tracks()[1].landmark, 9);
}

TEST(Tracker, StartsWithTheFusionOfPrimitiveAndMatch) {
  Tracker tracker;
  Scene seen = scene({at(kEdge, 30.0)});
  seen.primitives[0].existence = {.yes = 0.5, .no = 0.2, .unknown = 0.3};
  tracker.predict(std::nullopt);
  tracker.associate(seen);
  ASSERT_TRUE(tracker.start(seen, 0, 0.6, 3));
  // Reliability 0.8: (0.4, 0.16, 0.44) with (0.6, 0, 0.4); conflict 0.096 to ignorance.
  EXPECT_NEAR(tracker.tracks()[0].existence.yes, 0.4 * 1.0 + 0.44 * 0.6, 1e-12);
  EXPECT_NEAR(tracker.tracks()[0].existence.no, 0.16 * 0.4, 1e-12);
}

TEST(Tracker, CarriesTheLandmarkItIsHanded) {
  Tracker tracker;
  const Scene seen = scene({at(kEdge, 30.0)});
  tracker.predict(std::nullopt);
  tracker.associate(seen);
  EXPECT_EQ(tracker.start_given(seen, 0, 12), 0);
  EXPECT_EQ(tracker.tracks()[0].existence, (evidence::BinaryMass{0.5, 0.0, 0.5}));
  tracker.update(seen);
  follow(tracker, seen);
  EXPECT_EQ(tracker.tracks()[0].landmark, 12);
  tracker.relabel(0, 13);
  EXPECT_EQ(tracker.tracks()[0].landmark, 13);
  tracker.relabel(0, kNoLandmark);
  EXPECT_EQ(tracker.tracks()[0].landmark, kNoLandmark);
}

TEST(Tracker, BelievesAConfirmedTrackMore) {
  Tracker tracker;
  follow(tracker, scene({at(kEdge, 30.0)}), std::nullopt, 0.0);
  const double before = tracker.tracks()[0].existence.yes;
  follow(tracker, scene({at(kEdge, 30.0)}), std::nullopt, 0.0);
  EXPECT_GT(tracker.tracks()[0].existence.yes, before);
}

TEST(Tracker, DoesNotMissWhatABlindSensorCannotSee) {
  Tracker tracker;
  for (int t = 0; t < 3; ++t) follow(tracker, scene({at(kEdge, 30.0), bearing(80.0)}));
  Scene without_range_finder = scene({bearing(80.0)});
  without_range_finder.range_finder_seen = false;
  follow(tracker, without_range_finder);
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::kUndecided);
  EXPECT_EQ(tracker.tracks()[1].state, TrackState::kTracked);
  Scene without_camera = scene({at(kEdge, 30.0)});
  without_camera.camera_seen = false;
  follow(tracker, without_camera);
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::kTracked);
  EXPECT_EQ(tracker.tracks()[1].state, TrackState::kUndecided);
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
