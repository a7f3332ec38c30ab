// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/belief_shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr RampBelief kAngle{
    .max_yes = .9, .yes_full_until = 0, .yes_zero_from = 10, .max_no = .8, .no_zero_until = 10, .no_full_from = 25};

TEST(BeliefShapes, RampsAreLinearBetweenTheirBreakpoints) {
  EXPECT_EQ(falling(-1.0, 0.0, 4.0), 1.0);
  EXPECT_EQ(falling(1.0, 0.0, 4.0), .75);
  EXPECT_EQ(falling(4.0, 0.0, 4.0), 0.0);
  EXPECT_EQ(rising(1.0, 0.0, 4.0), .25);
  EXPECT_EQ(rising(9.0, 0.0, 4.0), 1.0);
}

TEST(BeliefShapes, ReversedBreakpointsFavourTheLarge) {
  EXPECT_EQ(falling(1.0, 1.0, .2), 1.0);
  EXPECT_EQ(falling(7.0, 1.0, .2), 1.0);
  EXPECT_NEAR(falling(.6, 1.0, .2), .5, 1e-15);
  EXPECT_EQ(falling(.2, 1.0, .2), 0.0);
}

TEST(BeliefShapes, EqualBreakpointsAreAStep) {
  EXPECT_EQ(falling(2.0, 2.0, 2.0), 1.0);
  EXPECT_EQ(falling(2.1, 2.0, 2.0), 0.0);
  EXPECT_EQ(rising(2.0, 2.0, 2.0), 0.0);
}

TEST(BeliefShapes, BeliefFollowsBothRamps) {
  EXPECT_NEAR(distance(kAngle(0.0), {.9, 0.0, .1}), 0.0, 1e-15);
  EXPECT_NEAR(distance(kAngle(5.0), {.45, 0.0, .55}), 0.0, 1e-15);
  EXPECT_EQ(kAngle(10.0), BinaryMass::vacuous());
  EXPECT_NEAR(distance(kAngle(17.5), {0.0, .4, .6}), 0.0, 1e-15);
  EXPECT_NEAR(distance(kAngle(kInfinity), {0.0, .8, .2}), 0.0, 1e-15);
}

TEST(BeliefShapes, WhatCouldNotBeMeasuredSaysNothing) {
  EXPECT_EQ(kAngle(std::numeric_limits<double>::quiet_NaN()), BinaryMass::vacuous());
}

RC_GTEST_PROP(BeliefShapesLaws, EveryValueGivesAMass, (int quantity)) {
  const RampBelief overlapping{.max_yes = .7,
                               .yes_full_until = .01,
                               .yes_zero_from = .04,
                               .max_no = .4,
                               .no_zero_until = .03,
                               .no_full_from = .08};
  const BinaryMass mass = overlapping(quantity * 1e-3);
  RC_ASSERT(std::abs(total(mass) - 1.0) < 1e-15);
  RC_ASSERT(mass.yes >= 0.0 && mass.no >= 0.0 && mass.unknown >= 0.0);
}

TEST(BeliefShapes, CheckAcceptsWhatIsAMassEverywhere) {
  EXPECT_NO_THROW(check(kAngle, "angle"));
  EXPECT_NO_THROW(check({.max_yes = .7, .yes_full_until = 1.0, .yes_zero_from = .2}, "density"));
}

TEST(BeliefShapes, CheckNamesTheParameterThatIsWrong) {
  const auto message = [](RampBelief shape) -> std::string {
    try {
      check(shape, "wall_angle");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  using ::testing::AllOf;
  using ::testing::Eq;
  using ::testing::HasSubstr;
  using ::testing::StartsWith;
  RampBelief shape = kAngle;
  shape.max_yes = 1.1;
  EXPECT_THAT(message(shape), Eq("wall_angle.max_yes: found 1.1, expected a number from 0 to 1"));
  shape = kAngle;
  shape.no_full_from = kInfinity;
  EXPECT_THAT(message(shape), Eq("wall_angle.no_full_from: found inf, expected a finite number"));
  shape = kAngle;
  shape.yes_full_until = 12.0;  // YES now grows with the quantity, and so does NO
  EXPECT_THAT(message(shape),
              AllOf(StartsWith("wall_angle: found max_yes "), HasSubstr("yes_full_until 12,"), HasSubstr("YES falls")));
  shape = kAngle;
  shape.no_zero_until = -20.0;
  shape.no_full_from = 0.0;
  EXPECT_THAT(message(shape), AllOf(StartsWith("wall_angle: found max_yes "), HasSubstr("more than 1 together")));
  // A step of NO at 1, where YES still has all of its mass: too much from there on, though not at 1 itself.
  shape = {.max_yes = 0.3,
           .yes_full_until = 2.0,
           .yes_zero_from = 3.0,
           .max_no = 0.8,
           .no_zero_until = 1.0,
           .no_full_from = 1.0};
  EXPECT_THAT(message(shape), AllOf(StartsWith("wall_angle: found max_yes "), HasSubstr("more than 1 together")));
}

}  // namespace
}  // namespace credo::evidence
