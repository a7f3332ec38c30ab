// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/proportion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::evaluation {
namespace {

TEST(Proportion, OfNothingFoundIsBoundedByTheRuleOfThree) {
  const Proportion none{.count = 0, .of = 30'000};
  EXPECT_NEAR(none.upper_bound(), 1.0 - std::pow(0.05, 1.0 / 30'000), 1e-12);
  EXPECT_NEAR(none.upper_bound(), 3.0 / 30'000, 1e-6);
  EXPECT_EQ(none.interval().lower, 0.0);
}

TEST(Proportion, HasTheIntervalOfClopperAndPearson) {
  const Bounds b = Proportion{.count = 5, .of = 10}.interval();  // R: binom.test(5, 10)
  EXPECT_NEAR(b.lower, 0.1870860, 1e-6);
  EXPECT_NEAR(b.upper, 0.8129140, 1e-6);
  EXPECT_FALSE(Proportion{}.share());
  EXPECT_EQ(Proportion{}.upper_bound(), 1.0);
}

}  // namespace
}  // namespace credo::evaluation
