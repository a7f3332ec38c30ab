// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/log_commonality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

double reliability() { return *rc::gen::inRange(0, 100) / 100.0; }

LogCommonality sum_of(const std::vector<GridMass>& readings, double r) {
  LogCommonality cell;
  for (const GridMass& reading : readings) cell += log_commonality(reading, r);
  return cell;
}

RC_GTEST_PROP(LogCommonalityLaws, HoldsTheDiscountedMass, (const GridMass& reading)) {
  const double r = reliability();
  RC_ASSERT(distance(masses(log_commonality(reading, r)), discount(reading, r)) < 1e-15);
}

RC_GTEST_PROP(LogCommonalityLaws, AdditionIsDsmc, (const std::vector<GridMass>& readings)) {
  const double r = reliability();
  GridMass expected;
  for (const GridMass& reading : readings) expected = dsmc(expected, discount(reading, r));
  const LogCommonality cell = sum_of(readings, r);
  RC_ASSERT(distance(masses(cell), expected) < 1e-13);
  RC_ASSERT(std::abs(conflict(cell) - expected.conflict) < 1e-13);
  const auto normalised = without_conflict(expected);
  RC_ASSERT(normalised.has_value());
  RC_ASSERT(distance(normalised_masses(cell), *normalised) < 1e-9);
}

RC_GTEST_PROP(LogCommonalityLaws, ReadOutsAreConsistent, (const std::vector<GridMass>& readings)) {
  const LogCommonality cell = sum_of(readings, reliability());
  const GridMass raw = masses(cell), normalised = normalised_masses(cell);
  RC_ASSERT(std::abs(total(raw) - 1.0) < 1e-14);
  RC_ASSERT(std::abs(total(normalised) - 1.0) < 1e-14);
  RC_ASSERT(std::min({raw.empty, raw.occupied, raw.conflict, raw.unknown}) >= 0.0);
  RC_ASSERT(std::min({normalised.empty, normalised.occupied, normalised.unknown}) >= 0.0);
  const double betp = pignistic_occupied(cell), plp = plausibility_probability_occupied(cell);
  RC_ASSERT(std::abs(plp - (normalised.occupied + normalised.unknown) / (1.0 + normalised.unknown)) < 1e-13);
  RC_ASSERT((betp > .5 + 1e-12) == (plp > .5 + 1e-12) || std::abs(betp - .5) < 1e-9);
  RC_ASSERT(contested(cell) >= 0.0 && contested(cell) <= 1.0);
}

RC_GTEST_PROP(FixedLogCommonalityLaws, AnyOrderAndAnySplitGiveTheSameBits, (std::vector<GridMass> readings)) {
  const double r = reliability();
  FixedLogCommonality forward, backward, robot_a, robot_b;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const FixedLogCommonality increment = quantise(log_commonality(readings[i], r));
    forward += increment;
    (i % 3 == 0 ? robot_a : robot_b) += increment;
  }
  for (std::size_t i = readings.size(); i-- > 0;) backward += quantise(log_commonality(readings[i], r));
  RC_ASSERT(forward == backward);
  RC_ASSERT(forward == robot_a + robot_b);
  RC_ASSERT(forward == robot_b + robot_a);
  RC_ASSERT(forward - robot_b == robot_a);
}

RC_GTEST_PROP(FixedLogCommonalityLaws, QuantisationIsHalfAUnit, (const GridMass& reading)) {
  const LogCommonality exact = log_commonality(reading, reliability());
  const LogCommonality rounded = quantise(exact).value();
  const double half = 0.5 * FixedLogCommonality::kUnit;
  RC_ASSERT(std::abs(rounded.empty - exact.empty) <= half);
  RC_ASSERT(std::abs(rounded.occupied - exact.occupied) <= half);
  RC_ASSERT(std::abs(rounded.unknown - exact.unknown) <= half);
  const GridMass mass = masses(rounded);
  RC_ASSERT(std::abs(total(mass) - 1.0) < 1e-15);
  RC_ASSERT(std::min({mass.empty, mass.occupied, mass.conflict, mass.unknown}) >= 0.0);
  RC_ASSERT(distance(mass, masses(exact)) < 3e-6);
}

TEST(LogCommonality, NothingKnownIsPlusZero) {
  for (const LogCommonality& cell :
       {log_commonality(GridMass::vacuous(), .9), log_commonality({.5, .3, .2, 0.0}, 0.0)}) {
    EXPECT_EQ(cell, LogCommonality{});
    EXPECT_FALSE(std::signbit(cell.empty) || std::signbit(cell.occupied) || std::signbit(cell.unknown));
  }
  EXPECT_EQ(quantise(LogCommonality{-0.0, -0.0, -0.0}), FixedLogCommonality{});
  EXPECT_EQ(masses(LogCommonality{}), GridMass::vacuous());
  EXPECT_EQ(normalised_masses(LogCommonality{}), GridMass::vacuous());
  EXPECT_EQ(pignistic_occupied(LogCommonality{}), .5);
  EXPECT_EQ(plausibility_probability_occupied(LogCommonality{}), .5);
  EXPECT_EQ(contested(LogCommonality{}), 0.0);
  EXPECT_EQ(conflict(LogCommonality{}), 0.0);
}

// Sequential Dempster in extended precision, renormalised at every step: another formula, for the same cell.
struct Sequential {
  long double empty = 0, occupied = 0, unknown = 1;
  void take(const GridMass& mass) {
    const long double e = empty * (mass.empty + mass.unknown) + unknown * mass.empty;
    const long double o = occupied * (mass.occupied + mass.unknown) + unknown * mass.occupied;
    const long double u = unknown * mass.unknown;
    empty = e / (e + o + u);
    occupied = o / (e + o + u);
    unknown = u / (e + o + u);
  }
};

// Readings that contradict each other, so that the answer stays between the certainties.
std::vector<GridMass> weak_readings(int count) {
  std::mt19937 random(7);
  const auto share = [&random] { return .1 * static_cast<double>(random() >> 8) / (1 << 24); };
  std::vector<GridMass> readings;
  for (int i = 0; i < count; ++i) {
    const double a = share(), b = share();
    readings.push_back(GridMass::from(a, b, .02));
  }
  return readings;
}

TEST(LogCommonality, TenThousandUpdatesAgreeWithSequentialDempster) {
  LogCommonality cell;
  Sequential reference;
  for (const GridMass& reading : weak_readings(10'000)) {
    cell += log_commonality(reading, .99);
    reference.take(discount(reading, .99));
  }
  const GridMass mass = normalised_masses(cell);
  EXPECT_LT(cell.unknown, -800.0);  // the linear mass of ignorance is beyond the range of double
  EXPECT_NEAR(mass.empty, static_cast<double>(reference.empty), 1e-9);
  EXPECT_NEAR(mass.occupied, static_cast<double>(reference.occupied), 1e-9);
  EXPECT_GT(mass.occupied, 1e-6);
  EXPECT_LT(mass.occupied, 1.0 - 1e-6);
}

TEST(FixedLogCommonality, TenThousandUpdatesAgreeWithTheSumOfWhatWasPutIn) {
  FixedLogCommonality cell;
  LogCommonality unrounded;
  long double empty = 0, occupied = 0, unknown = 0;
  for (const GridMass& reading : weak_readings(10'000)) {
    const LogCommonality exact = log_commonality(reading, .99);
    const FixedLogCommonality increment = quantise(exact);
    cell += increment;
    unrounded += exact;
    empty += static_cast<long double>(increment.value().empty);
    occupied += static_cast<long double>(increment.value().occupied);
    unknown += static_cast<long double>(increment.value().unknown);
  }
  ASSERT_FALSE(cell.saturated());
  EXPECT_EQ(cell.value().empty, static_cast<double>(empty));
  EXPECT_EQ(cell.value().occupied, static_cast<double>(occupied));
  EXPECT_EQ(cell.value().unknown, static_cast<double>(unknown));
  const double bound = 10'000 * 0.5 * FixedLogCommonality::kUnit;
  EXPECT_NEAR(cell.value().empty, unrounded.empty, bound);
  EXPECT_NEAR(plausibility_probability_occupied(cell.value()), plausibility_probability_occupied(unrounded), bound / 2);
}

TEST(LogCommonality, ReadOutsStandAnyAmountOfEvidence) {
  const LogCommonality occupied{-9000.0, -100.0, -9500.0};
  EXPECT_EQ(normalised_masses(occupied).occupied, 1.0);
  EXPECT_EQ(normalised_masses(occupied).unknown, 0.0);
  EXPECT_EQ(pignistic_occupied(occupied), 1.0);
  EXPECT_EQ(masses(occupied).conflict, 1.0);
  const LogCommonality balanced{-9000.0, -9000.0, -18000.0};
  EXPECT_NEAR(normalised_masses(balanced).occupied, .5, 1e-15);
  EXPECT_EQ(contested(balanced), 1.0);
  EXPECT_EQ(conflict(balanced), 1.0);
  // Flipping back takes as much as went in, however much that was: nothing locks.
  LogCommonality cell;
  for (int i = 0; i < 5000; ++i) cell += log_commonality(GridMass::from(.05, .65), .95);
  for (int i = 0; i < 5001; ++i) cell += log_commonality(GridMass::from(.65, .05), .95);
  EXPECT_LT(pignistic_occupied(cell), .5);
}

TEST(LogCommonality, ConflictOfFaintEvidenceKeepsItsDigits) {
  const LogCommonality cell =
      log_commonality(GridMass::from(1e-10, 0.0), .5) + log_commonality(GridMass::from(0.0, 1e-9), .5);
  EXPECT_NEAR(conflict(cell) / (.25 * 1e-19), 1.0, 1e-6);
}

TEST(LogCommonality, OneSidedEvidenceIsNotContested) {
  const LogCommonality empty = log_commonality(GridMass::from(.8, 0.0), .9);
  EXPECT_EQ(contested(empty), 0.0);
  EXPECT_EQ(contested(empty + empty), 0.0);
  EXPECT_NEAR(contested(empty + log_commonality(GridMass::from(0.0, .8), .9)), 1.0, 1e-15);
}

// m(conflict) grows with every reading of a noisy but unambiguous cell; `contested` keeps telling the share.
TEST(LogCommonality, ContestedDoesNotSaturateAsConflictDoes) {
  const LogCommonality reading = log_commonality(GridMass::from(.05, .6), .9);
  LogCommonality cell;
  for (int i = 0; i < 200; ++i) cell += reading;
  EXPECT_GT(conflict(cell), .99);
  EXPECT_NEAR(contested(cell), contested(reading), 1e-12);
  EXPECT_LT(contested(cell), .3);
}

TEST(LogCommonality, LogOddsAreTheDifferenceOfTheEvidence) {
  const LogCommonality cell = log_commonality(GridMass::from(.2, .5), .9) + log_commonality(GridMass::from(.1, .7), .9);
  const double log_odds = evidence_for_occupied(cell) - evidence_for_empty(cell);
  const double probability = plausibility_probability_occupied(cell);
  EXPECT_NEAR(std::log(probability / (1.0 - probability)), log_odds, 1e-14);
}

TEST(LogCommonality, DecayIsDiscounting) {
  const GridMass reading{.3, .4, .1, .2};
  const GridMass decayed = masses(discount(log_commonality(reading, .9), .5));
  EXPECT_LT(distance(decayed, discount(reading, .45)), 1e-15);
  EXPECT_EQ(masses(discount(log_commonality(reading, .9), 0.0)), GridMass::vacuous());
}

TEST(LogCommonality, DecayKeepsTheDigitsOfMuchEvidence) {
  const LogCommonality cell{-50.0, -36.0, -1986.0};
  EXPECT_EQ(discount(cell, 1.0), cell);
  const double almost = 1.0 - 0x1p-53;  // q = e^-36 counts as much as 1 - r
  EXPECT_NEAR(discount(cell, almost).occupied, std::log(0x1p-53 + std::exp(-36.0)), 1e-12);
  EXPECT_NEAR(discount(cell, almost).unknown, std::log(0x1p-53), 1e-12);
}

TEST(LogCommonality, FloatHoldsTheSameCell) {
  LogCommonality cell;
  LogCommonalityF narrow;
  for (const GridMass& reading : weak_readings(100)) {
    cell += log_commonality(reading, .9);
    narrow += log_commonality(reading, .9).as<float>();
  }
  EXPECT_LT(distance(normalised_masses(narrow.as<double>()), normalised_masses(cell)), 1e-4);
}

TEST(LogCommonality, RefusesCertainSourcesAndWhatIsNoMass) {
  const GridMass good = GridMass::from(.5, .2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double r : {1.0, 1.5, -.1, nan}) EXPECT_THROW((void)log_commonality(good, r), std::invalid_argument) << r;
  EXPECT_THROW((void)log_commonality({.5, .2, 0.0, .1}, .9), std::invalid_argument);
  EXPECT_THROW((void)log_commonality({1.2, -.2, 0.0, 0.0}, .9), std::invalid_argument);
  EXPECT_THROW((void)log_commonality({nan, 0.0, 0.0, 1.0}, .9), std::invalid_argument);
  EXPECT_THROW((void)quantise({.1, 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW((void)quantise({nan, 0.0, 0.0}), std::invalid_argument);
}

TEST(FixedLogCommonality, SaturatesAtTheFloorAndTells) {
  const FixedLogCommonality strongest = quantise(log_commonality(GridMass::from(0.0, 1.0), .99));
  FixedLogCommonality cell;
  for (int i = 0; i < 444; ++i) cell += strongest;
  EXPECT_FALSE(cell.saturated());
  cell += strongest;
  EXPECT_TRUE(cell.saturated());
  EXPECT_EQ(cell.unknown, FixedLogCommonality::kFloor);
  EXPECT_EQ(cell.occupied, 0);
  EXPECT_TRUE((cell - strongest).saturated());
  EXPECT_GT(pignistic_occupied(cell.value()), .999);
  EXPECT_TRUE(quantise({-3000.0, -1.0, -3000.0}).saturated());
}

TEST(FixedLogCommonality, SaturatedSumsDoNotDependOnTheOrder) {
  const FixedLogCommonality a = quantise({-1500.0, -3.0, -1500.0}), b = quantise({-.5, -900.0, -900.0}),
                            c = quantise({-700.0, -1200.0, -1300.0});
  EXPECT_TRUE((a + b + c).saturated());
  EXPECT_EQ(a + b + c, c + b + a);
  EXPECT_EQ(a + (b + c), (a + b) + c);
  EXPECT_EQ(a + (b + c), (c + a) + b);
}

}  // namespace
}  // namespace credo::evidence
