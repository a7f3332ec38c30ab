// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/changing_fold.hpp"

#include <gtest/gtest.h>

namespace credo::mapping {
namespace {

using evidence::GridMass;

constexpr sensors::Timestamp kSecond = 1'000'000'000, kStart = 1'600'000'000 * kSecond;
constexpr GridMass kSaysEmpty{.empty = 0.855, .occupied = 0.0475, .conflict = 0.0, .unknown = 0.0975};
constexpr GridMass kSaysOccupied{.empty = 0.0475, .occupied = 0.855, .conflict = 0.0, .unknown = 0.0975};

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
  watched.see(kSaysEmpty, 200);
  EXPECT_FALSE(watched.occupied());
  EXPECT_EQ(watched.cell.changes, 0);
  const sensors::Timestamp put_there = watched.now + kSecond;
  watched.see(kSaysOccupied, 3);
  EXPECT_TRUE(watched.occupied());
  EXPECT_EQ(watched.cell.changes, 1);
  EXPECT_EQ(since_when(watched.cell), put_there);
  const sensors::Timestamp taken_away = watched.now + kSecond;
  watched.see(kSaysEmpty, 3);
  EXPECT_FALSE(watched.occupied());
  EXPECT_EQ(watched.cell.changes, 2);
  EXPECT_EQ(since_when(watched.cell), taken_away);
}

TEST(ChangingFold, NoiseIsNoChange) {
  Watched watched;
  watched.see(kSaysOccupied, 20);
  const auto since = since_when(watched.cell);
  for (int i = 0; i < 30; ++i) {
    watched.see(kSaysEmpty, 1);
    EXPECT_GT(changing(watched.cell), 0.5);
    EXPECT_TRUE(watched.occupied());
    watched.see(kSaysOccupied, 3);
    EXPECT_EQ(changing(watched.cell), 0.0);
  }
  EXPECT_EQ(watched.cell.changes, 0);
  EXPECT_EQ(since_when(watched.cell), since);
}

TEST(ChangingFold, EmptyAgesFasterThanOccupied) {
  Watched empty, occupied;
  empty.see(kSaysEmpty, 10);
  occupied.see(kSaysOccupied, 10);
  for (Watched* watched : {&empty, &occupied}) {
    watched->now += 600 * kSecond;
    EXPECT_TRUE(watched->rule.update(watched->cell, GridMass::vacuous(), watched->now));
  }
  EXPECT_NEAR(empty.cell.mass.empty, 0.5, 0.02);
  EXPECT_NEAR(occupied.cell.mass.occupied, 0.89, 0.02);
  EXPECT_FALSE(since_when(empty.cell));
}

TEST(ChangingFold, AnUnseenCellIsInNoState) {
  EXPECT_FALSE(since_when(ChangingFold::Cell{}));
  EXPECT_EQ(ChangingFold{}.masses({}), GridMass::vacuous());
}

}  // namespace
}  // namespace credo::mapping
