// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/utility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/evidence/random_mass_functions.hpp"

namespace credo::evidence {
namespace {

using ::testing::ElementsAre;

const Frame kDoor = Frame::shafer({"open", "shut"});
const MassFunction kSeen(kDoor, {{"open", 0.5}, {"shut", 0.2}, {"Θ", 0.3}});
// To drive through is worth 10 if the door is open and costs 10 if it is shut; to wait costs 1; to turn around is
// worth 2.
const double kActs[] = {10.0, -10.0, -1.0, -1.0, 2.0, 2.0};

TEST(Utility, ExpectationsAreBoundedByTheWorstAndTheBest) {
  const std::span drive(kActs, 2);
  EXPECT_NEAR(lower_expectation(kSeen, drive), 0.0, 1e-15);
  EXPECT_NEAR(upper_expectation(kSeen, drive), 6.0, 1e-15);
  EXPECT_NEAR(pignistic_expectation(kSeen, drive), 3.0, 1e-15);
}

TEST(Utility, TheBestActDependsOnThePessimism) {
  EXPECT_EQ(best_act(kSeen, kActs, 1.0).choice, 2u);  // turn around
  EXPECT_EQ(best_act(kSeen, kActs, 0.0).choice, 0u);  // drive
  EXPECT_NEAR(best_act(kSeen, kActs, 0.0).margin, 4.0, 1e-15);
  EXPECT_EQ(best_act_pignistic(kSeen, kActs).choice, 0u);
  EXPECT_NEAR(best_act_pignistic(kSeen, kActs).value, 3.0, 1e-15);
  EXPECT_THAT(undominated_acts(kSeen, kActs), ElementsAre(0, 2));         // turning around beats waiting for certain
  EXPECT_EQ(best_act(kSeen, std::span(kActs, 2), 0.5).margin, HUGE_VAL);  // one act alone
}

TEST(Utility, WhatHasNoExpectationIsRefused) {
  const double one[] = {1.0}, infinite[] = {1.0, HUGE_VAL};
  EXPECT_THROW(static_cast<void>(lower_expectation(kSeen, one)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(upper_expectation(kSeen, infinite)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(best_act(kSeen, {}, 0.5)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(best_act(kSeen, std::span(kActs, 3), 0.5)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(best_act(kSeen, kActs, std::nan(""))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(undominated_acts(MassFunction::categorical(kDoor, {}), kActs)), std::domain_error);
}

RC_GTEST_PROP(UtilityLaws, ExpectationsAreOrdered, ()) {
  const MassFunction mass = (*random_sources(1, {.frames = power_sets(), .some_unknown = true})).front();
  const auto values = *rc::gen::container<std::vector<int>>(mass.frame().size(), rc::gen::inRange(-9, 10));
  const std::vector<double> real(values.begin(), values.end());
  const double expected = pignistic_expectation(mass, real);
  RC_ASSERT(lower_expectation(mass, real) <= expected + 1e-12);
  RC_ASSERT(expected <= upper_expectation(mass, real) + 1e-12);
}

}  // namespace
}  // namespace credo::evidence
