// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/localization_score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

namespace credo::evaluation {
namespace {

using localization::Status;
using results::LocalizationRow;

constexpr sensors::Timestamp kSecond = 1'000'000'000;

/// An acquisition at second `index` with the given error in x and heading.
LocalizationRow row(int index, double error_m, double error_deg, double yes, Status status = Status::kLocalized) {
  LocalizationRow result;
  auto& l = result.localization;
  l.time = index * kSecond;
  l.estimate.pose = {index + error_m, 0.0, geometry::to_radians(error_deg)};
  l.estimate.covariance.diagonal() << 0.01, 0.01, 0.01;
  l.belief = {.yes = yes, .no = 0.0, .unknown = 1.0 - yes};
  l.status = status;
  return result;
}

std::vector<datasets::TimedPose> truth(int count) {
  std::vector<datasets::TimedPose> result;
  for (int i = 0; i < count; ++i) result.push_back({i * kSecond, {static_cast<double>(i), 0.0, 0.0}});
  return result;
}

LocalizationScore score_of(const std::vector<LocalizationRow>& rows,
                           const std::optional<std::vector<Interval>>& degraded = {}) {
  return score(rows, truth(static_cast<int>(rows.size())), degraded);
}

TEST(LocalizationScore, MeansAreOverPositionAndHeading) {
  const auto s = score_of({row(0, 0.03, -1.0, 0.9), row(1, -0.01, 2.0, 0.9), row(2, 0.02, 0.0, 0.9)});
  EXPECT_NEAR(s.mean_position_m, 0.02, 1e-12);
  EXPECT_NEAR(s.median_position_m, 0.02, 1e-12);
  EXPECT_NEAR(s.max_position_m, 0.03, 1e-12);
  EXPECT_NEAR(s.mean_heading_rad, geometry::to_radians(1.0), 1e-12);
}

TEST(LocalizationScore, HeadingsWrap) {
  auto r = row(0, 0.0, 0.0, 0.9);
  r.localization.estimate.pose.theta = std::numbers::pi - 0.01;
  const std::vector<datasets::TimedPose> reference{{0, {0, 0, -std::numbers::pi + 0.02}}};
  EXPECT_NEAR(score(std::vector{r}, reference).mean_heading_rad, 0.03, 1e-12);
}

TEST(LocalizationScore, ConfidentIsLocalizedAndBelievedAndJudgedByBothLimits) {
  const auto s = score_of({row(0, 0.31, 0, 0.81), row(1, 0.0, 11, 0.81), row(2, 0.29, 9, 0.81), row(3, 0.0, 0, 0.80),
                           row(4, 5.0, 0, 0.99, Status::kUncertain), row(5, 5.0, 0, 0.5)});
  EXPECT_NEAR(s.confidently_wrong, 2.0 / 6, 1e-12);
  EXPECT_NEAR(s.confidently_right, 1.0 / 6, 1e-12);
}

TEST(LocalizationScore, LostAlertAndFalseAlert) {
  const auto rows = std::vector{row(0, 0.26, 0, 0.2, Status::kLost), row(1, 0.0, 5.1, 0.2, Status::kUncertain),
                                row(2, 0.1, 1, 0.4, Status::kUncertain), row(3, 0.1, 1, 0.4, Status::kAmbiguous),
                                row(4, 0.0, 0, 0.9)};
  const auto s = score_of(rows);
  EXPECT_NEAR(s.lost, 2.0 / 5, 1e-12);
  EXPECT_NEAR(s.alert, 4.0 / 5, 1e-12);
  EXPECT_NEAR(s.false_alert, 2.0 / 5, 1e-12);
  const std::vector<Interval> degraded{{2 * kSecond, 2 * kSecond + 1}};
  EXPECT_NEAR(score_of(rows, degraded).false_alert, 1.0 / 5, 1e-12);
}

TEST(LocalizationScore, FalseAlertsAreABoundWhereNobodyRecordedDegradedSensors) {
  const auto rows = std::vector{row(0, 0.0, 0, 0.4, Status::kUncertain)};
  EXPECT_FALSE(score_of(rows).degradation_known);
  EXPECT_THAT(to_text(score_of(rows)), testing::HasSubstr("or less: no events.csv"));
  const std::vector<Interval> none;
  EXPECT_TRUE(score_of(rows, none).degradation_known);
  EXPECT_THAT(to_text(score_of(rows, none)), testing::HasSubstr("no sensor degraded"));
}

TEST(LocalizationScore, AvailabilityNeedsAMonitor) {
  EXPECT_FALSE(score_of({row(0, 0, 0, 0.9)}).available);
  auto tight = row(0, 0.2, 0, 0.9), loose = row(1, 0.0, 0, 0.9), honest = row(2, 0.2, 0, 0.9);
  tight.localization.protection = {0.0, 0.1, 0.0, 0.05};
  loose.localization.protection = {0.0, 0.6, 0.0, 0.05};
  honest.localization.protection = {0.0, 0.3, 0.0, 0.05};
  const auto s = score_of({tight, loose, honest});
  EXPECT_NEAR(*s.available, 2.0 / 3, 1e-12);
  EXPECT_NEAR(*s.misleading, 1.0 / 3, 1e-12);
}

TEST(LocalizationScore, NeesAndSigmasAreThoseOfTheCovariance) {
  const auto s = score_of({row(0, 0.1, 0, 0.9), row(1, 0.31, 0, 0.9)});  // sigma 0.1
  EXPECT_NEAR(s.anees, 0.5 * (1.0 + 9.61), 1e-9);
  EXPECT_NEAR(s.inside_3_sigma, 0.5, 1e-12);
}

TEST(LocalizationScore, RefusesATruthOfAnotherTime) {
  std::vector<datasets::TimedPose> other{{100 * kSecond, {}}};
  EXPECT_THAT([&] { (void)score(std::vector{row(0, 0, 0, 0.9)}, other); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("belong together")));
}

TEST(LocalizationScore, WithoutAPoseInTheMapThereIsAnAlertAndNoError) {
  const auto s = score_of({row(0, 5.0, 0, 0.5, Status::kInitializing), row(1, 0.02, 0, 0.9)});
  EXPECT_EQ(s.placed, 1);
  EXPECT_NEAR(s.max_position_m, 0.02, 1e-12);
  EXPECT_NEAR(s.alert, 0.5, 1e-12);
  EXPECT_EQ(s.lost, 0.0);
  EXPECT_EQ(s.false_alert, 0.0);
  EXPECT_THAT(to_text(s), testing::HasSubstr("1 of them are initializing"));
  EXPECT_THROW((void)score_of({row(0, 0.0, 0, 0.5, Status::kInitializing)}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
