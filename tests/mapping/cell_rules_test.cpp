// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "evidence/log_commonality.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;

constexpr GridMass kSaysEmpty{.empty = 0.6, .occupied = 0.1, .conflict = 0.0, .unknown = 0.3};
constexpr GridMass kSaysOccupied{.empty = 0.1, .occupied = 0.7, .conflict = 0.0, .unknown = 0.2};
constexpr GridMass kSurelyEmpty{.empty = 1.0, .occupied = 0.0, .conflict = 0.0, .unknown = 0.0};
constexpr GridMass kSurelyOccupied{.empty = 0.0, .occupied = 1.0, .conflict = 0.0, .unknown = 0.0};

/// After so many times the same reading.
template <CellRule Rule>
typename Rule::Cell after(const Rule& rule, const GridMass& reading, int times) {
  typename Rule::Cell cell{};
  for (int i = 0; i < times; ++i) EXPECT_TRUE(rule.update(cell, reading));
  return cell;
}

/// How many readings of the other kind turn a cell that was found occupied so often.
template <CellRule Rule>
int readings_to_turn(const Rule& rule, int times) {
  auto cell = after(rule, {.empty = 0.05, .occupied = 0.65, .conflict = 0.0, .unknown = 0.3}, times);
  for (int turned = 1; turned <= 2 * times; ++turned) {
    static_cast<void>(rule.update(cell, {.empty = 0.65, .occupied = 0.05, .conflict = 0.0, .unknown = 0.3}));
    if (rule.masses(cell).empty > rule.masses(cell).occupied) return turned;
  }
  return -1;
}

TEST(CellRules, DempsterInLinearMassesIsTheReadOutOfTheSum) {
  evidence::LogCommonality sum;
  GridMass cell;
  for (const GridMass& reading : {kSaysEmpty, kSaysOccupied, kSaysOccupied, kSaysEmpty, kSaysOccupied}) {
    ASSERT_TRUE(DempsterFold{}.update(cell, reading));
    sum += evidence::log_commonality(reading, 0.999999);
  }
  EXPECT_NEAR(cell.occupied, evidence::normalised_masses(sum).occupied, 1e-5);
  EXPECT_NEAR(cell.empty, evidence::normalised_masses(sum).empty, 1e-5);
}

/// Readings of many strengths, for and against.
std::vector<GridMass> mixed_readings() {
  std::vector<GridMass> readings;
  for (int i = 0; i < 500; ++i) {
    const double known = 0.3 + 0.002 * (i * 37 % 200), share = 0.01 * (i * 61 % 100);
    readings.push_back({known * share, known * (1.0 - share), 0.0, 1.0 - known});
  }
  return readings;
}

/// In the order that they are given in: the cell of floats, and that of fixed point.
std::pair<evidence::LogCommonalityF, evidence::FixedLogCommonality> sums_of(const std::vector<GridMass>& readings) {
  std::pair<evidence::LogCommonalityF, evidence::FixedLogCommonality> sums;
  for (const GridMass& reading : readings) {
    EXPECT_TRUE(DempsterFloatFold{}.update(sums.first, reading));
    sums.second += evidence::quantise(evidence::log_commonality(reading, 1.0 - 0x1p-53));
  }
  return sums;
}

TEST(CellRules, FloatsLoseTheIndependenceOfTheOrderThatFixedPointHas) {
  std::vector<GridMass> readings = mixed_readings();
  const auto [narrow, fixed] = sums_of(readings);
  std::ranges::reverse(readings);
  const auto [narrow_reversed, fixed_reversed] = sums_of(readings);
  EXPECT_EQ(fixed, fixed_reversed);
  EXPECT_NE(narrow, narrow_reversed);
  EXPECT_NEAR(narrow.unknown, narrow_reversed.unknown, 1e-6 * std::abs(narrow.unknown));
  const GridMass of_floats = DempsterFloatFold{}.masses(narrow), of_fixed = evidence::normalised_masses(fixed.value());
  EXPECT_NEAR(of_floats.occupied, of_fixed.occupied, 1e-4);
  EXPECT_NEAR(of_floats.empty, of_fixed.empty, 1e-4);
}

TEST(CellRules, FloatsHaveNoFloorButLoseWeakReadingsBesideMuchEvidence) {
  evidence::LogCommonalityF narrow;
  evidence::FixedLogCommonality fixed;
  const auto take_in = [&](const GridMass& reading) {
    static_cast<void>(DempsterFloatFold{}.update(narrow, reading));
    fixed += evidence::fixed_increment(reading, 1.0);
  };
  for (int i = 0; i < 300; ++i) take_in(kSurelyOccupied);
  const auto narrow_before = narrow;
  const auto fixed_before = fixed;
  take_in({.empty = 2e-5, .occupied = 0.0, .conflict = 0.0, .unknown = 1.0 - 2e-5});
  EXPECT_EQ(narrow.unknown, narrow_before.unknown);
  EXPECT_LT(fixed.unknown, fixed_before.unknown);
  for (int i = 0; i < 200; ++i) take_in(kSurelyOccupied);
  EXPECT_TRUE(fixed.saturated());
  EXPECT_NEAR(narrow.unknown, 500.0 * std::log(0.01), 0.1);
}

TEST(CellRules, ACertaintyIsNeverLeftUnderDempsterAndItsOppositeIsAbandoned) {
  GridMass cell = after(DempsterFold{}, kSurelyEmpty, 1);
  EXPECT_TRUE(DempsterFold{}.update(cell, kSaysOccupied));
  EXPECT_EQ(cell.empty, 1.0);
  EXPECT_FALSE(DempsterFold{}.update(cell, kSurelyOccupied));
  EXPECT_EQ(cell.empty, 1.0);
}

TEST(CellRules, TheConflictAbsorbsUnderDsmc) {
  GridMass cell;
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(DsmcFold{}.update(cell, kSaysEmpty));
    static_cast<void>(DsmcFold{}.update(cell, kSaysOccupied));
  }
  EXPECT_GT(cell.conflict, 0.999);
}

TEST(CellRules, RedistributedConflictForgetsInAFewReadings) {
  EXPECT_NEAR(readings_to_turn(DempsterFold{}, 100), 101, 1);  // at 100 they are even
  EXPECT_NEAR(readings_to_turn(BayesFold{}, 100), 101, 1);
  EXPECT_EQ(readings_to_turn(Pcr2Fold{}, 100), 2);
  EXPECT_EQ(readings_to_turn(Pcr5Fold{}, 100), 3);
  EXPECT_EQ(readings_to_turn(DsmhFold{}, 100), 2);
}

TEST(CellRules, BayesSumsTheLogOddsOfPignisticProbabilities) {
  const double cell = after(BayesFold{}, kSaysOccupied, 3);
  EXPECT_NEAR(cell, 3.0 * std::log(0.8 / 0.2), 1e-12);
  EXPECT_NEAR(BayesFold{}.masses(cell).occupied, 64.0 / 65.0, 1e-12);
  EXPECT_TRUE(std::isfinite(after(BayesFold{}, kSurelyOccupied, 5)));
}

TEST(CellRules, ApproximatedEvidenceStaysAMassWhereThePrintedOneIsNegative) {
  const GridMass arc{.empty = 0.0, .occupied = 1.0 / 60.0, .conflict = 0.0, .unknown = 59.0 / 60.0};
  for (const auto approximation : {Approximation::kFixed, Approximation::kAdaptive, Approximation::kFaceValue})
    for (const int often : {1, 3, 400}) {
      const GridMass mass =
          approximated(arc, often, often, {.e1 = 0.05, .e2 = 0.05, .e3 = 0.05, .approximation = approximation});
      EXPECT_GT(mass.occupied, 0.0);
      EXPECT_GE(mass.empty, 0.0);
      EXPECT_NEAR(mass.empty + mass.occupied + mass.unknown, 1.0, 1e-15);
    }
}

TEST(CellRules, EvidenceAgainstTheHistoryIsWeakenedByAllOfE) {
  const GridMass before{.empty = 0.3, .occupied = 0.0, .conflict = 0.0, .unknown = 0.7};
  const ApproximationParams params{.e1 = 0.05, .e2 = 0.05, .e3 = 0.05};
  const GridMass agreeing = approximated(before, 30, 1, params), opposing = approximated(before, 1, 30, params);
  EXPECT_GT(agreeing.empty, 0.29);
  EXPECT_LT(opposing.empty, 0.22);
}

TEST(CellRules, ACertainlyEmptyCellCanTurnWhereItIsApproximated) {
  const GridMass surely_empty{.empty = 1.0, .occupied = 0.0, .conflict = 0.0, .unknown = 0.0};
  const GridMass on_the_arc{.empty = 0.0, .occupied = 0.25, .conflict = 0.0, .unknown = 0.75};
  auto cell = after(ApproximatedDempsterFold{}, surely_empty, 1);
  for (int i = 0; i < 200 && cell.mass.occupied < cell.mass.empty; ++i)
    ASSERT_TRUE(ApproximatedDempsterFold{}.update(cell, on_the_arc));
  EXPECT_GT(cell.mass.occupied, cell.mass.empty);
}

}  // namespace
}  // namespace credo::mapping
