// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/predictive_belief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

/// P(X >= k) of n trials that succeed with probability p, by summing the binomial probabilities.
double at_least(int k, int n, double p) {
  double sum = 0.0;
  for (int i = k; i <= n; ++i) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  }
  return sum;
}

TEST(PredictiveBelief, HasTheBoundsOfClopperAndPearson) {
  const BinaryMass half = predictive_belief(5, 10, .95);
  EXPECT_NEAR(half.belief(), .1871, 5e-5);
  EXPECT_NEAR(half.plausibility(), .8129, 5e-5);
  const BinaryMass one = predictive_belief(1, 10, .95);
  EXPECT_NEAR(one.belief(), .0025, 5e-5);
  EXPECT_NEAR(one.plausibility(), .4450, 5e-5);
}

TEST(PredictiveBelief, OneSidedTrialsHaveAClosedForm) {
  for (const std::size_t n : {1u, 3u, 40u, 5000u}) {
    const double bound = std::pow(.025, 1.0 / static_cast<double>(n));
    EXPECT_LT(distance(predictive_belief(n, n, .95), {bound, 0.0, 1.0 - bound}), 1e-12);
    EXPECT_LT(distance(predictive_belief(0, n, .95), {0.0, bound, 1.0 - bound}), 1e-12);
  }
}

TEST(PredictiveBelief, WithoutATrialNothingIsKnown) { EXPECT_EQ(predictive_belief(0, 0, .99), BinaryMass::vacuous()); }

TEST(PredictiveBelief, AMillionTrialsLeaveTheNormalInterval) {
  const BinaryMass mass = predictive_belief(300'000, 1'000'000, .95);
  const double half_width = 1.959964 * std::sqrt(.3 * .7 / 1e6);
  EXPECT_NEAR(mass.belief(), .3 - half_width, 2e-6);
  EXPECT_NEAR(mass.plausibility(), .3 + half_width, 2e-6);
}

TEST(PredictiveBelief, RefusesWhatIsNoSeriesAndNoConfidence) {
  EXPECT_THROW(static_cast<void>(predictive_belief(4, 3, .95)), std::invalid_argument);
  for (const double confidence : {0.0, 1.0, -.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(static_cast<void>(predictive_belief(1, 3, confidence)), std::invalid_argument);
  }
}

RC_GTEST_PROP(PredictiveBeliefLaws, WhatHappenedIsJustNotTooRareAtTheBounds, ()) {
  const int n = *rc::gen::inRange(1, 300);
  const int k = *rc::gen::inRange(0, n + 1);
  const double confidence = *rc::gen::element(.5, .8, .95, .999);
  const double tail = (1.0 - confidence) / 2.0;
  const BinaryMass mass = predictive_belief(static_cast<std::size_t>(k), static_cast<std::size_t>(n), confidence);
  if (k > 0) RC_ASSERT(std::abs(at_least(k, n, mass.yes) - tail) < 1e-10);
  if (k < n) RC_ASSERT(std::abs(at_least(n - k, n, mass.no) - tail) < 1e-10);
  RC_ASSERT(mass.yes <= static_cast<double>(k) / n && static_cast<double>(k) / n <= mass.plausibility());
}

RC_GTEST_PROP(PredictiveBeliefLaws, MoreTrialsOrLessConfidenceLeaveLessUnknown, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 200);
  const auto k = *rc::gen::inRange<std::size_t>(0, n + 1);
  const BinaryMass mass = predictive_belief(k, n, .9);
  RC_ASSERT(predictive_belief(2 * k, 2 * n, .9).unknown < mass.unknown);
  RC_ASSERT(predictive_belief(k, n, .8).unknown < mass.unknown);
  const BinaryMass failures = predictive_belief(n - k, n, .9);
  RC_ASSERT(distance({failures.no, failures.yes, failures.unknown}, mass) == 0.0);
}

/// The promise itself, exactly: over all outcomes of n trials, weighted by their probability.
RC_GTEST_PROP(PredictiveBeliefLaws, HoldsTheTrueProbabilityAtLeastAsOftenAsStated, ()) {
  const int n = *rc::gen::inRange(1, 60);
  const double p = *rc::gen::inRange(1, 100) / 100.0;
  double held = 0.0;
  for (int k = 0; k <= n; ++k) {
    const BinaryMass mass = predictive_belief(static_cast<std::size_t>(k), static_cast<std::size_t>(n), .9);
    if (mass.belief() <= p && p <= mass.plausibility()) held += at_least(k, n, p) - at_least(k + 1, n, p);
  }
  RC_ASSERT(held >= .9 - 1e-9);
}

}  // namespace
}  // namespace credo::evidence
