// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/calibrated_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "localization/observations.hpp"
#include "localization/pose_solver.hpp"
#include "tests/localization/sightings.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::FloorPlan;
using geometry::Pose2;
using namespace test;  // NOLINT: the helpers of these tests

constexpr double kPlan_m = 0.01;
constexpr double kMounting_rad = 0.003;

sensors::Rig rig_of_two() {
  sensors::Rig rig;
  rig.camera.emplace();
  rig.camera->horizon_radius_px = 120.0;
  rig.range_finders.emplace_back();
  for (auto* accuracy : {&rig.camera->accuracy, &rig.range_finders[0].accuracy})
    *accuracy = {.x_m = 0.002, .y_m = 0.002, .theta_rad = kMounting_rad, .center_px = 0.06};
  return rig;
}

/// A hall of 12 m x 5 m with three piers.
const FloorPlan kHall{.walls = {{{0, 0}, {12, 0}},
                                {{12, 0}, {12, 5}},
                                {{12, 5}, {0, 5}},
                                {{0, 5}, {0, 0}},
                                {{3, 4}, {4, 4}},
                                {{6, 1}, {6.8, 1.2}},
                                {{9, 4}, {9.5, 3.5}}},
                      .verticals = {},
                      .uncertainty_m = kPlan_m};

/// A drive through the hall whose plan, instruments and wheels are off as the robot is told, features as perception
/// gives them.
class Drive {
 public:
  explicit Drive(unsigned seed) : random_(seed), truth_(kHall), map_(with_errors(kHall)), rig_(rig_of_two()) {
    for (int i : {0, 1}) off_(i) = 0.002 * normal_(random_);
    for (int i : {2, 3}) off_(i) = kMounting_rad * normal_(random_);
    for (int i : {4, 5}) off_(i) = 0.0005 * normal_(random_);
    const Pose2 start{pose_.x + 0.03 * normal_(random_), pose_.y + 0.03 * normal_(random_),
                      pose_.theta + 0.01 * normal_(random_)};
    estimate_ = calibrated_pose(rig_, {start, Vector3d(9e-4, 9e-4, 1e-4).asDiagonal()},
                                2 * (map_.junction_count() + map_.landmark_count()));
  }

  void step(const Pose2& motion) {
    const sensors::OdometryNoise noise;
    const geometry::PoseEstimate measured = noise.with_covariance(motion);
    const Matrix3d root = Matrix3d(measured.covariance.llt().matrixL());
    const Vector3d e = root * Vector3d(normal_(random_), normal_(random_), normal_(random_));
    pose_ = pose_ * motion;
    move(estimate_, {{motion.x + e(0), motion.y + e(1), motion.theta + e(2)}, measured.covariance});
    look();
  }

  void look() {
    observations_.clear();
    scene_.radial_lines.clear();
    const ObservationParams exact{.min_bearing_sigma_rad = 0.001, .as_built_sigma_m = 0.0, .as_built_sigma_rad = 0.0};
    // Of each wall, the piece about the robot's foot on it is seen.
    for (std::size_t w = 0; w < map_.walls().size(); ++w) {
      const geometry::Segment& whole = truth_.walls()[w].extent;
      Primitive seen = wall_seen(whole, pose_);
      seen.line.sigma_across = 0.004, seen.line.sigma_angle = 0.002;
      displace(seen);
      add(observe_wall(seen, map_.walls()[w], pose_, kPlan_m, exact), map_.wall_id(w));
    }
    for (std::size_t p = 0; p < map_.points().size(); ++p) {
      const Primitive seen = bearing_seen(truth_.points()[p].position, pose_, {0.0, 0.0}, static_cast<int>(p));
      const double azimuth =
          seen.azimuth - off_(3) - off_(4) * std::cos(seen.azimuth) - off_(5) * std::sin(seen.azimuth);
      scene_.radial_lines.push_back({.azimuth = azimuth + 0.001 * normal_(random_), .sigma = 0.0});
      add(observe_point(scene_, seen, map_.points()[p], {}, kPlan_m, exact), map_.point_id(p));
    }
    estimate_ = solver_.solve(estimate_, observations_).pose;
  }

  [[nodiscard]] Vector3d error() const {
    return {estimate_.pose.x - pose_.x, estimate_.pose.y - pose_.y,
            geometry::angle_difference(estimate_.pose.theta, pose_.theta)};
  }
  [[nodiscard]] double nees() const { return error().dot(estimate_.covariance().inverse() * error()); }
  [[nodiscard]] const CalibratedPose& estimate() const { return estimate_; }
  /// What the instruments are really off.
  [[nodiscard]] const Eigen::Matrix<double, 6, 1>& off() const { return off_; }

 private:
  FloorPlan with_errors(FloorPlan plan) {
    const FloorPlan exact = plan;
    for (const geometry::Segment& wall : exact.walls)
      for (const Vector2d& end : {wall.a, wall.b}) {
        if (!places_.contains({end.x(), end.y()}))
          places_[{end.x(), end.y()}] = end + kPlan_m * Vector2d(normal_(random_), normal_(random_));
      }
    for (geometry::Segment& wall : plan.walls) {
      wall.a = places_[{wall.a.x(), wall.a.y()}];
      wall.b = places_[{wall.b.x(), wall.b.y()}];
    }
    return plan;
  }

  /// As an instrument that is off sees it, with noise.
  void displace(Primitive& wall) {
    const Pose2 correction{off_(0), off_(1), off_(2)};
    const Vector2d across(-std::sin(wall.line.angle), std::cos(wall.line.angle));
    wall.line.centroid = correction.inverse() * Vector2d(wall.line.centroid + 0.004 * normal_(random_) * across);
    wall.line.angle += 0.002 * normal_(random_) - off_(2);
  }

  void add(Observation o, tracking::LandmarkId landmark) {
    o.noise(0, 0) = o.kind == ObservationKind::kBearing ? 1e-6 : 1.6e-5;
    if (o.kind == ObservationKind::kWall) o.noise(1, 1) = 4e-6;
    o.own_column = 2 * (map_.junction_count() + landmark);
    observations_.push_back(o);
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::map<std::pair<double, double>, Vector2d> places_;
  LandmarkMap truth_, map_;
  sensors::Rig rig_;
  Eigen::Matrix<double, 6, 1> off_;
  Pose2 pose_{1.5, 2.5, 0.0};
  CalibratedPose estimate_;
  perception::Scene scene_;
  std::vector<Observation> observations_;
  PoseSolver solver_;
};

TEST(CalibratedPose, MovesAsACompositionWithIndependentMotionDoes) {
  const geometry::PoseEstimate start{{1.0, 2.0, 0.7}, Vector3d(1e-3, 2e-3, 3e-4).asDiagonal()};
  const geometry::PoseEstimate motion{{0.5, 0.1, 0.2}, Vector3d(1e-4, 2e-5, 1e-5).asDiagonal()};
  CalibratedPose pose = calibrated_pose(rig_of_two(), start);
  move(pose, motion);
  const geometry::PoseEstimate expected = geometry::compose(start, motion);
  EXPECT_EQ(pose.pose, expected.pose);
  EXPECT_LT((pose.covariance() - expected.covariance).norm(), 1e-12);
}

TEST(CalibratedPose, AnotherPlaceKeepsTheCalibration) {
  Drive drive(1);
  for (int i = 0; i < 5; ++i) drive.step({0.3, 0.0, 0.0});
  CalibratedPose pose = drive.estimate();
  place(pose, {{3.0, 1.0, 0.0}, Matrix3d::Identity()});
  EXPECT_EQ(pose.common_errors, drive.estimate().common_errors);
  EXPECT_EQ((pose.joint.bottomRightCorner<6, 6>()), (drive.estimate().joint.bottomRightCorner<6, 6>()));
  EXPECT_EQ(pose.joint.topRightCorner(3, 6).norm(), 0.0);
  const CalibratedPose& before = drive.estimate();
  for (int column = 0; column < pose.with_plan.errors(); column += 2) {
    EXPECT_EQ(pose.with_plan[column].topRows(3).norm(), 0.0);
    EXPECT_EQ(pose.with_plan[column].bottomRows(6), before.with_plan[column].bottomRows(6));
  }
}

TEST(CalibratedPose, DrivingTellsTheHeadingThatBothInstrumentsShare) {
  // At rest nothing tells whether the robot is turned or both its instruments are.
  double at_rest = 0.0, driven = 0.0, apart = 0.0, shared = 0.0;
  constexpr int kDrives = 30;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    Drive drive(seed);
    drive.look();
    at_rest += std::pow(drive.error()(2), 2) / kDrives;
    for (int i = 0; i < 30; ++i) drive.step({0.3, 0.0, 0.0});
    driven += std::pow(drive.error()(2), 2) / kDrives;
    const Vector2d left = drive.off().segment<2>(2) - drive.estimate().common_errors.segment<2>(2);
    apart += std::pow(left(0) - left(1), 2) / kDrives;
    shared += std::pow(0.5 * (left(0) + left(1)), 2) / kDrives;
  }
  EXPECT_LT(std::sqrt(apart), 0.15 * kMounting_rad) << "each acquisition tells how the two differ";
  EXPECT_LT(shared, 0.5 * std::pow(kMounting_rad, 2) / 2.0) << "half the variance of the mean of two mountings";
  EXPECT_LT(driven, 0.5 * at_rest);
}

TEST(CalibratedPose, CovarianceStaysHonestOverADriveWhosePlanErrorsRepeat) {
  constexpr int kDrives = 50, kSteps = 24;
  std::array<double, kSteps> anees{};
  for (unsigned seed = 100; seed < 100 + kDrives; ++seed) {
    Drive drive(seed);
    for (int i = 0; i < kSteps; ++i) {
      drive.step({0.3, 0.0, i % 8 == 7 ? 0.3 : -0.04});
      anees[static_cast<std::size_t>(i)] += drive.nees() / kDrives;
    }
  }
  // 95 % of means over 50 runs of chi-square with three degrees of freedom lie within.
  const auto inside = std::count_if(anees.begin(), anees.end(), [](double e) { return e > 2.36 && e < 3.716; });
  EXPECT_GE(inside, kSteps * 8 / 10);
  EXPECT_NEAR(std::accumulate(anees.begin(), anees.end(), 0.0) / kSteps, 3.0, 0.6);
}

TEST(CalibratedPose, ARobotAtRestDoesNotAverageThePlansErrorsOut) {
  Drive drive(3);
  drive.look();
  const double once = drive.estimate().covariance()(0, 0);
  for (int i = 0; i < 100; ++i) drive.look();
  EXPECT_LT(drive.estimate().covariance()(0, 0), once);
  EXPECT_GT(drive.estimate().covariance()(0, 0), 0.1 * kPlan_m * kPlan_m);
  const Eigen::SelfAdjointEigenSolver<PoseState::Matrix> axes(drive.estimate().joint);
  EXPECT_GT(axes.eigenvalues()(0), 0.0);
}

}  // namespace
}  // namespace credo::localization
