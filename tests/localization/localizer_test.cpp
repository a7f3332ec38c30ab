// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localizer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/localization/drive.hpp"

namespace credo::localization {
namespace {

using namespace test;

TEST(Localizer, FollowsADriveFromAnInitialPoseThatIsSomewhatWrong) {
  Drive drive(3);
  Pipeline localize(room(), given({1.05, 1.46, 0.03}));
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.2, 0.0, 0.05};
  for (int i = 0; i < 18; ++i) {
    const Localization fix = localize(drive.acquire(truth, step));
    EXPECT_LT(position_error(fix, truth), 0.02) << "acquisition " << i;
    EXPECT_LT(std::abs(geometry::angle_difference(fix.estimate.pose.theta, truth.theta)), 0.01) << "acquisition " << i;
    EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
    EXPECT_GT(fix.belief.yes, 0.8) << "acquisition " << i;
    truth = truth * step;
  }
}

TEST(Localizer, WhatScattersMoreThanItsModelIsKnownLessWell) {
  const auto variance_after_a_drive = [](double noise_m) {
    const Pose2 start{1.0, 1.0, 0.3}, step{0.2, 0.0, 0.08};
    Drive drive(3, room(), noise_m);
    Pipeline localize(room(), given(start));
    Localization fix;
    Pose2 truth = start;
    for (int i = 0; i < 6; ++i) fix = localize(drive.acquire(truth = truth * step, step));
    return fix.estimate.covariance.topLeftCorner<2, 2>().trace();
  };
  EXPECT_GT(variance_after_a_drive(0.02), 2.0 * variance_after_a_drive(0.005));
}

TEST(Localizer, BlindItPredictsGrowsUncertainAndSaysSoAndRecovers) {
  Drive drive(4);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.1, 0.0, 0.02};
  Localization before = localize(drive.acquire(truth, step));
  for (int i = 0; i < 4; ++i) before = localize(drive.acquire(truth = truth * step, step));
  ASSERT_EQ(before.status, Status::kLocalized);
  Localization fix = before;
  for (int i = 0; i < 5; ++i) {
    const Localization last = fix;
    fix = localize(drive.acquire(truth = truth * step, step, true));
    EXPECT_GT(fix.estimate.covariance.trace(), last.estimate.covariance.trace());
    EXPECT_NE(fix.status, Status::kLocalized);
    EXPECT_FALSE(fix.reason.empty());
    EXPECT_EQ(fix.matched, 0);
    EXPECT_LT(position_error(fix, truth), 0.15) << "predicted by odometry";
  }
  EXPECT_LT(fix.belief.yes, before.belief.yes);
  for (int i = 0; i < 3; ++i) fix = localize(drive.acquire(truth = truth * step, step));
  EXPECT_EQ(fix.status, Status::kLocalized) << fix.reason;
  EXPECT_LT(position_error(fix, truth), 0.02);
}

TEST(Localizer, InAnotherBuildingItDoesNotClaimToBeLocalized) {
  geometry::FloorPlan elsewhere;
  elsewhere.walls = {{{-20, 7}, {20, 9}}, {{-20, -6}, {20, -4}}, {{-9, -6}, {-9, 8}}};
  Drive drive(5);
  Pipeline localize(elsewhere, given({1.0, 1.5, 0.0}));
  Localization fix;
  for (int i = 0; i < 5; ++i) fix = localize(drive.acquire({1.0, 1.5, 0.0}, {}));
  EXPECT_NE(fix.status, Status::kLocalized);
  EXPECT_LT(fix.belief.yes, 0.5);
}

/// A corridor with niches: walls fit all along it, only the niches' corners tell where the robot is.
geometry::FloorPlan corridor() {
  geometry::FloorPlan plan;
  plan.uncertainty_m = 0.005;
  std::vector<Vector2d> p{{0, 0}, {20, 0}, {20, 2}};
  for (const double x : {17.5, 14.0, 11.5, 7.0, 3.0})
    p.insert(p.end(), {{x, 2.0}, {x, 2.5}, {x - 0.9, 2.5}, {x - 0.9, 2.0}});
  p.emplace_back(0, 2);
  for (std::size_t i = 0; i < p.size(); ++i) plan.walls.push_back({p[i], p[(i + 1) % p.size()]});
  return plan;
}

/// \returns the fixes of a drive along the corridor in whose fifth step the wheels slip by `slip`, and the true poses.
std::vector<std::pair<Localization, Pose2>> slipped_drive(double slip) {
  Drive drive(5, corridor());
  Pipeline localize(corridor(), given({3.0, 1.0, 0.0}));
  Pose2 truth{3.0, 1.0, 0.0};
  const Pose2 step{0.3, 0.0, 0.0};
  std::vector<std::pair<Localization, Pose2>> fixes;
  for (int i = 0; i < 14; ++i) {
    const Pose2 measured{step.x + (i == 5 ? slip : 0.0), 0.0, 0.0};
    fixes.emplace_back(localize(drive.acquire(truth, measured)), truth);
    truth = truth * step;
  }
  return fixes;
}

TEST(Localizer, ASlipOfTheWheelsIsNotBelieved) {
  for (const double slip : {0.3, 0.6})
    for (const auto& [fix, truth] : slipped_drive(slip)) {
      const bool wrong = position_error(fix, truth) > 0.3;
      EXPECT_FALSE(wrong && fix.status == Status::kLocalized && fix.belief.yes > 0.8) << slip << " m: " << fix;
    }
}

TEST(Localizer, FindsBackFromASlip) {
  for (const double slip : {0.3, 0.6, -0.6}) {
    const auto fixes = slipped_drive(slip);
    EXPECT_LT(position_error(fixes.back().first, fixes.back().second), 0.05) << slip;
    EXPECT_EQ(fixes.back().first.status, Status::kLocalized) << slip;
  }
}

TEST(Localizer, FindsBackFromATurnThatOdometryGotWrong) {
  for (const double turn_error : {0.08, 0.15, -0.2}) {
    Drive drive(8);
    Pipeline localize(room(), given({1.0, 1.5, 0.0}));
    Pose2 truth{1.0, 1.5, 0.0};
    for (int i = 0; i < 10; ++i) {
      const Pose2 step{0.2, 0.0, 0.3};
      const Localization fix = localize(drive.acquire(truth, {0.2, 0.0, step.theta + (i == 4 ? turn_error : 0.0)}));
      EXPECT_LT(position_error(fix, truth), 0.05) << turn_error << " rad, acquisition " << i;
      truth = truth * step;
    }
  }
}

TEST(Localizer, AfterAWhileWithoutAScanNothingChecksWhatIsMatched) {
  Drive drive(9);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.1, 0.0, 0.02};
  for (int i = 0; i < 12; ++i) {
    sensors::Acquisition acquisition = drive.acquire(truth, step);
    localize.localizer.with_path(acquisition);
    perception::Scene scene = localize.observer.observe(acquisition);
    const bool unchecked = i >= 4;
    if (unchecked) scene.points.clear();  // the primitives stay
    const Localization fix = localize.localizer.update(scene, acquisition.motion);
    if (i < 7)
      EXPECT_GT(fix.belief.yes, 0.8) << "acquisition " << i;
    else
      EXPECT_LE(fix.belief.yes, 0.75) << "acquisition " << i;
    truth = truth * step;
  }
}

TEST(Localizer, WithoutAPlanItGivesTheMotionFromItsStart) {
  Drive drive(6);
  Pipeline localize({}, std::nullopt);
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 start = truth, step{0.1, 0.0, 0.03};
  Localization fix = localize(drive.acquire(truth, step));
  EXPECT_EQ(fix.status, Status::kInitializing);
  for (int i = 0; i < 15; ++i) fix = localize(drive.acquire(truth = truth * step, step));
  EXPECT_EQ(fix.status, Status::kInitializing);
  const Pose2 moved = start.inverse() * truth;
  EXPECT_LT(std::hypot(fix.estimate.pose.x - moved.x, fix.estimate.pose.y - moved.y), 0.03);
  EXPECT_LT(std::abs(geometry::angle_difference(fix.estimate.pose.theta, moved.theta)), 0.015);
  EXPECT_FALSE(fix.reason.empty());
}

TEST(Localizer, PaperMethodFollowsASlowDriveWithoutOdometry) {
  Drive drive(7);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}), perception::Method::kPaper);
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.05, 0.0, 0.0};
  double worst = 0.0;
  for (int i = 0; i < 15; ++i) {
    worst = std::max(worst, position_error(localize(drive.acquire(truth, step)), truth));
    truth = truth * step;
  }
  EXPECT_LT(worst, 0.15);
}

/// 30 cm a step are the paper's. Landmarks aside move by more than the association allows from one acquisition to the
/// next, so the first step and the tracks that were seen once must not be taken to stand still.
TEST(Localizer, PaperMethodFollowsTheStepsOfThePaper) {
  Drive drive(3);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}), perception::Method::kPaper);
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.3, 0.0, 0.0};
  double worst = 0.0;
  for (int i = 0; i < 12; ++i) {
    worst = std::max(worst, position_error(localize(drive.acquire(truth, step)), truth));
    truth = truth * step;
  }
  EXPECT_LT(worst, 0.13);  // the mean error that Clerentin et al. report
}

TEST(Localizer, PaperMethodIsTheSameWhateverOdometrySays) {
  for (const bool absolute : {true, false}) {
    const std::optional<PoseEstimate> start = absolute ? std::optional(given({1.0, 1.5, 0.0})) : std::nullopt;
    Pipeline with(room(), start, perception::Method::kPaper), without(room(), start, perception::Method::kPaper);
    Drive drive(8);
    for (int k = 0; k < 6; ++k) {
      sensors::Acquisition acquisition = drive.acquire({1.0 + 0.3 * k, 1.5, 0.0}, {0.5, 0.1, 0.2});  // it lies
      const Localization fix = with(acquisition);
      acquisition.motion.reset();
      acquisition.path = {};
      const Localization other = without(acquisition);
      EXPECT_EQ(fix.estimate.pose.x, other.estimate.pose.x) << k;
      EXPECT_EQ(fix.estimate.pose.theta, other.estimate.pose.theta) << k;
      EXPECT_EQ(fix.estimate.covariance, other.estimate.covariance) << k;
      EXPECT_EQ(fix.belief, other.belief) << k;
    }
  }
}

TEST(Localizer, PoseAtAnEarlierTimeLiesBetweenTheFixes) {
  Drive drive(8);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  Pose2 truth{1.0, 1.5, 0.0};
  const Pose2 step{0.2, 0.0, 0.0};
  const Localization a = localize(drive.acquire(truth, step));
  const Localization b = localize(drive.acquire(truth = truth * step, step));
  const auto at_a = localize.localizer.pose_at(a.time), at_b = localize.localizer.pose_at(b.time);
  EXPECT_NEAR(at_a.value.pose.x, a.estimate.pose.x, 1e-9);
  EXPECT_NEAR(at_b.value.pose.x, b.estimate.pose.x, 1e-9);
  const auto half = localize.localizer.pose_at((a.time + b.time) / 2);
  EXPECT_NEAR(half.value.pose.x, 0.5 * (a.estimate.pose.x + b.estimate.pose.x), 1e-3);
  EXPECT_DOUBLE_EQ(half.belief.pignistic(), std::min(a.belief.pignistic(), b.belief.pignistic())) << "the weaker";
}

TEST(Localizer, TellsTheBeliefOfEachTrackThatTheMonitorTook) {
  Drive drive(6);
  Pipeline localize(room(), given({1.0, 1.5, 0.0}));
  EXPECT_TRUE(localize.localizer.landmark_beliefs().empty());
  for (int i = 0; i < 3; ++i) {
    localize(drive.acquire({1.0, 1.5, 0.0}, {}));
    const std::vector<Observation>& observations = localize.localizer.observations();
    const std::vector<double>& beliefs = localize.localizer.landmark_beliefs();
    ASSERT_EQ(beliefs.size(), observations.size());
    ASSERT_FALSE(beliefs.empty());
    for (std::size_t k = 0; k < observations.size(); ++k) {
      if (observations[k].track < 0) continue;
      const tracking::Track& track = localize.localizer.tracks()[static_cast<std::size_t>(observations[k].track)];
      EXPECT_EQ(beliefs[k], track.existence.pignistic());
    }
  }
}

TEST(Localizer, WithoutAMonitorItTellsNoBeliefs) {
  Drive drive(6);
  Pipeline paper(room(), given({1.0, 1.5, 0.0}), perception::Method::kPaper), relative(room(), std::nullopt);
  paper(drive.acquire({1.0, 1.5, 0.0}, {}));
  EXPECT_FALSE(paper.localizer.observations().empty());
  EXPECT_TRUE(paper.localizer.landmark_beliefs().empty());
  relative(drive.acquire({1.0, 1.5, 0.0}, {}));
  EXPECT_TRUE(relative.localizer.landmark_beliefs().empty());
}

TEST(Localizer, SameInputSameBytes) {
  const auto run = [] {
    Drive drive(9);
    Pipeline localize(room(), given({1.0, 1.5, 0.0}));
    Pose2 truth{1.0, 1.5, 0.0};
    PoseEstimate last;
    for (int i = 0; i < 6; ++i)
      last = localize(drive.acquire(truth = truth * Pose2{0.1, 0, 0.05}, {0.1, 0, 0.05})).estimate;
    return last;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace credo::localization
