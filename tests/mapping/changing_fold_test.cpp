// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/changing_fold.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace credo::mapping {
namespace {

using evidence::GridMass;

constexpr sensors::Timestamp kSecond = 1'000'000'000, kStart = 1'600'000'000 * kSecond;
constexpr GridMass kBeamSaysEmpty{.empty = 0.855, .occupied = 0.0475, .conflict = 0.0, .unknown = 0.0975};
constexpr GridMass kBeamSaysOccupied{.empty = 0.0475, .occupied = 0.855, .conflict = 0.0, .unknown = 0.0975};

struct Watched {
  ChangingFold rule;
  ChangingFold::Cell cell;
  sensors::Timestamp now = kStart;

  void see(const GridMass& reading, int times) {
    for (int i = 0; i < times; ++i) {
      now += kSecond;
      EXPECT_TRUE(rule.update(cell, reading, now));
    }
  }
  [[nodiscard]] bool occupied() const { return cell.mass.occupied > cell.mass.empty; }
};

TEST(ChangingFold, FollowsAChangeInThreeReadingsAndKnowsSinceWhen) {
  Watched watched;
  watched.see(kBeamSaysEmpty, 200);
  EXPECT_FALSE(watched.occupied());
  EXPECT_EQ(watched.cell.changes, 0);
  const sensors::Timestamp put_there = watched.now + kSecond;
  watched.see(kBeamSaysOccupied, 3);
  EXPECT_TRUE(watched.occupied());
  EXPECT_EQ(since_when(watched.cell), put_there);
  EXPECT_EQ(watched.cell.changes, 0);  // not confirmed yet
  watched.see(kBeamSaysOccupied, 5);
  EXPECT_EQ(watched.cell.changes, 1);
  const sensors::Timestamp taken_away = watched.now + kSecond;
  watched.see(kBeamSaysEmpty, 3);
  EXPECT_FALSE(watched.occupied());
  EXPECT_EQ(since_when(watched.cell), taken_away);
  watched.see(kBeamSaysEmpty, 5);
  EXPECT_EQ(watched.cell.changes, 2);
}

TEST(ChangingFold, WhatGoesBackAtOnceHasNotChanged) {
  Watched watched;
  watched.see(kBeamSaysEmpty, 20);
  const auto since = since_when(watched.cell);
  for (int i = 0; i < 10; ++i) {
    watched.see(kBeamSaysOccupied, 4);
    EXPECT_TRUE(watched.occupied());
    watched.see(kBeamSaysEmpty, 10);
    EXPECT_FALSE(watched.occupied());
    EXPECT_EQ(watched.cell.changes, 0);
    EXPECT_EQ(since_when(watched.cell), since);
  }
}

TEST(ChangingFold, NoiseIsNoChange) {
  Watched watched;
  watched.see(kBeamSaysOccupied, 20);
  const auto since = since_when(watched.cell);
  for (int i = 0; i < 30; ++i) {
    watched.see(kBeamSaysEmpty, 1);
    EXPECT_GT(changing(watched.cell), 0.5);
    EXPECT_TRUE(watched.occupied());
    watched.see(kBeamSaysOccupied, 3);
    EXPECT_EQ(changing(watched.cell), 0.0);
  }
  EXPECT_EQ(watched.cell.changes, 0);
  EXPECT_EQ(since_when(watched.cell), since);
}

TEST(ChangingFold, EmptyAgesFasterThanOccupied) {
  Watched empty, occupied;
  empty.see(kBeamSaysEmpty, 10);
  occupied.see(kBeamSaysOccupied, 10);
  for (Watched* watched : {&empty, &occupied}) {
    watched->now += 600 * kSecond;
    EXPECT_TRUE(watched->rule.update(watched->cell, GridMass::vacuous(), watched->now));
  }
  EXPECT_NEAR(empty.cell.mass.empty, 0.5, 0.02);
  EXPECT_NEAR(occupied.cell.mass.occupied, 0.89, 0.02);
  EXPECT_FALSE(since_when(empty.cell));
}

TEST(ChangingFold, AContradictionOfLongAgoSaysNothingTogetherWithOneOfNow) {
  Watched watched;
  watched.see(kBeamSaysOccupied, 10);
  watched.see(kBeamSaysEmpty, 1);
  watched.now += 24 * 3600 * kSecond;
  watched.see(kBeamSaysEmpty, 1);
  EXPECT_FALSE(since_when(watched.cell));  // it may be anything by now
  EXPECT_EQ(watched.cell.changes, 0);
  watched.see(kBeamSaysEmpty, 2);
  EXPECT_GE(since_when(watched.cell).value_or(0), watched.now - 2 * kSecond);
  watched.see(kBeamSaysEmpty, 5);
  EXPECT_EQ(watched.cell.changes, 1);
}

TEST(ChangingFold, WhatIsSeenAgainAfterHoursIsWhatIsSeen) {
  for (const bool same : {true, false}) {
    Watched watched;
    watched.see(kBeamSaysEmpty, 10);
    watched.see(kBeamSaysOccupied, 1);
    watched.now += 4 * 3600 * kSecond;
    watched.see(same ? kBeamSaysEmpty : kBeamSaysOccupied, 1);
    EXPECT_EQ(watched.occupied(), !same);
    EXPECT_GT(std::max(watched.cell.mass.empty, watched.cell.mass.occupied), 0.8);
    watched.see(same ? kBeamSaysEmpty : kBeamSaysOccupied, 7);
    EXPECT_EQ(watched.cell.changes, same ? 0 : 1);
    EXPECT_TRUE(since_when(watched.cell));
  }
}

/// A cell at the edge of something is seen both ways for ever.
TEST(ChangingFold, WhatFlickersIsInNoStateInTheEnd) {
  Watched watched;
  watched.see(kBeamSaysEmpty, 10);
  for (int i = 0; i < 2000; ++i) watched.see(i % 2 == 0 ? kBeamSaysOccupied : kBeamSaysEmpty, 1);
  const GridMass& mass = watched.cell.mass;
  EXPECT_NEAR(mass.empty + mass.occupied + mass.unknown, 1.0, 1e-9);
  EXPECT_LE(watched.cell.changes, 2);
}

/// As a sonar's, or a laser's from far away.
TEST(ChangingFold, WeakReadingsAddUpToAChange) {
  constexpr GridMass kHardlyEmpty{.empty = 0.4, .occupied = 0.02, .conflict = 0.0, .unknown = 0.58};
  constexpr GridMass kHardlyOccupied{.empty = 0.02, .occupied = 0.4, .conflict = 0.0, .unknown = 0.58};
  Watched watched;
  watched.see(kHardlyEmpty, 30);
  ASSERT_TRUE(since_when(watched.cell));
  const sensors::Timestamp put_there = watched.now + kSecond;
  watched.see(kHardlyOccupied, 10);
  EXPECT_TRUE(watched.occupied());
  EXPECT_EQ(since_when(watched.cell), put_there);
  watched.see(kHardlyOccupied, 5);
  EXPECT_EQ(watched.cell.changes, 1);
}

TEST(ChangingFold, TimeMayBeginAtZero) {
  Watched watched;
  watched.now = -kSecond;  // the first reading is of time 0
  watched.see(kBeamSaysEmpty, 1);
  watched.now += 24 * 3600 * kSecond;
  EXPECT_TRUE(watched.rule.update(watched.cell, GridMass::vacuous(), watched.now));
  EXPECT_LT(watched.cell.mass.empty, 0.01);
}

TEST(ChangingFold, AReadingThatIsConflictAloneLeavesACellAsItWas) {
  for (const int times : {1, 10}) {  // in no state, and settled
    Watched watched;
    watched.see(kBeamSaysEmpty, times);
    const ChangingFold::Cell before = watched.cell;
    EXPECT_FALSE(watched.rule.update(watched.cell, {.empty = 0.0, .occupied = 0.0, .conflict = 1.0, .unknown = 0.0},
                                     watched.now + 3600 * kSecond));
    EXPECT_EQ(watched.cell.mass, before.mass);
    EXPECT_EQ(watched.cell.seen, before.seen);
    EXPECT_EQ(watched.cell.settled, before.settled);
  }
}

TEST(ChangingFold, AnUnseenCellIsInNoState) {
  EXPECT_FALSE(since_when(ChangingFold::Cell{}));
  EXPECT_EQ(ChangingFold{}.masses({}), GridMass::vacuous());
}

}  // namespace
}  // namespace credo::mapping
