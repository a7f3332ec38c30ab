// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/sensor_matching.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "evidence/log_commonality.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Matching kBoth[] = {Matching::kPignistic, Matching::kPlausibility};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double logistic(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

Matching any_matching() { return *rc::gen::element(Matching::kPignistic, Matching::kPlausibility); }

TEST(SensorMatching, AReadingHasAProbabilityByEachMatching) {
  const BinaryMass mass{.5, .1, .4};
  EXPECT_NEAR(matched_probability(mass, Matching::kPignistic), .7, 1e-15);
  EXPECT_NEAR(matched_probability(mass, Matching::kPlausibility), 9.0 / 14.0, 1e-15);
  EXPECT_NEAR(matched_log_odds(mass, Matching::kPignistic), std::log(7.0 / 3.0), 1e-15);
  EXPECT_NEAR(matched_log_odds(mass, Matching::kPlausibility), std::log(9.0 / 5.0), 1e-15);
}

TEST(SensorMatching, IgnoranceIsEvenOddsAndCertaintyInfiniteOnes) {
  for (const Matching matching : kBoth) {
    EXPECT_EQ(matched_probability(BinaryMass::vacuous(), matching), .5);
    EXPECT_EQ(matched_log_odds(BinaryMass::vacuous(), matching), 0.0);
    EXPECT_EQ(matched_log_odds(BinaryMass{1.0, 0.0, 0.0}, matching), kInfinity);
    EXPECT_EQ(matched_log_odds(BinaryMass{0.0, 1.0, 0.0}, matching), -kInfinity);
  }
  EXPECT_NEAR(matched_log_odds(BinaryMass{1.0, 1e-300, 0.0}, Matching::kPignistic), 300.0 * std::log(10.0), 1e-10);
}

RC_GTEST_PROP(SensorMatchingLaws, ProbabilityIsTheTransformAndLogOddsAreItsOdds, (const BinaryMass& mass)) {
  RC_ASSERT(std::abs(matched_probability(mass, Matching::kPignistic) - mass.pignistic()) < 1e-15);
  const double both = mass.plausibility() + (1.0 - mass.belief());
  RC_ASSERT(std::abs(matched_probability(mass, Matching::kPlausibility) - mass.plausibility() / both) < 1e-15);
  for (const Matching matching : kBoth) {
    RC_ASSERT(std::abs(logistic(matched_log_odds(mass, matching)) - matched_probability(mass, matching)) < 1e-14);
  }
}

RC_GTEST_PROP(SensorMatchingLaws, AMassComesBackFromItsProbabilityAndItsIgnorance, (const BinaryMass& mass)) {
  for (const Matching matching : kBoth) {
    const BinaryMass back = mass_with(matched_probability(mass, matching), mass.unknown, matching);
    RC_ASSERT(distance(back, mass) < 1e-14);
  }
}

RC_GTEST_PROP(SensorMatchingLaws, NoMassOfThatProbabilityIsMoreUnknown, (const BinaryMass& mass)) {
  for (const Matching matching : kBoth) {
    const double p = matched_probability(mass, matching);
    const BinaryMass widest = most_unknown_with(p, matching);
    RC_ASSERT(std::abs(total(widest) - 1.0) < 1e-15);
    RC_ASSERT(std::abs(matched_probability(widest, matching) - p) < 1e-15);
    RC_ASSERT(widest.unknown >= mass.unknown - 1e-14);
    RC_ASSERT(std::min(widest.yes, widest.no) < 1e-15);
  }
}

TEST(SensorMatching, MostUnknownMassesOfAProbability) {
  EXPECT_LT(distance(most_unknown_with(.7, Matching::kPignistic), {.4, 0.0, .6}), 1e-15);
  EXPECT_LT(distance(most_unknown_with(.7, Matching::kPlausibility), {4.0 / 7.0, 0.0, 3.0 / 7.0}), 1e-15);
  for (const Matching matching : kBoth) {
    EXPECT_EQ(most_unknown_with(.5, matching), BinaryMass::vacuous());
    EXPECT_EQ(most_unknown_with(0.0, matching), (BinaryMass{0.0, 1.0, 0.0}));
  }
}

TEST(SensorMatching, SaysWhatIgnoranceAProbabilityCanCarry) {
  EXPECT_THAT([] { static_cast<void>(mass_with(.75, .6, Matching::kPignistic)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("unknown: found 0.6, expected a mass in [0, 0.5]")));
  EXPECT_THAT([] { static_cast<void>(mass_with(.75, .4, Matching::kPlausibility)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("expected a mass in [0, 0.333333]")));
  EXPECT_THROW(static_cast<void>(mass_with(.75, -.1, Matching::kPignistic)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(mass_with(.75, std::nan(""), Matching::kPignistic)), std::invalid_argument);
  EXPECT_THAT([] { static_cast<void>(most_unknown_with(1.5, Matching::kPignistic)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("probability: found 1.5, expected a number in [0, 1]")));
  EXPECT_THROW(static_cast<void>(largest_unknown_with(std::nan(""), Matching::kPlausibility)), std::invalid_argument);
}

TEST(SensorMatching, RoundedIgnoranceIsTakenForTheLargest) {
  EXPECT_LT(distance(mass_with(.7, .6 + 1e-12, Matching::kPignistic), {.4, 0.0, .6}), 1e-15);
}

// The law that decides which comparison is fair.
RC_GTEST_PROP(SensorMatchingLaws, MatchedByPlausibilityBayesAgreesWithDempsterForEver,
              (std::vector<BinaryMass> readings)) {
  double log_odds = 0.0;
  for (BinaryMass& reading : readings) {
    reading = discount(reading, .99);  // none is a certainty
    log_odds += matched_log_odds(reading, Matching::kPlausibility);
  }
  const auto fused = dempster(readings);
  RC_ASSERT(fused.has_value());
  RC_ASSERT(std::abs(matched_probability(fused->mass, Matching::kPlausibility) - logistic(log_odds)) < 1e-12);
}

TEST(SensorMatchingLaws, MatchedByPignisticProbabilityTheyAgreeOnceOnly) {
  const BinaryMass reading{.5, .1, .4};
  const double added = matched_log_odds(reading, Matching::kPignistic);
  EXPECT_NEAR(dempster({reading})->mass.pignistic(), logistic(added), 1e-15);
  const double dempsters = dempster(std::vector<BinaryMass>(5, reading))->mass.pignistic();
  EXPECT_NEAR(dempsters, (.90 * .90 * .90 * .90 * .90 - .5 * .01024) / (.59049 + .03125 - .01024), 1e-12);
  EXPECT_GT(logistic(5.0 * added), dempsters + .02);
}

RC_GTEST_PROP(SensorMatchingLaws, OnRepeatedReadingsBayesMatchedByBetPIsTheSurer, (BinaryMass reading)) {
  RC_PRE(reading.unknown > 0.0 && reading.yes > reading.no);
  reading = discount(reading, .99);
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(2, 12));
  const double bayes = logistic(static_cast<double>(count) * matched_log_odds(reading, Matching::kPignistic));
  RC_ASSERT(bayes >= dempster(std::vector<BinaryMass>(count, reading))->mass.pignistic() - 1e-14);
}

RC_GTEST_PROP(SensorMatchingLaws, CellsAreMatchedWithoutTheirConflict, (const GridMass& mass)) {
  const Matching matching = any_matching();
  if (mass.conflict == 1.0) {
    RC_ASSERT_THROWS_AS(static_cast<void>(matched_probability(mass, matching)), std::domain_error);
    return;
  }
  const double p = matched_probability(mass, matching);
  RC_ASSERT(std::abs(logistic(matched_log_odds(mass, matching)) - p) < 1e-14);
  if (matching == Matching::kPignistic) {
    RC_ASSERT(std::abs(p - pignistic(mass, GridElement::kOccupied, GridModel::kExclusive)) < 1e-14);
  }
  const GridMass back = grid_mass_with(p, mass.unknown, mass.conflict, matching);
  RC_ASSERT(distance(back, mass) < 1e-12);
  const GridMass widest = most_unknown_grid_mass_with(p, mass.conflict, matching);
  RC_ASSERT(std::abs(total(widest) - 1.0) < 1e-14);
  RC_ASSERT(widest.unknown >= mass.unknown - 1e-12);
  RC_ASSERT(std::abs(matched_probability(widest, matching) - p) < 1e-12);
}

RC_GTEST_PROP(SensorMatchingLaws, TheCellOfAMapAddsUpTheLogOddsMatchedByPlausibility,
              (const std::vector<GridMass>& readings)) {
  LogCommonality cell;
  double log_odds = 0.0;
  for (const GridMass& reading : readings) {
    cell += log_commonality(reading, .9);
    log_odds += matched_log_odds(discount(reading, .9), Matching::kPlausibility);
  }
  RC_ASSERT(std::abs(evidence_for_occupied(cell) - evidence_for_empty(cell) - log_odds) < 1e-10);
}

TEST(SensorMatching, CellsRefuseTotalConflict) {
  EXPECT_THROW(static_cast<void>(matched_log_odds(GridMass{0, 0, 1, 0}, Matching::kPlausibility)), std::domain_error);
  for (const double conflict : {-.1, 1.0, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(grid_mass_with(.5, 0.0, conflict, Matching::kPignistic)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(most_unknown_grid_mass_with(.5, conflict, Matching::kPignistic)),
                 std::invalid_argument);
  }
  EXPECT_THROW(static_cast<void>(grid_mass_with(.5, .6, .5, Matching::kPignistic)), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evidence
