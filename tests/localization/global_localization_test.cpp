// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "localization/localizer.hpp"
#include "tests/localization/drive.hpp"

namespace credo::localization {
namespace {

using namespace test;

constexpr Pose2 kStart{1.0, 1.5, 0.0};
constexpr Pose2 kStep{0.2, 0.0, 0.05};

bool is_lost(const Localization& fix, const Pose2& truth) {
  return position_error(fix, truth) > 0.25 ||
         std::abs(geometry::angle_difference(fix.estimate.pose.theta, truth.theta)) > geometry::to_radians(5.0);
}

TEST(GlobalLocalization, WithoutAnInitialPoseTheRobotFindsItselfOnTheWay) {
  Drive drive(5);
  Pipeline localize(room(), std::nullopt);
  Pose2 truth = kStart;
  Localization fix = localize(drive.acquire(truth, kStep));
  EXPECT_NE(fix.status, Status::kLocalized) << "one look confirms nothing";
  int steps = 0;
  for (; steps < 8 && fix.status != Status::kLocalized; ++steps)
    fix = localize(drive.acquire(truth = truth * kStep, kStep));
  EXPECT_LT(steps, 8);
  for (int i = 0; i < 5; ++i) {
    EXPECT_LT(position_error(fix, truth), 0.03);
    EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
    fix = localize(drive.acquire(truth = truth * kStep, kStep));
  }
}

TEST(GlobalLocalization, InARoomThatLooksTheSameBothWaysItStaysAmbiguousAndTellsBoth) {
  geometry::FloorPlan plan;
  plan.uncertainty_m = 0.005;
  plan.walls = {{{0, 0}, {6, 0}}, {{6, 0}, {6, 4}}, {{6, 4}, {0, 4}}, {{0, 4}, {0, 0}}};
  Drive drive(6, plan);
  Pipeline localize(plan, std::nullopt);
  Pose2 truth{1.5, 1.2, 0.3};
  for (int i = 0; i < 12; ++i) {
    const Localization fix = localize(drive.acquire(truth, kStep));
    EXPECT_EQ(fix.status, Status::kAmbiguous) << "acquisition " << i;
    ASSERT_EQ(fix.hypotheses.size(), 2U);
    const auto is_truth = [&](const Hypothesis& h) {
      return (h.pose.translation() - truth.translation()).norm() < 0.1;
    };
    EXPECT_TRUE(is_truth(fix.hypotheses[0]) || is_truth(fix.hypotheses[1]));
    EXPECT_LT(fix.hypotheses[0].belief, 0.9);
    EXPECT_GT(std::sqrt(fix.estimate.covariance(2, 2)), 1.0) << "the pose that is told is one of two";
    truth = truth * kStep;
  }
}

TEST(GlobalLocalization, CarriedAwayItSaysSoAtOnceAndFindsItself) {
  Drive drive(7);
  Pipeline localize(room(), given(kStart));
  Pose2 truth = kStart;
  for (int i = 0; i < 6; ++i)
    ASSERT_EQ(localize(drive.acquire(truth = truth * kStep, kStep)).status, Status::kLocalized);
  truth = {4.6, 3.2, -2.4};
  Localization fix;
  int steps = 0;
  do {
    fix = localize(drive.acquire(truth, kStep));
    EXPECT_FALSE(is_lost(fix, truth) && fix.status == Status::kLocalized) << "after " << steps;
    truth = truth * kStep;
  } while (fix.status != Status::kLocalized && ++steps < 10);
  EXPECT_LT(steps, 6);
  for (int i = 0; i < 3; ++i, truth = truth * kStep)
    EXPECT_LT(position_error(localize(drive.acquire(truth, kStep)), truth), 0.05);
}

TEST(GlobalLocalization, CarriedAShortWayItIsNotLocalizedBeforeThatIsConfirmed) {
  Drive drive(10);
  Pipeline localize(room(), given(kStart));
  Pose2 truth = kStart;
  for (int i = 0; i < 6; ++i)
    ASSERT_EQ(localize(drive.acquire(truth = truth * kStep, kStep)).status, Status::kLocalized);
  truth = {truth.x + 0.9, truth.y + 0.5, truth.theta};
  for (int i = 0; i < 2; ++i, truth = truth * kStep)
    EXPECT_NE(localize(drive.acquire(truth, kStep)).status, Status::kLocalized) << "after " << i;
  Localization fix;
  for (int i = 0; i < 6; ++i) fix = localize(drive.acquire(truth = truth * kStep, kStep));
  EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
  EXPECT_LT(position_error(fix, truth), 0.05);
}

TEST(GlobalLocalization, CarriedAwayAgainWhileItLooksForItselfItStartsAnew) {
  Drive drive(8);
  Pipeline localize(room(), given(kStart));
  Pose2 truth = kStart;
  for (int i = 0; i < 4; ++i) (void)localize(drive.acquire(truth = truth * kStep, kStep));
  truth = {4.6, 3.2, -2.4};
  for (int i = 0; i < 2; ++i) (void)localize(drive.acquire(truth = truth * kStep, kStep));
  truth = {2.7, 4.0, -1.3};
  Localization fix;
  for (int i = 0; i < 10; ++i) fix = localize(drive.acquire(truth = truth * kStep, kStep));
  EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
  EXPECT_LT(position_error(fix, truth), 0.05);
}

TEST(GlobalLocalization, AnInitialPoseThatIsFarOffIsNotFollowed) {
  for (const Pose2& wrong : {Pose2{2.5, 1.5, 0.0}, Pose2{1.0, 1.5, 1.2}, Pose2{4.5, 2.5, 3.0}}) {
    Drive drive(9);
    Pipeline localize(room(), given(wrong));
    Pose2 truth = kStart;
    Localization fix;
    for (int i = 0; i < 10; ++i) {
      fix = localize(drive.acquire(truth = truth * kStep, kStep));
      EXPECT_FALSE(is_lost(fix, truth) && fix.status == Status::kLocalized) << wrong << " after " << i;
    }
    EXPECT_EQ(fix.status, Status::kLocalized) << wrong;
    EXPECT_LT(position_error(fix, truth), 0.05) << wrong;
  }
}

}  // namespace
}  // namespace credo::localization
