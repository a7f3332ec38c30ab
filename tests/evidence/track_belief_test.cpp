// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/track_belief.hpp"

#include <gtest/gtest.h>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

constexpr TrackBeliefParams kDempster{.rule = FusionRule::kDempster};

// Misses until NO exceeds YES; -1 where 1000 are not enough.
int misses_survived_by(BinaryMass track, const TrackBeliefParams& params) {
  for (int miss = 1; miss <= 1000; ++miss) {
    const auto belief = miss_track(track, params);
    if (!belief->keep) return miss;
    track = belief->mass;
  }
  return -1;
}

struct LifeCase {
  double yes;
  int dempster, to_ignorance;
};
class TrackLife : public ::testing::TestWithParam<LifeCase> {};

TEST_P(TrackLife, EndsAfterSoManyMisses) {
  const auto& [yes, dempster, to_ignorance] = GetParam();
  const BinaryMass track = BinaryMass::from(yes, 0.0);
  EXPECT_EQ(misses_survived_by(track, kDempster), dempster);
  EXPECT_EQ(misses_survived_by(track, {}), to_ignorance);
}
INSTANTIATE_TEST_SUITE_P(Beliefs, TrackLife,
                         ::testing::Values(LifeCase{.50, 4, 3}, LifeCase{.60, 5, 4}, LifeCase{.65, 5, 4},
                                           LifeCase{.70, 6, 4}, LifeCase{.75, 7, 5}, LifeCase{.80, 8, 5},
                                           LifeCase{.85, 9, 5}, LifeCase{.90, 11, 5}, LifeCase{.95, 14, 6},
                                           LifeCase{.99, 21, 6}, LifeCase{1.0, -1, 6}));

// Clerentin et al., fig. 21: matched by hand with (.5, 0, .5), tracked until acquisition 7, lost at 12. With the masses
// of their table 1 and any quality of the match.
int acquisition_of_loss(const BinaryMass& observation, double match_yes, const TrackBeliefParams& params) {
  BinaryMass track{.yes = .5, .no = 0.0, .unknown = .5};
  for (int acquisition = 1; acquisition <= 7; ++acquisition) {
    track = update_track(track, observation, match_yes, params)->mass;
  }
  return 7 + misses_survived_by(track, params);
}

TEST(TrackBelief, ALostTrackDiesAsPublishedWithConflictToIgnorance) {
  int as_published = 0, earliest = 99, latest = 0, earliest_dempster = 99;
  for (const BinaryMass& observation :
       {BinaryMass::from(.72, .08), BinaryMass::from(.33, .25), BinaryMass::from(.70, .03), BinaryMass::from(.64, .16),
        BinaryMass::from(.2, .1)}) {
    for (const double match_yes : {.3, .5, .8, .9}) {
      const int lost = acquisition_of_loss(observation, match_yes, {});
      as_published += lost == 12;
      earliest = std::min(earliest, lost);
      latest = std::max(latest, lost);
      const int dempster = acquisition_of_loss(observation, match_yes, kDempster);
      if (dempster > 7) earliest_dempster = std::min(earliest_dempster, dempster);
    }
  }
  EXPECT_EQ(as_published, 12);
  EXPECT_EQ(earliest, 11);
  EXPECT_EQ(latest, 13);
  EXPECT_GE(earliest_dempster, 24);
}

TEST(TrackBelief, AnObservationThatDeniesItselfWeighsLess) {
  EXPECT_LT(distance(discount_by_own_denial({.6, .3, .1}), {.42, .21, .37}), 1e-15);
  EXPECT_EQ(discount_by_own_denial({0.0, .9, .1}), (BinaryMass{0.0, .9, .1}));
  EXPECT_EQ(discount_by_own_denial({.8, 0.0, .2}), (BinaryMass{.8, 0.0, .2}));
}

TEST(TrackBelief, AStartFusesObservationAndMatch) {
  const auto start = start_track({.6, .3, .1}, .8);
  ASSERT_TRUE(start);
  EXPECT_LT(distance(start->mass, {.8 * .79 + .2 * .42, .2 * .21, .37 * .2 + .8 * .21}), 1e-15);
  EXPECT_NEAR(start->conflict, .8 * .21, 1e-15);
  EXPECT_TRUE(start->keep);
  EXPECT_FALSE(start_track({0.0, .9, .1}, .02)->keep);
}

// An update is one fusion of three sources, not two of two.
TEST(TrackBelief, AnUpdateMovesTheConflictOnce) {
  const BinaryMass track{.5, .4, .1}, observation{.5, .2, .3};
  const auto update = update_track(track, observation, .5);
  ASSERT_TRUE(update);
  const auto folded = miss_track(start_track(observation, .5)->mass, {.miss = track});
  EXPECT_GT(distance(update->mass, folded->mass), .01);
  const FusedBinaryMass expected =
      conflict_to_ignorance({discount_by_own_denial(observation), match_support(.5), track});
  EXPECT_LT(distance(update->mass, expected.mass), 1e-15);
  EXPECT_NEAR(update->conflict, expected.conflict, 1e-15);
}

// .2 of YES against .2 of NO, up to rounding: equality keeps.
TEST(TrackBelief, EqualityKeepsTheTrack) {
  const auto belief = miss_track({.2, 0.0, .8});
  ASSERT_TRUE(belief);
  EXPECT_NEAR(belief->mass.yes, belief->mass.no, 1e-15);
  EXPECT_TRUE(belief->keep);
  EXPECT_FALSE(miss_track({.2 - 1e-9, 0.0, .8 + 1e-9})->keep);
}

TEST(TrackBelief, TotalConflictIsReportedNotDivided) {
  EXPECT_FALSE(update_track({0.0, 1.0, 0.0}, {.5, 0.0, .5}, 1.0, kDempster));
  const auto moved = update_track({0.0, 1.0, 0.0}, {.5, 0.0, .5}, 1.0);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->mass, BinaryMass::vacuous());
  EXPECT_TRUE(moved->keep);
}

RC_GTEST_PROP(TrackBeliefLaws, NoTrackOutlivesSixMisses, (const BinaryMass& track)) {
  const int survived = misses_survived_by(track, {});
  RC_ASSERT(survived >= 1 && survived <= 6);
}

}  // namespace
}  // namespace credo::evidence
