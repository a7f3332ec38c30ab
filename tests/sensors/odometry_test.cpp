// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "tests/sensors/second.hpp"

namespace credo::sensors {
namespace {

/// `rows` rows over two seconds: along an arc of the given length and turn.
MotionPath arc(int rows, double length, double turn) {
  std::vector<OdometryReading> path{{0, {}}};
  const geometry::Pose2 step{length / rows, 0.0, turn / rows};
  for (int i = 1; i <= rows; ++i) path.push_back({2 * kSecond * i / rows, path.back().T_odom_base * step});
  return MotionPath(std::move(path));
}

TEST(OdometryNoise, AtRestLeavesTheFloor) {
  const geometry::PoseEstimate rest = OdometryNoise{}.with_covariance({});
  EXPECT_NEAR(std::sqrt(rest.covariance(0, 0)), 1e-3, 1e-12);
  EXPECT_NEAR(std::sqrt(rest.covariance(2, 2)), 5e-4, 1e-12);
  EXPECT_NEAR(rest.covariance(0, 1), 0.0, 1e-15);
}

TEST(OdometryNoise, IsWhatItSaysAfterOneMetreAndAfterOneRadian) {
  const OdometryNoise noise{.translation_per_metre = 0.03, .rotation_per_metre = 0.02, .rotation_per_radian = 0.05};
  const auto metre = noise.with_covariance({1.0, 0.0, 0.0});
  EXPECT_NEAR(std::sqrt(metre.covariance(0, 0)), 0.03, 1e-4);
  EXPECT_NEAR(std::sqrt(metre.covariance(2, 2)), 0.02, 1e-4);
  EXPECT_NEAR(std::sqrt(noise.with_covariance({0.0, 0.0, 1.0}).covariance(2, 2)), 0.05, 1e-4);
}

TEST(OdometryNoise, WheelsHardlySlipSideways) {
  const OdometryNoise rolling{.translation_per_metre = 0.03, .rotation_per_metre = 0.0, .rotation_per_radian = 0.0};
  const Eigen::Matrix3d driven = rolling.with_covariance({0.0, 4.0, 0.0}).covariance;
  EXPECT_NEAR(std::sqrt(driven(1, 1)), 0.06, 1e-4);
  EXPECT_NEAR(std::sqrt(driven(0, 0)), 0.006, 1e-4) << "across the way: a tenth, and the floor";
  OdometryNoise sliding = rolling;
  sliding.lateral_share = 1.0;
  EXPECT_NEAR(std::sqrt(sliding.with_covariance({0.0, 4.0, 0.0}).covariance(0, 0)), 0.06, 1e-4);
}

TEST(OdometryNoise, StraightMotionDoesNotDependOnHowOftenItIsRead) {
  const OdometryNoise noise;
  const geometry::PoseEstimate at_once = noise.with_covariance({2.0, 0.0, 0.0});
  for (const int rows : {1, 4, 40, 400}) {
    const geometry::PoseEstimate along = noise.along(arc(rows, 2.0, 0.0), 0, 2 * kSecond);
    EXPECT_NEAR(along.pose.x, 2.0, 1e-9);
    EXPECT_LT((along.covariance - at_once.covariance).norm(), 1e-9) << rows;
  }
}

TEST(OdometryNoise, AgreesWithDrawnDrift) {
  const OdometryNoise noise{.translation_per_metre = 0.02, .rotation_per_metre = 0.03, .rotation_per_radian = 0.02};
  constexpr int kRows = 60, kDraws = 3000;
  const double step = 3.0 / kRows, turn = 1.2 / kRows;
  const geometry::PoseEstimate expected = noise.along(arc(kRows, 3.0, 1.2), 0, 2 * kSecond);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    geometry::Pose2 pose;
    for (int i = 0; i < kRows; ++i) {
      const double sigma_t = noise.translation_per_metre * std::sqrt(step);
      const double sigma_r =
          std::hypot(noise.rotation_per_metre * std::sqrt(step), noise.rotation_per_radian * std::sqrt(turn));
      pose = pose * geometry::Pose2{step + sigma_t * normal(random), noise.lateral_share * sigma_t * normal(random),
                                    turn + sigma_r * normal(random)};
    }
    const Eigen::Vector3d off(pose.x - expected.pose.x, pose.y - expected.pose.y, pose.theta - expected.pose.theta);
    covariance += off * off.transpose() / kDraws;
  }
  EXPECT_LT((covariance - expected.covariance).norm(), 0.1 * expected.covariance.norm());
}

TEST(OdometryNoise, TurningOnTheSpotAndBackCounts) {
  std::vector<OdometryReading> rows;
  for (int i = 0; i <= 20; ++i) rows.push_back({i * kSecond / 10, {0.0, 0.0, 0.1 * std::min(i, 20 - i)}});
  const geometry::PoseEstimate motion =
      OdometryNoise{.rotation_per_radian = 0.03}.along(MotionPath(rows), 0, 2 * kSecond);
  EXPECT_NEAR(motion.pose.theta, 0.0, 1e-12);
  EXPECT_NEAR(std::sqrt(motion.covariance(2, 2)), 0.03 * std::sqrt(2.0), 1e-4);
}

TEST(OdometryNoise, IsLessSureBetweenRowsFarApart) {
  const MotionPath sparse = arc(1, 1.0, 0.0);
  const OdometryNoise noise;
  const double whole = noise.along(sparse, 0, 2 * kSecond).covariance(0, 0);
  EXPECT_GT(noise.along(sparse, 0, kSecond).covariance(0, 0), whole);
  const MotionPath dense = arc(40, 1.0, 0.0);
  EXPECT_LT(noise.along(dense, 0, kSecond).covariance(0, 0), whole);
}

TEST(OdometryNoise, CovarianceIsPositiveDefinite) {
  for (const double length : {0.0, 0.01, 5.0})
    for (const double turn : {0.0, -0.3, 3.0}) {
      const Eigen::Matrix3d covariance = OdometryNoise{}.along(arc(10, length, turn), 0, 2 * kSecond).covariance;
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0], 1e-8);
      EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-12));
    }
}

}  // namespace
}  // namespace credo::sensors
