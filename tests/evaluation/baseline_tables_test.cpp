// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation/baseline_association_table.hpp"
#include "evaluation/baseline_localizer.hpp"
#include "evaluation/baseline_table.hpp"
#include "tests/evaluation/simulated_room.hpp"

namespace credo::evaluation {
namespace {

using testing::HasSubstr;

constexpr sensors::Timestamp kSecond = 1'000'000'000;

/// A robot that rests at the origin; the answer is off by `error_m` along x.
results::LocalizationRow row(int second, double error_m, double sigma_m, double confidence) {
  auto fix = baseline_fix(second * kSecond, test::believed({error_m, 0.0, 0.0}, sigma_m, 0.005), confidence);
  fix.protection = gaussian_protection(fix.estimate);
  return {fix};
}

std::vector<datasets::TimedPose> at_rest(int seconds) {
  std::vector<datasets::TimedPose> truth;
  for (int s = 0; s < seconds; ++s) truth.push_back({s * kSecond, {}});
  return truth;
}

TEST(GaussianProtection, ReachesAlongTheLongestAxisOfTheEllipse) {
  geometry::PoseEstimate estimate;
  estimate.covariance(2, 2) = 1e-4;
  estimate.covariance.topLeftCorner<2, 2>() << 0.5, 0.5, 0.5, 0.5;  // 1 m along the diagonal, nothing across
  const localization::ProtectionLevels level = gaussian_protection(estimate);
  EXPECT_NEAR(level.position_high_m, 4.417, 1e-9);
  EXPECT_NEAR(level.heading_high_rad, 0.04417, 1e-9);
  EXPECT_NEAR(std::erfc(kProtectionFactor / std::sqrt(2.0)), 1e-5, 1e-8);
}

TEST(LocalizerTable, CountsWhatIsLostAvailableAndMisleading) {
  const std::vector rows{row(0, 0.02, 0.02, 0.9),   // fine
                         row(1, 0.20, 0.02, 0.8),   // misleading: the level is 9 cm
                         row(2, 0.10, 0.20, 0.7),   // the level, 88 cm, is too large to be available
                         row(3, 0.30, 0.02, 0.1)};  // lost, and misleading
  const LocalizerSummary s = summarise(record(rows, at_rest(4), 0.008));
  EXPECT_EQ(s.acquisitions, 4);
  EXPECT_NEAR(s.mean_position_m, 0.155, 1e-12);
  EXPECT_NEAR(s.p95_position_m, 0.30, 1e-12);
  EXPECT_NEAR(s.lost, 0.25, 1e-12);
  EXPECT_NEAR(s.available, 0.75, 1e-12);
  EXPECT_NEAR(s.misleading, 0.5, 1e-12);
  EXPECT_EQ(s.auroc, 1.0);
  EXPECT_NEAR(s.ms_per_update, 2.0, 1e-12);
}

TEST(LocalizerTable, DrivesAddUpAndWhatHasNoTruthIsLeftOut) {
  const std::vector rows{row(0, 0.1, 0.02, 0.9), row(1, 0.3, 0.02, 0.9), row(7, 9.0, 0.02, 0.9)};
  LocalizerRecord all = record(rows, at_rest(2), 1.0);
  all += record(rows, at_rest(1), 1.0);
  EXPECT_EQ(summarise(all).acquisitions, 3);
  EXPECT_NEAR(summarise(all).mean_position_m, 0.5 / 3.0, 1e-12);
  EXPECT_THROW((void)summarise(record(rows, {}, 1.0)), std::invalid_argument);
}

TEST(LocalizerTable, SaysWhatDidNotRun) {
  const std::vector<LocalizerLine> lines{
      {"somebody's \"filter\"", "built without it"},
      {"ours", "", summarise(record(std::vector{row(0, 0.1, 0.1, 1.0)}, at_rest(1), 0.0))}};
  EXPECT_THAT(to_text(lines), HasSubstr("not run: built without it"));
  EXPECT_THAT(to_csv("a place", lines),
              HasSubstr("a place,\"somebody's \"\"filter\"\"\",,,,,,,,,,,,built without it\n"));
  const auto commas = [](const std::string& text) { return std::ranges::count(text, ','); };
  EXPECT_EQ(commas(to_csv("a", lines)), 2 * commas(localizer_csv_header()));
}

/// What a robot in the room sees of its points, under the type that they have from there.
perception::Scene points_seen(const localization::LandmarkMap& map, const geometry::Pose2& from) {
  perception::Scene scene;
  for (const localization::PointLandmark& point : map.points()) {
    const auto type = map.type_from(point, from.translation());
    if (!type || !map.shows(from.translation(), point.position)) continue;
    perception::Primitive& seen = scene.primitives.emplace_back();
    seen.type = *type;
    seen.position = from.inverse() * point.position;
    seen.position_covariance = 1e-4 * Eigen::Matrix2d::Identity();
    seen.azimuth = std::atan2(seen.position.y(), seen.position.x());
    seen.range_m = seen.position.norm();
    seen.sigma_azimuth = 0.003;
    seen.sigma_range_m = 0.01;
    seen.existence = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  }
  return scene;
}

class AssociationTable : public testing::Test {
 protected:
  localization::LandmarkMap map_{test::room()};
  geometry::Pose2 before_{2.0, 1.5, 0.3}, step_{0.2, 0.0, 0.1}, now_ = before_ * step_;
  geometry::PoseEstimate motion_ = test::believed(step_, 0.01, 0.01);
};

TEST_F(AssociationTable, EveryMethodFindsWhatIsThereAndAlone) {
  AssociationComparison comparison(map_);
  const perception::Scene scene = points_seen(map_, now_);
  comparison.add(points_seen(map_, before_), before_, scene, now_, motion_);
  ASSERT_GE(scene.primitives.size(), 5u);
  for (const AssociationCounts& c : comparison.counts()) {
    EXPECT_EQ(c.wrong, 0) << c.name;
    EXPECT_GE(c.recall().value_or(0.0), 0.8) << c.name;
  }
}

TEST_F(AssociationTable, WhatIsGoneIsAbsentAndWhatStandsBesideIsWrong) {
  AssociationComparison comparison(map_);
  perception::Scene scene = points_seen(map_, now_);
  const auto landmarks = static_cast<long>(points_seen(map_, before_).primitives.size());
  perception::Scene nothing = scene;
  nothing.primitives.clear();
  comparison.add(points_seen(map_, before_), before_, nothing, now_, motion_);
  for (const AssociationCounts& c : comparison.counts()) {
    EXPECT_EQ(c.absent, landmarks) << c.name;
    EXPECT_FALSE(c.wrong_share().has_value()) << c.name;
  }
  // All that is seen has moved by more than what counts as right, and by less than the gate.
  for (perception::Primitive& seen : scene.primitives) seen.azimuth += 0.022;
  comparison.add(points_seen(map_, before_), before_, scene, now_, motion_);
  EXPECT_GT(comparison.counts().front().wrong, 0);
  EXPECT_EQ(comparison.counts().front().right, 0);
}

TEST(AssociationText, LeavesEmptyWhatCannotBeSaid) {
  EXPECT_THAT(to_text(std::vector<AssociationCounts>{{.name = "nobody"}}), HasSubstr("-         -"));
}

}  // namespace
}  // namespace credo::evaluation
