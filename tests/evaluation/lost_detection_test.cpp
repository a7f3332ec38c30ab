// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/lost_detection.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace credo::evaluation {
namespace {

using localization::Status;

constexpr sensors::Timestamp kSecond = 1'000'000'000;

/// Seconds after the start, error in x, status.
Sample sample(double second, double error_m, Status status) {
  Sample result;
  result.localization.time = static_cast<sensors::Timestamp>(second * 1e9);
  result.localization.estimate.pose = {error_m, 0.0, 0.0};
  result.localization.status = status;
  return result;
}

TEST(Auroc, IsTheShareOfOrderedPairs) {
  EXPECT_NEAR(*auroc(std::vector{0.9, 0.8}, std::vector{0.1, 0.2}), 1.0, 1e-12);
  EXPECT_NEAR(*auroc(std::vector{0.5}, std::vector{0.5}), 0.5, 1e-12);
  EXPECT_NEAR(*auroc(std::vector{0.9, 0.3}, std::vector{0.5, 0.1}), 0.75, 1e-12);
  EXPECT_FALSE(auroc(std::vector{0.9}, std::vector<double>{}));
}

TEST(DetectionCurve, IsTheOneCountedByHand) {
  // By falling suspicion: lost, fine, lost, fine.
  const DetectionCurve curve = detection_curve(std::vector{0.9, 0.8, 0.7, 0.1}, {true, false, true, false});
  ASSERT_EQ(curve.points.size(), 4U);
  EXPECT_EQ(curve.points[0].threshold, 0.9);
  EXPECT_NEAR(curve.points[0].recall, 0.5, 1e-12);
  EXPECT_NEAR(curve.points[0].precision, 1.0, 1e-12);
  EXPECT_NEAR(curve.points[1].false_alarm_share, 0.5, 1e-12);
  EXPECT_NEAR(curve.points[2].precision, 2.0 / 3, 1e-12);
  EXPECT_NEAR(curve.points[3].recall, 1.0, 1e-12);
  EXPECT_NEAR(*curve.auroc, 0.75, 1e-12);
  EXPECT_NEAR(*curve.average_precision, 0.5 * 1.0 + 0.5 * 2.0 / 3, 1e-12);
}

TEST(DetectionCurve, WhatKnowsNothingHasThePrecisionOfTheShareOfTheLost) {
  const DetectionCurve curve = detection_curve(std::vector{0.5, 0.5, 0.5, 0.5}, {true, false, false, false});
  EXPECT_EQ(curve.points.size(), 1U);
  EXPECT_NEAR(*curve.auroc, 0.5, 1e-12);
  EXPECT_NEAR(*curve.average_precision, 0.25, 1e-12);
}

TEST(DetectionCurve, TakesAnUnboundedSuspicionForTheHighest) {
  const double unbounded = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(*detection_curve(std::vector{unbounded, 1.0}, {true, false}).auroc, 1.0, 1e-12);
}

TEST(DetectionCurve, IsEmptyUnlessThereAreSomeOfBoth) {
  EXPECT_FALSE(detection_curve(std::vector{0.1, 0.2}, {false, false}).auroc);
  EXPECT_TRUE(detection_curve(std::vector{0.1, 0.2}, {true, true}).points.empty());
}

TEST(LostEpisodes, CountFromTheOnsetToTheAlert) {
  const EvaluatedRun run{.name = "",
                         .samples = {sample(0, 0.0, Status::kLocalized), sample(1, 0.3, Status::kLocalized),
                                     sample(2, 0.4, Status::kLocalized), sample(3.5, 0.5, Status::kUncertain),
                                     sample(4, 0.0, Status::kLocalized), sample(5, 1.0, Status::kLocalized),
                                     sample(6, 0.1, Status::kLocalized)}};
  const auto episodes = lost_episodes(run);
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_EQ(episodes[0].onset, kSecond);
  EXPECT_EQ(episodes[0].acquisitions, 3);
  ASSERT_TRUE(episodes[0].alert);
  EXPECT_EQ(episodes[0].alert->acquisitions, 3);
  EXPECT_NEAR(episodes[0].alert->seconds, 2.5, 1e-12);
  EXPECT_FALSE(episodes[1].alert) << "missed: it is over before an alert";
}

TEST(LostEpisodes, LosingThePoseIsAnAlertAndNoEnd) {
  const EvaluatedRun run{.name = "",
                         .samples = {sample(0, 1.0, Status::kLocalized), sample(1, 9.0, Status::kInitializing),
                                     sample(2, 1.0, Status::kLocalized)}};
  const auto episodes = lost_episodes(run);
  ASSERT_EQ(episodes.size(), 1U);
  EXPECT_EQ(episodes[0].acquisitions, 3);
  EXPECT_EQ(episodes[0].alert->acquisitions, 2);
}

TEST(Kidnaps, AreAnsweredBeforeTheNextOrTheEnd) {
  const EvaluatedRun run{
      .name = "",
      .samples = {sample(0, 0.0, Status::kLocalized), sample(1, 2.0, Status::kLocalized), sample(2, 2.0, Status::kLost),
                  sample(3, 0.1, Status::kUncertain), sample(4, 0.1, Status::kLocalized),
                  sample(5, 3.0, Status::kLocalized), sample(6, 3.0, Status::kLocalized)},
      .kidnaps = {kSecond / 2, 9 * kSecond / 2}};
  const auto answers = kidnaps(run);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].alert->acquisitions, 2);
  EXPECT_NEAR(answers[0].alert->seconds, 1.5, 1e-12);
  EXPECT_EQ(answers[0].recovery->acquisitions, 4);
  EXPECT_NEAR(answers[0].recovery->seconds, 3.5, 1e-12);
  EXPECT_FALSE(answers[1].alert);
  EXPECT_FALSE(answers[1].recovery) << "localized, but lost";
}

TEST(FalseAlarms, AreStretchesOfFalseAlerts) {
  EvaluatedRun run{.name = "",
                   .samples = {sample(0, 0.0, Status::kUncertain), sample(1, 0.0, Status::kUncertain),
                               sample(2, 0.0, Status::kLocalized), sample(3, 0.0, Status::kLost),
                               sample(4, 0.9, Status::kLost), sample(36, 0.0, Status::kUncertain)}};
  EXPECT_EQ(false_alarms(run).count, 3);
  EXPECT_NEAR(false_alarms(run).hours, 0.01, 1e-12);
  run.samples.back().degraded = true;
  EXPECT_EQ(false_alarms(run).count, 2);
}

}  // namespace
}  // namespace credo::evaluation
