// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/four_kinds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

double total(const FourKindMass& m) {
  double sum = m.other + m.regular + m.unknown;
  for (int i = 0; i < 3; ++i) sum += m.one[i] + m.one_or_other[i];
  return sum;
}

// Kinds as bits 1, 2, 4, 8: every pair of focal elements, intersected.
struct Enumerated {
  double mass[16] = {};
};
Enumerated enumerate(const WhichKind& which, const WhetherRegular& whether) {
  Enumerated result;
  const std::pair<unsigned, double> first[] = {{1 | 8, which.one_or_other[0]},
                                               {2 | 8, which.one_or_other[1]},
                                               {4 | 8, which.one_or_other[2]},
                                               {15, which.unknown}};
  const std::pair<unsigned, double> second[] = {{7, whether.regular}, {8, whether.other}, {15, whether.unknown}};
  for (const auto& [a, m] : first) {
    for (const auto& [b, n] : second) result.mass[a & b] += m * n;
  }
  return result;
}

RC_GTEST_PROP(FourKindsLaws, CombinationAndMeasuresAreWhatEnumerationGives, ()) {
  const double deviation = *rc::gen::inRange(-400, 400) / 10.0, gap = *rc::gen::inRange(0, 30) / 100.0;
  const WhichKind which = which_kind(deviation);
  const WhetherRegular whether = whether_regular(gap);
  const Enumerated expected = enumerate(which, whether);
  const FourKindMass mass = combine(which, whether);
  RC_ASSERT(std::abs(total(mass) - 1.0) < 1e-15);
  RC_ASSERT(expected.mass[0] == 0.0);  // the two criteria never contradict each other
  for (int i = 0; i < 3; ++i) {
    RC_ASSERT(std::abs(mass.one[i] - expected.mass[1u << i]) < 1e-15);
    RC_ASSERT(std::abs(mass.one_or_other[i] - expected.mass[(1u << i) | 8]) < 1e-15);
  }
  RC_ASSERT(std::abs(mass.regular - expected.mass[7]) < 1e-15);
  for (int kind = 0; kind < 4; ++kind) {
    double bel = 0.0, pl = 0.0;
    for (unsigned set = 1; set < 16; ++set) {
      if (set == 1u << kind) bel += expected.mass[set];
      if (set >> kind & 1u) pl += expected.mass[set];
    }
    const BinaryMass is_kind = belief_in_kind(mass, kind);
    RC_ASSERT(std::abs(is_kind.yes - bel) < 1e-15);
    RC_ASSERT(std::abs(is_kind.plausibility() - pl) < 1e-15);
    RC_ASSERT(std::abs(evidence::total(is_kind) - 1.0) < 1e-15);
  }
}

TEST(FourKinds, WhatCouldNotBeMeasuredIsIgnorance) {
  EXPECT_EQ(which_kind(std::nan("")).unknown, 1.0);
  EXPECT_EQ(whether_regular(std::nan("")).unknown, 1.0);
  EXPECT_EQ(combine(which_kind(std::nan("")), whether_regular(std::nan(""))).unknown, 1.0);
}

TEST(FourKinds, DeviationAndGapDecideTheKind) {
  const auto kind = [](double deviation, double gap) {
    return most_believed(combine(which_kind(deviation), whether_regular(gap)));
  };
  EXPECT_EQ(kind(-90.0, 0.0), 0);
  EXPECT_EQ(kind(90.0, 0.0), 1);
  EXPECT_EQ(kind(3.0, 0.0), 2);
  EXPECT_EQ(kind(90.0, .5), 3);
  EXPECT_EQ(kind(0.0, .5), 3);
}

TEST(FourKinds, TiesGoToTheLowestKind) {
  EXPECT_EQ(most_believed(FourKindMass{}), 0);
  // Half way between kind 0 and kind 2.
  EXPECT_EQ(most_believed(combine(which_kind(-17.5), whether_regular(0.0))), 0);
  EXPECT_EQ(most_believed(combine(which_kind(17.5), whether_regular(0.0))), 1);
}

TEST(FourKinds, BreakpointsAreTheCallers) {
  const WhichKind which = which_kind(.3, {.committed = .8, .level_until = .2, .level_zero_from = .4});
  EXPECT_NEAR(which.one_or_other[1], .4, 1e-12);
  EXPECT_NEAR(which.one_or_other[2], .4, 1e-12);
  EXPECT_NEAR(which.unknown, .2, 1e-15);
}

}  // namespace
}  // namespace credo::evidence
