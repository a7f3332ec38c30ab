// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/tracker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

}  // namespace
}  // namespace credo::tracking
