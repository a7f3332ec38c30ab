// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/pose.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>
#include <random>
#include <sstream>

#include "tests/geometry/any_number.hpp"

namespace credo::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

Pose2 any_pose() { return {any_number(-20, 20), any_number(-20, 20), any_number(-7, 7)}; }

void require_near(const Pose2& a, const Pose2& b) {
  RC_ASSERT(std::abs(a.x - b.x) < 1e-9);
  RC_ASSERT(std::abs(a.y - b.y) < 1e-9);
  RC_ASSERT(std::abs(angle_difference(a.theta, b.theta)) < 1e-9);
}

RC_GTEST_PROP(WrapAngle, IsTheSameAngleInTheHalfOpenInterval, ()) {
  const double angle = any_number(-1000, 1000);
  const double wrapped = wrap_angle(angle);
  RC_ASSERT(wrapped > -kPi && wrapped <= kPi);
  RC_ASSERT(std::abs(std::sin(wrapped) - std::sin(angle)) < 1e-9);
  RC_ASSERT(std::abs(std::cos(wrapped) - std::cos(angle)) < 1e-9);
}

TEST(WrapAngle, GivesPiAtTheSeam) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(wrap_angle(3.0 * kPi), kPi);
  EXPECT_NEAR(angle_difference(kPi - 0.1, -kPi + 0.1), -0.2, 1e-12);
}

RC_GTEST_PROP(Pose2, ComposesAssociatively, ()) {
  const Pose2 a = any_pose(), b = any_pose(), c = any_pose();
  require_near((a * b) * c, a * (b * c));
}

RC_GTEST_PROP(Pose2, InverseUndoes, ()) {
  const Pose2 a = any_pose();
  require_near(a * a.inverse(), {});
  require_near(a.inverse() * a, {});
  require_near(a * Pose2{}, a);
  require_near(Pose2{} * a, a);
}

RC_GTEST_PROP(Pose2, MapsPointsAsItsMatrixDoes, ()) {
  const Pose2 a = any_pose(), b = any_pose();
  const Eigen::Vector2d p(any_number(-5, 5), any_number(-5, 5));
  RC_ASSERT((a * (b * p) - (a * b) * p).norm() < 1e-9);
  RC_ASSERT((a * p - (a.rotation() * p + a.translation())).norm() < 1e-9);
}

RC_GTEST_PROP(Interpolate, MeetsItsEnds, ()) {
  const Pose2 a = any_pose(), b = any_pose();
  require_near(interpolate(a, b, 0.0), a);
  require_near(interpolate(a, b, 1.0), b);
}

TEST(Interpolate, TurnsTheShortWayRound) {
  const Pose2 half = interpolate({0.0, 0.0, kPi - 0.1}, {2.0, 0.0, -kPi + 0.3}, 0.5);
  EXPECT_NEAR(half.x, 1.0, 1e-12);
  EXPECT_NEAR(angle_difference(half.theta, -kPi + 0.1), 0.0, 1e-12);
  EXPECT_NEAR(interpolate({}, {1.0, 0.0, 0.2}, 1.5).theta, 0.3, 1e-12);
}

Eigen::Vector3d as_vector(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }
Pose2 moved(const Pose2& pose, const Eigen::Vector3d& by) {
  return {pose.x + by[0], pose.y + by[1], pose.theta + by[2]};
}

/// J C J^T with the Jacobian of the composition taken by central differences.
Eigen::Matrix3d numeric_covariance(const PoseEstimate& a, const PoseEstimate& b) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix3d by_a, by_b;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    Eigen::Vector3d change_a = as_vector(moved(a.pose, step) * b.pose) - as_vector(moved(a.pose, -step) * b.pose);
    Eigen::Vector3d change_b = as_vector(a.pose * moved(b.pose, step)) - as_vector(a.pose * moved(b.pose, -step));
    change_a[2] = wrap_angle(change_a[2]), change_b[2] = wrap_angle(change_b[2]);
    by_a.col(i) = change_a / (2.0 * kStep), by_b.col(i) = change_b / (2.0 * kStep);
  }
  return by_a * a.covariance * by_a.transpose() + by_b * b.covariance * by_b.transpose();
}

Eigen::Matrix3d any_covariance() {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = 0.1 * any_number(-1, 1);
  return root * root.transpose() + 1e-4 * Eigen::Matrix3d::Identity();
}

RC_GTEST_PROP(Compose, CovarianceAgreesWithTheNumericJacobian, ()) {
  const PoseEstimate a{any_pose(), any_covariance()}, b{any_pose(), any_covariance()};
  const PoseEstimate c = compose(a, b);
  require_near(c.pose, a.pose * b.pose);
  RC_ASSERT((c.covariance - numeric_covariance(a, b)).norm() < 1e-6 * (1.0 + c.covariance.norm()));
}

TEST(Compose, CovarianceAgreesWithDrawnPoses) {
  Eigen::Matrix3d root_a, root_b;
  root_a << 0.02, 0.0, 0.0, 0.01, 0.03, 0.0, -0.004, 0.002, 0.01;
  root_b << 0.01, 0.0, 0.0, -0.005, 0.02, 0.0, 0.003, 0.001, 0.005;
  const PoseEstimate a{{1.0, -2.0, 0.7}, root_a * root_a.transpose()};
  const PoseEstimate b{{3.0, 0.5, -1.2}, root_b * root_b.transpose()};
  const PoseEstimate expected = compose(a, b);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  constexpr int kDraws = 40'000;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d off =
        as_vector(moved(a.pose, root_a * draw()) * moved(b.pose, root_b * draw())) - as_vector(expected.pose);
    covariance += off * off.transpose() / kDraws;
  }
  EXPECT_LT((covariance - expected.covariance).norm(), 0.03 * expected.covariance.norm());
}

TEST(Pose2, PrintsInDegrees) {
  std::ostringstream out;
  out << Pose2{1.0, 2.0, kPi / 2.0};
  EXPECT_EQ(out.str(), "(x 1 m, y 2 m, theta 90 deg)");
}

}  // namespace
}  // namespace credo::geometry
