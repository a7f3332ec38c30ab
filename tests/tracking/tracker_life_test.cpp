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

}  // namespace
}  // namespace credo::tracking
