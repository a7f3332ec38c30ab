// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_history.hpp"

#include <gtest/gtest.h>

namespace credo::localization {
namespace {

constexpr sensors::Timestamp kSecond = 1'000'000'000;

Fix fix_at(double x, double variance, double yes, sensors::Timestamp time) {
  Fix fix;
  fix.time = time;
  fix.estimate.pose = {x, 0.0, 0.0};
  fix.estimate.covariance = variance * Eigen::Matrix3d::Identity();
  fix.belief = {.yes = yes, .no = 0.0, .unknown = 1.0 - yes};
  return fix;
}

TEST(PoseHistory, TheLatestFixIsCarriedAlongThePath) {
  PoseHistory history;
  EXPECT_TRUE(history.empty());
  history.add(fix_at(5.0, 0.01, 0.9, 10 * kSecond));
  history.follow(sensors::MotionPath({{10 * kSecond, {1, 1, 0}}, {11 * kSecond, {2, 1, 0}}}));
  EXPECT_DOUBLE_EQ(history.pose_at(10 * kSecond).value.pose.x, 5.0);
  EXPECT_NEAR(history.pose_at(10 * kSecond + kSecond / 4).value.pose.x, 5.25, 1e-9);
}

TEST(PoseHistory, BetweenFixesWhatThePathMissesIsSpreadOverTheWay) {
  PoseHistory history;
  history.add(fix_at(0.0, 0.01, 0.9, 0));
  history.follow(sensors::MotionPath({{0, {}}, {2 * kSecond, {1, 0, 0}}}));
  history.add(fix_at(1.2, 0.03, 0.5, 2 * kSecond));
  const auto half = history.pose_at(kSecond);
  EXPECT_NEAR(half.value.pose.x, 0.6, 1e-9) << "half of the path's 1 m and of the missing 0.2 m";
  EXPECT_NEAR(half.value.covariance(0, 0), 0.02, 1e-12);
  EXPECT_DOUBLE_EQ(half.belief.yes, 0.5) << "the weaker belief";
  EXPECT_NEAR(history.pose_at(2 * kSecond).value.pose.x, 1.2, 1e-9);
}

TEST(PoseHistory, BeforeTheEarlierFixTheLatestIsCarriedBack) {
  PoseHistory history;
  history.add(fix_at(0.0, 0.01, 0.9, kSecond));
  history.follow(sensors::MotionPath({{0, {}}, {3 * kSecond, {3, 0, 0}}}));
  history.add(fix_at(1.5, 0.01, 0.5, 2 * kSecond));
  EXPECT_NEAR(history.pose_at(0).value.pose.x, -0.5, 1e-9);
}

}  // namespace
}  // namespace credo::localization
