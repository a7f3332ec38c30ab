// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/motion_path.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/sensors/second.hpp"

namespace credo::sensors {
namespace {

using Rows = std::vector<OdometryReading>;

MotionPath straight_path() {  // 1 m/s along x, then at rest
  return MotionPath({{0, {0.0, 0.0, 0.0}}, {kSecond, {1.0, 0.0, 0.0}}, {2 * kSecond, {1.0, 0.0, 0.0}}});
}

TEST(MotionPath, EmptyOneIsTheIdentity) {
  EXPECT_TRUE(MotionPath().empty());
  EXPECT_EQ(MotionPath().pose_at(5), geometry::Pose2{});
  EXPECT_EQ(MotionPath().motion(0, kSecond), geometry::Pose2{});
}

TEST(MotionPath, OneRowRestsThere) {
  const MotionPath path(Rows{{kSecond, {1.0, 2.0, 0.5}}});
  for (const Timestamp time : {Timestamp{0}, kSecond, 100 * kSecond}) EXPECT_EQ(path.pose_at(time).x, 1.0);
}

TEST(MotionPath, InterpolatesBetweenRows) {
  EXPECT_NEAR(straight_path().pose_at(kSecond / 4).x, 0.25, 1e-12);
  EXPECT_NEAR(straight_path().pose_at(kSecond).x, 1.0, 1e-12);
  EXPECT_NEAR(straight_path().pose_at(3 * kSecond / 2).x, 1.0, 1e-12);
}

TEST(MotionPath, GoesOnWithItsVelocityForHalfASecondAndRestsThen) {
  EXPECT_NEAR(straight_path().pose_at(-kSecond / 4).x, -0.25, 1e-12);
  EXPECT_NEAR(straight_path().pose_at(-10 * kSecond).x, -0.5, 1e-12);
  EXPECT_NEAR(straight_path().pose_at(10 * kSecond).x, 1.0, 1e-12);
}

TEST(MotionPath, InterpolatesAcrossTheSeamOfAngles) {
  constexpr double kPi = std::numbers::pi;
  const MotionPath path({{0, {0.0, 0.0, kPi - 0.1}}, {kSecond, {0.0, 0.0, -kPi + 0.1}}});
  EXPECT_NEAR(std::abs(path.pose_at(kSecond / 2).theta), kPi, 1e-9);
}

TEST(MotionPath, MotionIsSeenFromWhereItStarts) {
  const MotionPath path({{0, {1.0, 1.0, std::numbers::pi / 2.0}}, {kSecond, {1.0, 3.0, std::numbers::pi / 2.0}}});
  const geometry::Pose2 motion = path.motion(0, kSecond);
  EXPECT_NEAR(motion.x, 2.0, 1e-12);
  EXPECT_NEAR(motion.y, 0.0, 1e-12);
  const geometry::Pose2 there_and_back = motion * path.motion(kSecond, 0);
  EXPECT_NEAR(there_and_back.x, 0.0, 1e-12);
}

TEST(MotionPath, OfEqualTimesTheLastRowCounts) {
  const MotionPath path({{0, {}}, {kSecond, {1.0, 0.0, 0.0}}, {kSecond, {2.0, 0.0, 0.0}}});
  EXPECT_EQ(path.rows().size(), 2U);
  EXPECT_EQ(path.pose_at(kSecond).x, 2.0);
}

TEST(MotionPath, RefusesWhatIsNoPath) {
  EXPECT_THROW(MotionPath(Rows{{1, {}}, {0, {}}}), std::invalid_argument);
  EXPECT_THROW(MotionPath(Rows{{0, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}}}), std::invalid_argument);
  EXPECT_THROW(MotionPath(Rows{{0, {0.0, 0.0, std::numeric_limits<double>::infinity()}}}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::sensors
