// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// What the forms of a cell do over thousands of updates, in other orders and groupings, and where their range ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "evidence/binary_batch.hpp"
#include "evidence/log_commonality.hpp"
#include "evidence/log_evidence.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

constexpr double kMaxReliability = .99;

// Readings of {empty, occupied} that contradict each other, some with mass on the overlap and some without ignorance.
std::vector<GridMass> readings(int count) {
  std::mt19937 random(31);
  const auto uniform = [&random] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
  std::vector<GridMass> result;
  for (int i = 0; i < count; ++i) {
    const double e = uniform(), o = uniform(), c = i % 3 == 0 ? .1 * uniform() : 0.0, u = i % 5 == 0 ? 0.0 : uniform();
    const double sum = e + o + c + u;
    result.push_back({e / sum, o / sum, c / sum, u / sum});
  }
  return result;
}

// A reading as a mass on "occupied", whose own conflict Dempster's rule divides out.
BinaryMass occupied(const GridMass& reading) {
  const GridMass rest = *without_conflict(discount(reading, kMaxReliability));
  return {rest.occupied, rest.empty, rest.unknown};
}

TEST(Stability, TwoChannelsAndThreeAgreeOverTenThousandUpdatesInAnyOrder) {
  // Half of them say the opposite of the others, and five are left over: the answer is no certainty.
  std::vector<GridMass> all = readings(5'000);
  for (std::size_t i = 0; i < 4'995; ++i) {
    const GridMass mass = all[i];
    all.push_back({mass.occupied, mass.empty, mass.conflict, mass.unknown});
  }
  std::mt19937 random(3);
  for (int order = 0; order < 10; ++order) {
    LogCommonality three;
    LogEvidence two;
    for (const GridMass& reading : all) {
      three += log_commonality(reading, kMaxReliability);
      two += log_evidence(occupied(reading));
    }
    ASSERT_LT(three.unknown, -10'000.0);
    ASSERT_NEAR(pignistic_occupied(three), .5, .499);
    const LogEvidence of_three = log_evidence(three);
    EXPECT_NEAR(two.yes / of_three.yes, 1.0, 1e-12);
    EXPECT_NEAR(two.no / of_three.no, 1.0, 1e-12);
    const GridMass expected = normalised_masses(three);
    EXPECT_LT(distance(normalised_mass(two), BinaryMass{expected.occupied, expected.empty, expected.unknown}), 1e-9);
    EXPECT_NEAR(pignistic(two), pignistic_occupied(three), 1e-9);
    EXPECT_NEAR(plausibility_probability(two), plausibility_probability_occupied(three), 1e-9);
    std::shuffle(all.begin(), all.end(), random);
  }
}

// How many contrary readings it takes until the other side leads, after 200 for one side.
constexpr int kBefore = 200;
constexpr BinaryMass kFor{.65, .05, .30}, kAgainst{.05, .65, .30};

template <typename Update, typename Leads>
int readings_to_flip(Update update, Leads other_leads, int at_most) {
  for (int i = 0; i < kBefore; ++i) update(kFor);
  for (int i = 1; i <= at_most; ++i) {
    update(kAgainst);
    if (other_leads()) return i;
  }
  return at_most + 1;
}

TEST(Stability, LinearMassesInFloatLockAndLogarithmsFlipWhenTheyShould) {
  float yes = 0.0f, no = 0.0f, unknown = 1.0f;
  int updates = 0, until_no_ignorance = 0;
  const auto linear = [&](const BinaryMass& reading) {
    const float other_yes = static_cast<float>(reading.yes), other_no = static_cast<float>(reading.no),
                other_unknown = static_cast<float>(reading.unknown);
    (void)dempster(BinaryCells<float>{{&yes, 1}, {&no, 1}, {&unknown, 1}},
                   BinaryReading<float>{{&other_yes, 1}, {&other_no, 1}, {&other_unknown, 1}});
    ++updates;
    if (unknown == 0.0f && until_no_ignorance == 0) until_no_ignorance = updates;
  };
  EXPECT_EQ(readings_to_flip(
                linear, [&] { return no > yes; }, 5000),
            5001);  // never
  EXPECT_GT(until_no_ignorance, 80);
  EXPECT_LT(until_no_ignorance, 110);
  EXPECT_EQ(yes, 1.0f);

  LogEvidence two;
  EXPECT_EQ(readings_to_flip([&](const BinaryMass& m) { two += log_evidence(m); },
                             [&] { return normalised_mass(two).no > normalised_mass(two).yes + 1e-9; }, 5000),
            kBefore + 1);
  LogEvidenceF narrow;
  EXPECT_EQ(readings_to_flip([&](const BinaryMass& m) { narrow += log_evidence<float>(m); },
                             [&] { return normalised_mass(narrow).no > normalised_mass(narrow).yes + 1e-2; }, 5000),
            kBefore + 1);
  FixedLogCommonality cell;
  EXPECT_EQ(readings_to_flip(
                [&](const BinaryMass& m) {
                  cell += quantise(log_commonality({.empty = m.no, .occupied = m.yes, .unknown = m.unknown}, .999));
                },
                [&] { return pignistic_occupied(cell.value()) < .5 - 1e-9; }, 5000),
            kBefore + 1);
}

std::vector<FixedLogCommonality> increments(const std::vector<GridMass>& all) {
  std::vector<FixedLogCommonality> result;
  for (const GridMass& reading : all) result.push_back(fixed_increment(reading, FixedLogCommonality::kMaxReliability));
  return result;
}

// Cells merged two by two as a random tree: as robots do that exchange maps, none knowing what the others have merged.
FixedLogCommonality merged_in_a_random_tree(std::vector<FixedLogCommonality> cells, std::mt19937& random) {
  while (cells.size() > 1) {
    std::swap(cells[random() % cells.size()], cells.back());
    const FixedLogCommonality taken = cells.back();
    cells.pop_back();
    cells[random() % cells.size()] += taken;
  }
  return cells.front();
}

TEST(Stability, FixedPointIsTheSameBitsInAnyOrderAndAnyGrouping) {
  // Few enough for the range; then so many that the sums end at its floor, where they must agree as well.
  for (const int count : {400, 4000}) {
    std::vector<FixedLogCommonality> all = increments(readings(count));
    FixedLogCommonality expected;
    for (const FixedLogCommonality& increment : all) expected += increment;
    ASSERT_EQ(expected.saturated(), count == 4000);
    std::mt19937 random(17);
    for (int k = 0; k < 100; ++k) {
      std::shuffle(all.begin(), all.end(), random);
      FixedLogCommonality in_order;
      for (const FixedLogCommonality& increment : all) in_order += increment;
      ASSERT_EQ(in_order, expected) << "order " << k << " of " << count;
      ASSERT_EQ(merged_in_a_random_tree(all, random), expected) << "tree " << k << " of " << count;
    }
  }
}

TEST(Stability, FixedPointTellsTheEndOfItsRangeAndOnlyThen) {
  std::mt19937 random(23);
  for (int k = 0; k < 100; ++k) {
    std::vector<FixedLogCommonality> all = increments(readings(3000));
    std::shuffle(all.begin(), all.end(), random);
    FixedLogCommonality cell;
    std::int64_t empty = 0, occupied = 0, unknown = 0;
    for (const FixedLogCommonality& increment : all) {
      cell += increment;
      empty += increment.empty;
      occupied += increment.occupied;
      unknown += increment.unknown;
      const bool beyond = std::min({empty, occupied, unknown}) <= FixedLogCommonality::kFloor;
      ASSERT_EQ(cell.saturated(), beyond);
    }
    ASSERT_TRUE(cell.saturated());
  }
  const double range = -FixedLogCommonality{.unknown = FixedLogCommonality::kFloor}.value().unknown;
  EXPECT_EQ(range, 2048.0);
}

// The strongest update takes ln(1 - r) of the range of 2048, and r is .99 at most.
TEST(Stability, OneUpdateIsBoundedByItsReliability) {
  for (const double reliability : {.5, .9, .99, .999999, 1.0}) {
    const double strongest = std::log1p(-std::min(reliability, .99));
    for (const GridMass& reading : {GridMass{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}) {
      const FixedLogCommonality increment = fixed_increment(reading, reliability);
      EXPECT_FALSE(increment.saturated());
      EXPECT_NEAR(increment.value().unknown, strongest, FixedLogCommonality::kUnit);
      EXPECT_GE(std::min(increment.value().empty, increment.value().occupied), strongest - FixedLogCommonality::kUnit);
    }
  }
  for (const double wrong : {-.1, 1.1, std::nan("")}) {
    EXPECT_THROW((void)fixed_increment({1.0, 0.0, 0.0, 0.0}, wrong), std::invalid_argument);
  }
}

}  // namespace
}  // namespace credo::evidence
