// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/odometry_simulator.hpp"

namespace credo::sim {
namespace {

using geometry::Pose2;

const std::vector<Waypoint> kBend{{{0, 0}, false}, {{2, 0}, false}, {{2, 3}, false}, {{0.5, 4}, false}};

TEST(Trajectory, StopsEveryStepAlongTheWay) {
  const Drive drive{.mode = Drive::Mode::kStopAndGo, .step_m = 0.3};
  const Trajectory way(kBend, drive);
  const double length = 2.0 + 3.0 + std::hypot(1.5, 1.0);
  ASSERT_EQ(way.stops().size(), 1U + static_cast<std::size_t>(length / 0.3));
  for (std::size_t i = 0; i + 1 < way.stops().size(); ++i) {
    const Pose2 a = way.pose_at(way.stops()[i]), b = way.pose_at(way.stops()[i + 1]);
    EXPECT_LE((a.translation() - b.translation()).norm(), 0.3 + 1e-9);
    const Pose2 before = way.pose_at(way.stops()[i] - 0.3 * drive.pause_s),
                after = way.pose_at(way.stops()[i] + 0.3 * drive.pause_s);
    EXPECT_EQ(before, after) << "the robot moves at stop " << i;
  }
  EXPECT_NEAR((way.pose_at(way.stops()[3]).translation() - Eigen::Vector2d(0.9, 0.0)).norm(), 0.0, 1e-9);
}

TEST(Trajectory, NeverJumpsNorSpeeds) {
  for (const auto mode : {Drive::Mode::kStopAndGo, Drive::Mode::kContinuous}) {
    const Drive drive{.mode = mode, .speed_mps = 0.4, .acceleration_mps2 = 0.5, .turn_speed_radps = 0.7};
    const Trajectory way(kBend, drive);
    Pose2 last = way.pose_at(0.0);
    double driven = 0.0;
    for (double t = 0.01; t < way.duration_s(); t += 0.01) {
      const Pose2 pose = way.pose_at(t);
      const Pose2 step = last.inverse() * pose;
      EXPECT_LE(std::hypot(step.x, step.y), 0.4 * 0.01 + 1e-9) << t;
      EXPECT_LE(std::abs(step.theta), 0.85 * 0.01) << t;
      EXPECT_NEAR(step.y, 0.0, 1e-4) << "wheels do not slide sideways, t = " << t;
      driven += std::hypot(step.x, step.y);
      last = pose;
    }
    EXPECT_GT(driven, 5.0);
    EXPECT_NEAR((way.pose_at(way.duration_s() + 5.0).translation() - Eigen::Vector2d(0.5, 4.0)).norm(), 0.0, 0.3);
  }
}

TEST(Trajectory, IsCarriedToWhereItIsSetDown) {
  const Trajectory way({{{0, 0}, false}, {{1, 0}, false}, {{5, 5}, true}, {{6, 5}, false}}, {});
  ASSERT_EQ(way.carried().size(), 1U);
  const double when = way.carried().front();
  EXPECT_NEAR(way.pose_at(when - 1e-6).x, 1.0, 0.3);
  EXPECT_NEAR(way.pose_at(when + 1e-6).x, 5.0, 1e-6);
}

TEST(Trajectory, EndsWithTheRecordingAndWaitsForIt) {
  const Drive whole{.step_m = 0.3};
  const Trajectory way(kBend, whole);
  Drive drive = whole;
  drive.duration_s = 0.4 * way.duration_s();
  const Trajectory cut(kBend, drive);
  EXPECT_EQ(cut.duration_s(), *drive.duration_s);
  EXPECT_EQ(cut.pose_at(cut.duration_s()), way.pose_at(cut.duration_s()));
  EXPECT_LT(cut.stops().back(), cut.duration_s());
  EXPECT_LT(cut.stops().size(), way.stops().size());
  drive.duration_s = way.duration_s() + 5.0;
  const Trajectory longer(kBend, drive);
  EXPECT_EQ(longer.duration_s(), *drive.duration_s);
  EXPECT_EQ(longer.pose_at(longer.duration_s()), way.pose_at(way.duration_s()));
}

TEST(Trajectory, KnowsWhatIsDrivenOverInAPartOfTheTime) {
  const Trajectory way(kBend, {.mode = Drive::Mode::kContinuous});
  const double middle_s = 0.5 * way.duration_s();
  const auto before = way.stretches(0.0, middle_s), after = way.stretches(middle_s);
  EXPECT_EQ(before.front().a, kBend.front().position);
  EXPECT_LT((before.back().b - way.pose_at(middle_s).translation()).norm(), 1e-9);
  EXPECT_LT((after.front().a - way.pose_at(middle_s).translation()).norm(), 1e-9);
  EXPECT_LT((after.back().b - kBend.back().position).norm(), 1e-9);
  const auto length = [](const std::vector<geometry::Segment>& stretches) {
    double sum = 0.0;
    for (const geometry::Segment& stretch : stretches) sum += stretch.length();
    return sum;
  };
  EXPECT_NEAR(length(before) + length(after), length(way.stretches()), 1e-3);
}

TEST(Trajectory, NeedsAWay) {
  EXPECT_THROW(Trajectory({{{0, 0}, false}}, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({{{0, 0}, false}, {{0, 0}, false}}, {}), std::invalid_argument);
}

/// The drift over a metre, or a radian, is what the noise says, in however many steps it is read.
TEST(OdometrySimulator, DriftsAsItsNoiseSaysAtAnyRate) {
  const sensors::OdometryNoise noise{
      .translation_per_metre = 0.03, .rotation_per_metre = 0.02, .rotation_per_radian = 0.04};
  for (const int steps : {1, 20}) {
    double along = 0.0, heading = 0.0, turned = 0.0;
    constexpr int kSeeds = 1500;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      OdometrySimulator driving(noise, seed), turning(noise, seed + 100000);
      Pose2 driven, spun;
      for (int i = 0; i < steps; ++i) {
        driven = driving.advance({0.3 / steps, 0.0, 0.0});
        spun = turning.advance({0.0, 0.0, 0.5 / steps});
      }
      along += std::pow(std::hypot(driven.x, driven.y) - 0.3, 2);
      heading += driven.theta * driven.theta;
      turned += std::pow(spun.theta - 0.5, 2);
    }
    EXPECT_NEAR(std::sqrt(along / kSeeds), 0.03 * 0.3, 0.1 * 0.03 * 0.3) << steps;
    EXPECT_NEAR(std::sqrt(heading / kSeeds), 0.02 * 0.3, 0.1 * 0.02 * 0.3) << steps;
    EXPECT_NEAR(std::sqrt(turned / kSeeds), 0.04 * 0.5, 0.1 * 0.04 * 0.5) << steps;
  }
}

TEST(OdometrySimulator, RestsWithTheRobot) {
  OdometrySimulator odometry({}, 1);
  const Pose2 before = odometry.advance({0.5, 0.0, 0.1});
  EXPECT_EQ(odometry.advance({}), before);
}

TEST(Trajectory, ACarriedRobotIsSetDownTurnedAsSaid) {
  const std::vector<Waypoint> path{{{0, 0}}, {{2, 0}}, {{2, 0}, true, 1.2}, {{2, 2}}};
  const Trajectory way(path, {});
  ASSERT_EQ(way.carried().size(), 1U);
  const geometry::Pose2 before = way.pose_at(way.carried()[0] - 1e-6), after = way.pose_at(way.carried()[0] + 1e-6);
  EXPECT_NEAR(geometry::angle_difference(after.theta, before.theta), 1.2, 1e-9);
  EXPECT_NEAR((after.translation() - before.translation()).norm(), 0.0, 1e-3);
  EXPECT_NEAR(way.pose_at(way.duration_s()).y, 2.0, 0.3);  // and drives on
}

}  // namespace
}  // namespace credo::sim
