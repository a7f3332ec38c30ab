// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_solver.hpp"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;

Observation wall_at(const Vector2d& point, double angle) {
  Observation o;
  o.kind = ObservationKind::kWall;
  o.map_point = point;
  o.map_angle = angle;
  o.noise = Vector2d(1e-4, 1e-4).asDiagonal();
  return o;
}

/// What a sensor at `pose` sees of a room of 6 m x 4 m without noise: two walls, a corner, three bearings.
std::vector<Observation> seen_from(const Pose2& pose) {
  const Pose2 T_base_map = pose.inverse();
  std::vector<Observation> seen{wall_at({0, 0}, 0.0), wall_at({6, 0}, 1.5707963267948966)};
  seen[0].base_point = T_base_map * Vector2d(2, 0);
  seen[0].base_angle = -pose.theta;
  seen[1].base_point = T_base_map * Vector2d(6, 1);
  seen[1].base_angle = 1.5707963267948966 - pose.theta;
  Observation corner;
  corner.kind = ObservationKind::kPoint;
  corner.map_point = {6, 4};
  corner.base_point = T_base_map * corner.map_point;
  corner.noise = Vector2d(4e-4, 1e-4).asDiagonal();
  seen.push_back(corner);
  for (const Vector2d& mark : {Vector2d(0, 4), Vector2d(3, 0), Vector2d(6, 2)}) {
    Observation o;
    o.kind = ObservationKind::kBearing;
    o.map_point = mark;
    o.base_point = {0.05, 0.02};
    const Vector2d way = T_base_map * mark - o.base_point;
    o.base_angle = std::atan2(way.y(), way.x());
    o.noise(0, 0) = 4e-6;
    seen.push_back(o);
  }
  return seen;
}

CalibratedPose prior_at(const Pose2& pose, double sigma_m, double sigma_rad, const sensors::Rig& rig = {}) {
  const Vector3d variance(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
  return calibrated_pose(rig, {pose, variance.asDiagonal()});
}

TEST(PoseSolver, JacobiansAgreeWithNumericOnes) {
  PoseState::Vector x;
  x << 2.1, 1.7, 0.6, 0.01, -0.02, 0.004, 0.003, -0.002, 0.001;
  for (const Observation& o : seen_from({2.0, 1.5, 0.4})) {
    Vector2d residual;
    PoseState::Jacobian J;
    evaluate(o, x, residual, &J);
    constexpr double h = 1e-6;
    for (int k = 0; k < PoseState::kSize; ++k) {
      PoseState::Vector up = x, down = x;
      up(k) += h, down(k) -= h;
      Vector2d above, below;
      evaluate(o, up, above, nullptr);
      evaluate(o, down, below, nullptr);
      const Vector2d numeric = (above - below) / (2.0 * h);
      EXPECT_NEAR(J(0, k), numeric(0), 1e-7) << "kind " << static_cast<int>(o.kind) << " by " << k;
      EXPECT_NEAR(J(1, k), numeric(1), 1e-7) << "kind " << static_cast<int>(o.kind) << " by " << k;
    }
  }
}

/// An observation's whitened residual, for the general solver.
class ObservationCost : public ceres::SizedCostFunction<2, PoseState::kSize> {
 public:
  explicit ObservationCost(const Observation& observation) : o_(observation) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const PoseState::Vector> x(parameters[0]);
    Vector2d residual;
    PoseState::Jacobian J;
    evaluate(o_, PoseState::Vector(x), residual, &J);
    const Vector2d weight = residual_covariance(o_, StateFrame(x)).whole().diagonal().cwiseSqrt().cwiseInverse();
    Eigen::Map<Vector2d>{residuals} = weight.asDiagonal() * residual;
    if (jacobians && jacobians[0])
      Eigen::Map<Eigen::Matrix<double, 2, PoseState::kSize, Eigen::RowMajor>>{jacobians[0]} = weight.asDiagonal() * J;
    return true;
  }

 private:
  Observation o_;
};

class PriorCost : public ceres::SizedCostFunction<PoseState::kSize, PoseState::kSize> {
 public:
  explicit PriorCost(const CalibratedPose& prior)
      : prior_(prior.state()), weight_(prior.joint.diagonal().cwiseSqrt().cwiseInverse()) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const PoseState::Vector> x(parameters[0]);
    Eigen::Map<PoseState::Vector>{residuals} = weight_.asDiagonal() * (x - prior_);
    if (jacobians && jacobians[0]) Eigen::Map<PoseState::Matrix>{jacobians[0]} = weight_.asDiagonal();
    return true;
  }

 private:
  PoseState::Vector prior_, weight_;
};

TEST(PoseSolver, AgreesWithCeresOnTheSameRobustProblem) {
  std::vector<Observation> seen = seen_from({2.0, 1.5, 0.4});
  for (std::size_t k = 0; k < seen.size(); ++k) {  // none fits, one is far off
    seen[k].base_angle += 0.004 * std::sin(3.0 * static_cast<double>(k));
    seen[k].base_point += 0.01 * Vector2d(std::cos(static_cast<double>(k)), std::sin(static_cast<double>(k)));
    if (seen[k].kind == ObservationKind::kPoint) seen[k].noise = 2e-4 * Eigen::Matrix2d::Identity();
  }
  seen[3].map_point.x() += 0.03;
  sensors::Rig rig;
  rig.camera.emplace();
  rig.range_finders.emplace_back();
  const CalibratedPose prior = prior_at({2.02, 1.47, 0.41}, 0.05, 0.02, rig);
  PoseSolver solver{{.reweightings = 40}};
  const PoseSolution& solution = solver.solve(prior, seen);

  PoseState::Vector x = prior.state();
  ceres::Problem problem;
  problem.AddResidualBlock(new PriorCost(prior), nullptr, x.data());
  for (const Observation& o : seen)
    problem.AddResidualBlock(new ObservationCost(o),
                             new ceres::CauchyLoss(PoseSolverParams{}.robust_scale * std::sqrt(o.dimension())),
                             x.data());
  ceres::Solver::Options options;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-14;
  options.max_num_iterations = 200;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  ASSERT_TRUE(summary.IsSolutionUsable());

  EXPECT_NEAR(solution.pose.pose.x, x(0), 1e-6);
  EXPECT_NEAR(solution.pose.pose.y, x(1), 1e-6);
  EXPECT_NEAR(solution.pose.pose.theta, x(2), 1e-6);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(solution.common_errors(i), x(3 + i), 1e-6) << i;
}

TEST(PoseSolver, FindsThePoseFromAStartFarAway) {
  const Pose2 truth{2.0, 1.5, 0.4};
  PoseSolver solver;
  const PoseSolution& solution = solver.solve(prior_at({2.3, 1.2, 0.25}, 1.0, 0.5), seen_from(truth));
  EXPECT_NEAR(solution.pose.pose.x, truth.x, 1e-3);
  EXPECT_NEAR(solution.pose.pose.y, truth.y, 1e-3);
  EXPECT_NEAR(solution.pose.pose.theta, truth.theta, 1e-3);
  EXPECT_EQ(std::count(solution.outlier.begin(), solution.outlier.end(), true), 0);
}

TEST(PoseSolver, OneWrongMatchNeitherPullsThePoseNorPassesAsAMatch) {
  const Pose2 truth{2.0, 1.5, 0.4};
  std::vector<Observation> seen = seen_from(truth);
  seen[4].map_point += Vector2d(0.5, 0.0);
  PoseSolver solver;
  const PoseSolution& solution = solver.solve(prior_at({2.05, 1.45, 0.4}, 0.05, 0.05), seen);
  EXPECT_LT(std::hypot(solution.pose.pose.x - truth.x, solution.pose.pose.y - truth.y), 0.01);
  EXPECT_TRUE(solution.outlier[4]);
  EXPECT_EQ(std::count(solution.outlier.begin(), solution.outlier.end(), true), 1);
}

/// A bearing that alone fixes the place along a corridor, and is wrong by half a metre: without the prior's word
/// against it nothing else would contradict.
TEST(PoseSolver, AStepThatOnlyAWrongMatchAsksForIsNotTaken) {
  const Pose2 truth{2.0, 1.5, 0.4};
  std::vector<Observation> seen = seen_from(truth);
  Observation wrong = seen[4];
  wrong.map_point += Vector2d(1.0, 0.0);
  seen = {seen[0], seen[0], wrong};
  PoseSolver solver;
  const PoseSolution& solution = solver.solve(prior_at(truth, 0.2, 0.02), seen);
  EXPECT_LT(std::hypot(solution.pose.pose.x - truth.x, solution.pose.pose.y - truth.y), 0.02);
  EXPECT_TRUE(solution.outlier[2]);
}

TEST(PoseSolver, WithoutObservationsThePriorIsTheAnswer) {
  PoseSolver solver;
  const CalibratedPose prior = prior_at({1, 2, 0.3}, 0.1, 0.05);
  const PoseSolution& solution = solver.solve(prior, {});
  EXPECT_EQ(solution.pose.pose, prior.pose);
  EXPECT_EQ(solution.pose.covariance(), prior.covariance());
}

TEST(PoseSolver, CovarianceIsHonestForNoiseAndPlanErrors) {
  // NEES over independent draws of noise, plan errors and prior; its mean is 3 for an exact covariance.
  const Pose2 truth{2.0, 1.5, 0.4};
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  PoseSolver solver;
  double sum = 0.0;
  constexpr int kDraws = 400;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Observation> seen = seen_from(truth);
    for (Observation& o : seen) {
      const double u = 0.01;
      if (o.kind == ObservationKind::kWall) {
        o.plan = Vector2d(u * u, 1e-6).asDiagonal();
        const Vector2d across(-std::sin(o.map_angle), std::cos(o.map_angle));
        o.map_point += u * normal(random) * across;
        const Vector2d across_in_base(-std::sin(o.base_angle), std::cos(o.base_angle));
        o.base_point += 0.01 * normal(random) * across_in_base;
        o.base_angle += 0.01 * normal(random) + 0.001 * normal(random);
      } else {
        o.plan = u * u * Eigen::Matrix2d::Identity();
        o.map_point += u * Vector2d(normal(random), normal(random));
        if (o.kind == ObservationKind::kPoint)
          o.base_point += Vector2d(0.02 * normal(random), 0.01 * normal(random));
        else
          o.base_angle += 0.002 * normal(random);
      }
    }
    const CalibratedPose prior = prior_at(
        {truth.x + 0.03 * normal(random), truth.y + 0.03 * normal(random), truth.theta + 0.02 * normal(random)}, 0.03,
        0.02);
    const PoseSolution& solution = solver.solve(prior, seen);
    const Vector3d error(solution.pose.pose.x - truth.x, solution.pose.pose.y - truth.y,
                         geometry::angle_difference(solution.pose.pose.theta, truth.theta));
    sum += error.dot(solution.pose.covariance().inverse() * error);
  }
  const double mean_nees = sum / kDraws;
  EXPECT_GT(mean_nees, 2.0);
  EXPECT_LT(mean_nees, 3.7);
}

TEST(PoseSolver, MountingErrorsAreCommonToAllReadings) {
  sensors::Rig rig;
  rig.camera.emplace();
  rig.range_finders.emplace_back();
  for (auto* accuracy : {&rig.camera->accuracy, &rig.range_finders[0].accuracy}) accuracy->theta_rad = 0.003;
  const CalibratedPose prior = prior_at({2.0, 1.5, 0.4}, 1.0, 0.5, rig);
  PoseSolver solver;
  const double sigma = std::sqrt(solver.solve(prior, seen_from(prior.pose)).pose.covariance()(2, 2));
  EXPECT_GT(sigma, 0.0019) << "two instruments of 0.003 rad each cannot give better than 0.0021";
  EXPECT_LT(sigma, 0.0035);
}

TEST(PoseSolver, AScanThatWasCarriedOverAnUnsureMotionLeavesTheHeadingToTheCamera) {
  // The scan is turned by 0.02 rad against the moment of the image, and the carrying says that it may be.
  const Pose2 truth{2.0, 1.5, 0.4};
  std::vector<Observation> seen = seen_from(truth);
  for (Observation& o : seen) {
    if (o.kind == ObservationKind::kBearing) continue;
    const Pose2 turn{0.0, 0.0, 0.02};
    o.base_point = turn * o.base_point;
    o.base_angle += 0.02;
  }
  Matrix3d carry = Matrix3d::Zero();
  carry.diagonal() << 1e-6, 1e-6, 4e-4;
  PoseSolver solver;
  const PoseSolution& solution = solver.solve(prior_at(truth, 0.1, 0.1), seen, carry);
  EXPECT_NEAR(solution.pose.pose.theta, truth.theta, 0.003);
  EXPECT_NEAR(solution.common_errors(2), -0.02, 0.003);
  EXPECT_NEAR(solution.pose.common_errors(2), 0.0, 1e-6) << "the motion's error is nobody's in the next acquisition";
}

}  // namespace
}  // namespace credo::localization
