// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "localization/localizer.hpp"
#include "tests/localization/drive.hpp"

namespace credo::localization {
namespace {

using namespace test;

const Pose2 kStep{0.15, 0.0, 0.06};

TEST(PoseByHand, ARobotThatIsToldGoesOnFromThereAndIsTrustedOnceItIsBorneOut) {
  Drive drive(21);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  Pose2 truth{1.0, 1.5, 0.0};
  for (int i = 0; i < 3; ++i) (void)localize(drive.acquire(truth = truth * kStep, kStep));
  truth = {4.5, 2.0, 2.0};  // carried there
  localize.localizer.set_pose(given(truth * Pose2{0.04, -0.03, 0.02}));
  Localization fix = localize(drive.acquire(truth, kStep));
  EXPECT_LT(position_error(fix, truth), 0.03);
  EXPECT_EQ(fix.status, Status::kUncertain) << "nothing has borne it out yet";
  for (int i = 0; i < 6; ++i) {
    fix = localize(drive.acquire(truth = truth * kStep, kStep));
    EXPECT_LT(position_error(fix, truth), 0.03);
  }
  EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
  // The fixes before are not mixed with those after.
  const auto between = localize.localizer.pose_at(fix.time - 500'000'000).value.pose;
  EXPECT_LT((between.translation() - truth.translation()).norm(), 0.15);
}

TEST(PoseByHand, AWrongOneIsNotTrusted) {
  Drive drive(22);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  Pose2 truth{1.0, 1.5, 0.0};
  for (int i = 0; i < 3; ++i) (void)localize(drive.acquire(truth = truth * kStep, kStep));
  localize.localizer.set_pose(given({4.3, 2.6, 1.0}));
  for (int i = 0; i < 8; ++i) {
    const Localization fix = localize(drive.acquire(truth = truth * kStep, kStep));
    EXPECT_TRUE(position_error(fix, truth) < 0.25 || fix.status != Status::kLocalized) << i;
  }
}

TEST(PoseByHand, BeforeTheFirstAcquisitionItIsTheInitialPose) {
  Drive drive(23);
  Pipeline localize(room(), std::nullopt);
  const Pose2 truth{1.0, 1.5, 0.0};
  localize.localizer.set_pose(given(truth));
  const Localization fix = localize(drive.acquire(truth, {}));
  EXPECT_LT(position_error(fix, truth), 0.03);
  EXPECT_NE(fix.status, Status::kInitializing);
}

TEST(PoseByHand, WithoutAPlanMotionGoesOnFromIt) {
  Drive drive(24);
  Pipeline localize({}, std::nullopt);
  Pose2 truth{1.0, 1.5, 0.0};
  for (int i = 0; i < 3; ++i) (void)localize(drive.acquire(truth = truth * kStep, kStep));
  localize.localizer.set_pose(given(truth = truth * kStep));
  Localization fix = localize(drive.acquire(truth, kStep));
  EXPECT_LT(position_error(fix, truth), 1e-9);
  for (int i = 0; i < 6; ++i) fix = localize(drive.acquire(truth = truth * kStep, kStep));
  EXPECT_LT(position_error(fix, truth), 0.05);
  EXPECT_EQ(fix.status, Status::kInitializing);
}

}  // namespace
}  // namespace credo::localization
