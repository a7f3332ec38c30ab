// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/track_life.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/evaluation/drives.hpp"

namespace credo::evaluation {
namespace {

using perception::PrimitiveType;
using test::moments_of;
using test::seen;
using tracking::TrackState;

constexpr PrimitiveType kEdge = PrimitiveType::kEdge, kWall = PrimitiveType::kWall;

/// Clerentin et al., sec. 5, fig. 21: given with (.5, 0, .5), tracked until acquisition 7, lost at 12. The primitive is
/// edge 7 of their table 1.
TEST(TrackLife, OfFigure21EndsAtAcquisitionTwelve) {
  std::vector<results::TrackSample> samples{seen(kEdge, {.yes = 0.5, .no = 0.0, .unknown = 0.5})};
  constexpr evidence::BinaryMass kPrimitive{.yes = 0.33, .no = 0.25, .unknown = 0.42};
  while (samples.size() < 7)
    samples.push_back(seen(kEdge, evidence::update_track(samples.back().existence, kPrimitive, 0.8)->mass));
  for (auto miss = evidence::miss_track(samples.back().existence); miss->keep;
       miss = evidence::miss_track(samples.back().existence)) {
    samples.push_back(seen(kEdge, miss->mass));
    samples.back().state = TrackState::kMissed;
  }
  const std::vector<TrackLife> lives = track_lives(moments_of(samples, 20));
  ASSERT_EQ(lives.size(), 1U);
  const TrackLife& life = lives.front();
  ASSERT_TRUE(life.lost_with);
  EXPECT_EQ(life.sightings(), 7);
  EXPECT_EQ(life.last_seen() + 1, 7U);
  EXPECT_EQ(life.until_lost(), 5);
  EXPECT_EQ(life.with_loss().size(), 12U);
  EXPECT_GT(life.lost_with->no, life.lost_with->yes);
}

TEST(TrackLife, ATrackThatOutlivesTheDriveIsNotLost) {
  const std::vector<results::TrackSample> samples(4, seen(kEdge, {.yes = 0.2, .no = 0.19, .unknown = 0.61}));
  const std::vector<TrackLife> lives = track_lives(moments_of(samples, 4));
  ASSERT_EQ(lives.size(), 1U);
  EXPECT_FALSE(lives.front().lost_with);
  EXPECT_EQ(lives.front().with_loss().size(), 4U);
}

TEST(TrackLife, ATrackThatASightingDeniesIsNotLostByAMiss) {
  const std::vector<results::TrackSample> samples(2, seen(kEdge, {.yes = 0.9, .no = 0.0, .unknown = 0.1}));
  EXPECT_FALSE(track_lives(moments_of(samples, 3)).front().lost_with);
}

TEST(TrackLife, IsAWallBetweenOnlyAfterAndBeforeAJunction) {
  struct Case {
    std::vector<PrimitiveType> types;
    bool between;
  };
  const PrimitiveType kCorner = PrimitiveType::kCorner;
  for (const Case& c : {Case{{kEdge, kWall, kWall, kEdge}, true},
                        {{kEdge, kEdge}, false},
                        {{kEdge, kWall, kWall}, false},
                        {{kWall, kEdge, kWall}, false},
                        {{kWall, kCorner, kWall, kEdge}, true},
                        {{kEdge, kCorner, kEdge}, false}}) {
    TrackLife life;
    for (const PrimitiveType type : c.types)
      life.samples.push_back(seen(type, {.yes = 1.0, .no = 0.0, .unknown = 0.0}));
    EXPECT_EQ(life.was_wall_between(), c.between) << c.types.size() << " sightings";
  }
}

}  // namespace
}  // namespace credo::evaluation
