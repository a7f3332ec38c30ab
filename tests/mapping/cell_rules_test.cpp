// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
