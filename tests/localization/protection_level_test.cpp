// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/protection_level.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace credo::localization {
namespace {

constexpr double kRisk = 1e-5;

FaultHypothesis hypothesis(double probability, double separation_m, double sigma_m) {
  return {{probability, probability}, separation_m, 0.0, sigma_m, 1.0};
}

TEST(ProtectionLevel, OfNoFaultIsTheQuantileOfTheLengthOfANormalError) {
  const std::vector hypotheses{hypothesis(1.0, 0.0, 0.01)};
  const double exact = 0.01 * std::sqrt(-2.0 * std::log(kRisk));
  const double level = ProtectionLevel()(hypotheses, {}, kRisk, 100.0);
  EXPECT_GE(level, exact * 0.999);
  EXPECT_LE(level, exact * 1.03);
}

TEST(ProtectionLevel, OfALikelyFaultIsBeyondItsSeparation) {
  const std::vector hypotheses{hypothesis(1.0, 0.0, 0.01), hypothesis(1e-3, 0.3, 0.02)};
  const double level = ProtectionLevel()(hypotheses, {}, kRisk, 100.0);
  EXPECT_NEAR(level, 0.3 + 0.02 * std::sqrt(-2.0 * std::log(1e-2)), 0.01);
}

TEST(ProtectionLevel, OfAFaultThatIsRarerThanTheRiskIsThatWithoutIt) {
  const std::vector hypotheses{hypothesis(1.0, 0.0, 0.01), hypothesis(1e-7, 5.0, 0.02)};
  EXPECT_LT(ProtectionLevel()(hypotheses, {}, kRisk, 100.0), 0.06);
}

TEST(ProtectionLevel, IsInfiniteWhereTheRestDoesNotDetermineThePose) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector hypotheses{hypothesis(1.0, 0.0, 0.01), hypothesis(1e-3, 0.0, infinity)};
  EXPECT_EQ(ProtectionLevel()(hypotheses, {}, kRisk, 100.0), infinity);
}

TEST(ProtectionLevel, OfTheLowEndIsThatOfTheLowProbabilities) {
  const std::vector<FaultHypothesis> hypotheses{{{1.0, 1.0}, 0.0, 0.0, 0.01, 0.001},
                                                {{0.0, 1e-2}, 0.2, 0.1, 0.02, 0.002}};
  const FaultComponent low{.end = &ProbabilityInterval::low};
  EXPECT_LT(ProtectionLevel()(hypotheses, low, kRisk, 100.0), 0.06);
  EXPECT_GT(ProtectionLevel()(hypotheses, {}, kRisk, 100.0), 0.2);
  const FaultComponent heading{.separation = &FaultHypothesis::separation_rad, .sigma = &FaultHypothesis::sigma_rad};
  EXPECT_NEAR(ProtectionLevel()(hypotheses, heading, kRisk, 3.0), 0.1 + 0.002 * std::sqrt(-2.0 * std::log(1e-3)),
              0.003);
}

}  // namespace
}  // namespace credo::localization
