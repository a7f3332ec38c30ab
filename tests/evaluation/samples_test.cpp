// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::evaluation {
namespace {

constexpr sensors::Timestamp kSecond = 1'000'000'000;

results::LocalizationRow row(sensors::Timestamp time) {
  results::LocalizationRow result;
  result.localization.time = time;
  return result;
}

TEST(EvaluatedRun, KeepsWhatHasATruthAndWhatIsKnownToHaveHappened) {
  const std::vector<results::LocalizationRow> rows{row(0), row(kSecond), row(5 * kSecond)};
  const std::vector<datasets::TimedPose> truth{{0, {1, 2, 0}}, {kSecond, {2, 2, 0}}};
  const EvaluatedRun run = evaluated_run(
      "drive", rows, truth, std::vector<datasets::Event>{{kSecond, "camera0_failed"}, {kSecond, "kidnapped"}});
  ASSERT_EQ(run.samples.size(), 2U);
  EXPECT_EQ(run.samples[1].truth, (geometry::Pose2{2, 2, 0}));
  EXPECT_FALSE(run.samples[0].degraded);
  EXPECT_TRUE(run.samples[1].degraded);
  EXPECT_EQ(run.kidnaps, (std::vector<sensors::Timestamp>{kSecond}));
  EXPECT_TRUE(run.events_known);
  EXPECT_FALSE(evaluated_run("drive", rows, truth).events_known);
}

TEST(EvaluatedRun, RefusesATruthOfAnotherTime) {
  const std::vector<datasets::TimedPose> truth{{100 * kSecond, {}}};
  EXPECT_THAT([&] { (void)evaluated_run("drive", std::vector{row(0)}, truth); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("belong together")));
}

TEST(DegradedIntervals, RunFromTheFirstEventOfASensorToItsRestoration) {
  const auto intervals = degraded_intervals({{1, "camera0_degraded"},
                                             {2, "camera0_failed"},
                                             {3, "range0_failed"},
                                             {4, "lights_off"},
                                             {5, "camera0_restored"},
                                             {6, "camera0_restored"}});
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_EQ(intervals[0], (Interval{1, 5}));
  EXPECT_EQ(intervals[1].first, 3);
  EXPECT_GT(intervals[1].second, sensors::kLatestTime) << "never restored";
}

TEST(TruthAt, InterpolatesShortGapsOnly) {
  const std::vector<datasets::TimedPose> rows{{0, {0, 0, 0}}, {kSecond / 10, {1, 0, 0}}, {2 * kSecond, {9, 0, 0}}};
  EXPECT_NEAR(truth_at(rows, kSecond / 20)->x, 0.5, 1e-12);
  EXPECT_NEAR(truth_at(rows, kSecond / 10 + 9'000'000)->x, 1.0, 1e-12);
  EXPECT_FALSE(truth_at(rows, kSecond));
  EXPECT_NEAR(truth_at(rows, 2 * kSecond + 5'000'000)->x, 9.0, 1e-12);
  EXPECT_FALSE(truth_at(rows, 3 * kSecond));
  EXPECT_FALSE(truth_at({}, 0));
}

}  // namespace
}  // namespace credo::evaluation
