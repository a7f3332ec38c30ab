// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/log_evidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

std::vector<BinaryMass> discounted(const std::vector<BinaryMass>& readings) {
  std::vector<BinaryMass> result;
  for (const BinaryMass& reading : readings) result.push_back(discount(reading, .95));
  return result;
}

LogEvidence sum_of(const std::vector<BinaryMass>& readings) {
  LogEvidence sum;
  for (const BinaryMass& reading : readings) sum += log_evidence(reading);
  return sum;
}

RC_GTEST_PROP(LogEvidenceLaws, HoldsTheMass, (const BinaryMass& reading)) {
  const BinaryMass mass = discount(reading, .95);
  RC_ASSERT(distance(normalised_mass(log_evidence(mass)), mass) < 1e-15);
}

RC_GTEST_PROP(LogEvidenceLaws, AdditionIsDempster, (const std::vector<BinaryMass>& readings)) {
  const std::vector<BinaryMass> weak = discounted(readings);
  const auto expected = dempster(weak);
  RC_ASSERT(expected.has_value());
  const LogEvidence sum = sum_of(weak);
  RC_ASSERT(distance(normalised_mass(sum), expected->mass) < 1e-12);
  RC_ASSERT(std::abs(pignistic(sum) - expected->mass.pignistic()) < 1e-12);
  const BinaryMass& m = expected->mass;
  RC_ASSERT(std::abs(plausibility_probability(sum) - m.plausibility() / (m.plausibility() + m.no + m.unknown)) < 1e-12);
}

RC_GTEST_PROP(LogEvidenceLaws, WhatWasTakenInCanBeTakenOut,
              (const std::vector<BinaryMass>& readings, const BinaryMass& other)) {
  const LogEvidence sum = sum_of(discounted(readings)), extra = log_evidence(discount(other, .95));
  RC_ASSERT(distance(normalised_mass(sum + extra - extra), normalised_mass(sum)) < 1e-12);
}

RC_GTEST_PROP(LogEvidenceLaws, ACellOfAMapHoldsTheSame, (const GridMass& reading)) {
  const LogCommonality cell = log_commonality(reading, .95);
  const BinaryMass mass = normalised_mass(log_evidence(cell));
  const GridMass expected = normalised_masses(cell);
  RC_ASSERT(distance(mass, BinaryMass{expected.occupied, expected.empty, expected.unknown}) < 1e-14);
  const double probability = plausibility_probability(log_evidence(cell));
  RC_ASSERT(std::abs(probability - plausibility_probability_occupied(cell)) < 1e-14);
}

TEST(LogEvidence, NothingIsVacuous) {
  EXPECT_EQ(log_evidence(BinaryMass::vacuous()), LogEvidence{});
  EXPECT_EQ(normalised_mass(LogEvidence{}), BinaryMass::vacuous());
  EXPECT_EQ(pignistic(LogEvidence{}), .5);
  EXPECT_EQ(plausibility_probability(LogEvidenceF{}), .5);
}

TEST(LogEvidence, AnyAmountOfItHasAMass) {
  const BinaryMass certain = normalised_mass(LogEvidence{9000.0, 100.0});
  EXPECT_EQ(certain, (BinaryMass{1.0, 0.0, 0.0}));
  const BinaryMass balanced = normalised_mass(LogEvidence{9000.0, 9000.0});
  EXPECT_NEAR(balanced.yes, .5, 1e-15);
  EXPECT_NEAR(balanced.no, .5, 1e-15);
  EXPECT_EQ(plausibility_probability(LogEvidence{-1.0, 9000.0}), 0.0);
}

TEST(LogEvidence, FaintMassesKeepTheirDigits) {
  const BinaryMass faint = normalised_mass(log_evidence(BinaryMass{1e-12, 1e-15, 1.0 - 1e-12 - 1e-15}));
  EXPECT_NEAR(faint.yes / 1e-12, 1.0, 1e-12);
  EXPECT_NEAR(faint.no / 1e-15, 1.0, 1e-12);
  const LogEvidence strongest = log_evidence(BinaryMass{1.0, 0.0, 5e-324});
  EXPECT_NEAR(strongest.yes, 744.44, .01);
  EXPECT_EQ(strongest.no, 0.0);
}

TEST(LogEvidence, RoundingBelowNothingCountsAsNothing) {
  const BinaryMass mass = normalised_mass(LogEvidence{-1e-16, .5});
  EXPECT_EQ(mass.yes, 0.0);
  EXPECT_NEAR(total(mass), 1.0, 1e-15);
}

TEST(LogEvidence, RefusesCertaintyAndWhatIsNoMass) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const BinaryMass& mass :
       {BinaryMass{.5, .5, 0.0}, {1.2, -.4, .2}, {-.4, 1.2, .2}, {nan, .1, .9}, {.1, .1, nan}, {.9, .9, .2}}) {
    EXPECT_THROW((void)log_evidence(mass), std::invalid_argument) << mass;
  }
  try {
    (void)log_evidence<float>(BinaryMass{.25, .75, 0.0});
    FAIL() << "a dogmatic mass";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("no = 0.75"), ::testing::HasSubstr("discount")));
  }
}

}  // namespace
}  // namespace credo::evidence
