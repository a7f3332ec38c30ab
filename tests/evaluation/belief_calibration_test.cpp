// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/belief_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::evaluation {
namespace {

TEST(Reliability, HasNoCalibrationErrorWhenFrequenciesMatch) {
  std::vector<double> p;
  std::vector<bool> hit;
  for (int i = 0; i < 100; ++i) {
    p.push_back(i < 50 ? 0.2 : 0.8);
    hit.push_back(i < 50 ? i % 5 == 0 : i % 5 != 0);
  }
  EXPECT_NEAR(calibration_error(p, hit), 0.0, 1e-12);
  EXPECT_NEAR(calibration_error(std::vector{0.9, 0.9}, {false, false}), 0.9, 1e-12);
}

TEST(Reliability, ScoresAreTheOnesOfTheirFormulas) {
  const Reliability r = reliability(std::vector{0.8, 0.4}, {true, false}, 1);
  EXPECT_NEAR(r.brier, 0.5 * (0.04 + 0.16), 1e-12);
  EXPECT_NEAR(r.log_loss, -0.5 * (std::log(0.8) + std::log(0.6)), 1e-12);
  EXPECT_NEAR(r.calibration_error, 0.1, 1e-12);  // 0.6 said, 0.5 came true
  ASSERT_EQ(r.bins.size(), 1U);
  EXPECT_NEAR(r.bins[0].probability, 0.6, 1e-12);
  EXPECT_EQ(r.bins[0].came_true.count, 1U);
}

TEST(Reliability, ACertaintyThatFailsCostsMuchAndNotEverything) {
  EXPECT_NEAR(reliability(std::vector{1.0}, {false}).log_loss, -std::log(1e-6), 1e-9);
  EXPECT_EQ(reliability(std::vector{1.0}, {true}).log_loss, 0.0);
  EXPECT_TRUE(reliability(std::vector<double>{}, {}).bins.empty());
}

std::vector<bool> outcomes(int count, int of) {
  std::vector<bool> result;
  for (int i = 0; i < of; ++i) result.push_back(i < count);
  return result;
}

TEST(IntervalCalibration, AnIntervalThatHoldsTheFrequencyAgrees) {
  const std::vector<evidence::BinaryMass> beliefs(100, evidence::BinaryMass{.yes = 0.5, .no = 0.3, .unknown = 0.2});
  const IntervalCalibration held = interval_calibration(beliefs, outcomes(60, 100));
  ASSERT_EQ(held.bins.size(), 1U);
  EXPECT_EQ(held.covered.count, 100U);
  EXPECT_NEAR(held.mean_width, 0.2, 1e-12);
  // Clopper and Pearson: 71 of 100 are compatible with a probability of 0.7, 90 of 100 are not.
  EXPECT_TRUE(interval_calibration(beliefs, outcomes(71, 100)).bins[0].agrees());
  EXPECT_FALSE(interval_calibration(beliefs, outcomes(90, 100)).bins[0].agrees());
  EXPECT_FALSE(interval_calibration(beliefs, outcomes(30, 100)).bins[0].agrees());
}

TEST(IntervalCalibration, IgnoranceIsNeverWrongAndWide) {
  const std::vector<evidence::BinaryMass> vacuous(50);
  for (const int count : {0, 25, 50}) {
    const IntervalCalibration c = interval_calibration(vacuous, outcomes(count, 50));
    EXPECT_EQ(*c.covered.share(), 1.0) << count;
    EXPECT_NEAR(c.mean_width, 1.0, 1e-12);
  }
}

TEST(IntervalCalibration, TellsBeliefsOfTheSameBetPApart) {
  std::vector<evidence::BinaryMass> beliefs(40);                                             // BetP 0.5, ignorant
  beliefs.resize(80, evidence::BinaryMass{.yes = 0.45, .no = 0.45, .unknown = 0.1});         // BetP 0.5, committed
  const IntervalCalibration c = interval_calibration(beliefs, std::vector<bool>(80, true));  // always true
  ASSERT_EQ(c.bins.size(), 2U);
  EXPECT_TRUE(c.bins[0].agrees());
  EXPECT_FALSE(c.bins[1].agrees());
  EXPECT_NEAR(*c.covered.share(), 0.5, 1e-12);
}

Sample believed(double yes, double error_m) {
  Sample result;
  result.localization.status = localization::Status::kLocalized;
  result.localization.estimate.pose = {error_m, 0.0, 0.0};
  result.localization.belief = {.yes = yes, .no = 1.0 - yes, .unknown = 0.0};
  return result;
}

TEST(RiskCoverage, AcceptsTheBestBelievedFirstAndEqualsTogether) {
  const std::vector<EvaluatedRun> runs{{.name = "", .samples = {believed(0.2, 1.0), believed(0.9, 0.1)}},
                                       {.name = "", .samples = {believed(0.5, 0.2), believed(0.5, 0.3)}}};
  const auto curve = risk_coverage(runs);
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_NEAR(curve[0].coverage, 0.25, 1e-12);
  EXPECT_NEAR(curve[0].mean_position_m, 0.1, 1e-12);
  EXPECT_EQ(curve[0].lost, 0.0);
  EXPECT_NEAR(curve[1].coverage, 0.75, 1e-12);
  EXPECT_NEAR(curve[1].mean_position_m, 0.2, 1e-12);
  EXPECT_NEAR(curve[1].lost, 1.0 / 3, 1e-12);
  EXPECT_NEAR(curve[2].lost, 0.5, 1e-12);
  EXPECT_NEAR(*area_under_risk(curve), 0.5 / 3 + 0.25 * 0.5, 1e-12);
  EXPECT_FALSE(area_under_risk({}));
}

}  // namespace
}  // namespace credo::evaluation
