// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/continuity.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace credo::localization {
namespace {

class Followed : public ::testing::Test {
 protected:
  Followed() { scene.camera_seen = scene.range_finder_seen = true; }

  /// The next scene: so many tracks were seen in the one before, and so many of them go on.
  bool breaks_off(int followed, int gone_on) {
    constexpr int kMissed = 5;  // tracks that were not seen in the scene before, and are seen again
    std::vector<tracking::Track> tracks(static_cast<std::size_t>(followed + kMissed));
    std::vector<tracking::Match> matches;
    for (int t = 0; t < followed + kMissed; ++t) {
      tracks[static_cast<std::size_t>(t)].last_seen_time = t < followed ? 7 : 3;
      if (t < gone_on || t >= followed) matches.emplace_back().track = t;
    }
    return continuity.breaks_off(scene, tracks, matches, 7);
  }

  perception::Scene scene;
  Continuity continuity;
};

TEST_F(Followed, GoesOnWhileMostTracksDo) {
  for (const int gone_on : {32, 36, 28, 40, 30}) EXPECT_FALSE(breaks_off(40, gone_on)) << gone_on;
}

TEST_F(Followed, BreaksOffWhereFewDoAllAtOnce) {
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(breaks_off(40, 32));
  EXPECT_TRUE(breaks_off(40, 16));
}

TEST_F(Followed, MayUsuallyBeShort) {
  for (int gone_on = 32; gone_on >= 16; --gone_on)
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(breaks_off(40, gone_on)) << gone_on;
  EXPECT_TRUE(breaks_off(40, 9));
}

TEST_F(Followed, SaysNothingOfFew) {
  EXPECT_FALSE(breaks_off(9, 0));
  EXPECT_TRUE(breaks_off(10, 0));
}

TEST_F(Followed, SaysNothingWhereAnotherInstrumentSees) {
  EXPECT_FALSE(breaks_off(40, 32));
  scene.camera_seen = false;
  EXPECT_FALSE(breaks_off(40, 5));
  EXPECT_TRUE(breaks_off(40, 5));
  scene.camera_seen = true;
  scene.range_finder_seen = false;  // both at once
  EXPECT_FALSE(breaks_off(40, 0));
  EXPECT_TRUE(breaks_off(40, 0));
}

}  // namespace
}  // namespace credo::localization
