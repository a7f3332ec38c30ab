// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/ego_motion.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "localization/landmark_map.hpp"
#include "perception/hough_lines.hpp"
#include "perception/observer.hpp"
#include "tests/localization/drive.hpp"

namespace credo::localization {
namespace {

using geometry::Pose2;
using geometry::PoseEstimate;
using test::Drive;
using test::kPi;

/// A corridor of 2 m, too long to see an end of it.
geometry::FloorPlan corridor() {
  geometry::FloorPlan plan;
  plan.walls = {{{-100.0, -1.0}, {100.0, -1.0}}, {{100.0, 1.0}, {-100.0, 1.0}}};
  return plan;
}

/// Drives with ego-motion alone.
struct Ego {
  explicit Ego(std::uint64_t seed, const geometry::FloorPlan& plan, const Pose2& start)
      : drive(seed, plan), observer(test::rig()), truth(start), first(start) {
    step({});
  }

  /// \param slip  that odometry does not notice
  void step(const Pose2& motion, const Pose2& slip = {}, bool with_odometry = true) {
    truth = truth * motion * slip;
    const sensors::Acquisition acquisition = drive.acquire(truth, motion);
    ego.update(observer.observe(acquisition), with_odometry ? acquisition.motion : std::nullopt);
    if (acquisition.motion) odometry = odometry * acquisition.motion->pose;
  }
  [[nodiscard]] Pose2 error() const { return (first.inverse() * truth).inverse() * ego.pose().value.pose; }
  [[nodiscard]] Pose2 odometry_error() const { return (first.inverse() * truth).inverse() * odometry; }

  Drive drive;
  perception::Observer observer;
  EgoMotion ego;
  Pose2 truth, first, odometry;
};

double length(const Pose2& pose) { return std::hypot(pose.x, pose.y); }

TEST(EgoMotionInARoom, DoesNotDriftWhileTheFirstWallsAreInSight) {
  Ego ego(3, test::room(), {1.5, 1.5, 0.0});
  double worst_odometry = 0.0;
  for (int turn = 0; turn < 4; ++turn)
    for (int i = 0; i < 36; ++i) {  // round and round
      ego.step({0.2, 0.0, kPi / 18.0});
      worst_odometry = std::max(worst_odometry, length(ego.odometry_error()));
      EXPECT_LT(length(ego.error()), 0.06);
      EXPECT_LT(std::abs(ego.error().theta), 0.02);
    }
  EXPECT_GT(worst_odometry, 0.15);
  const Eigen::Matrix3d covariance = ego.ego.pose().value.covariance;
  EXPECT_LT(std::sqrt(covariance.diagonal().maxCoeff()), 0.06);
  EXPECT_GT(ego.ego.pose().belief.yes, 0.5);
}

TEST(EgoMotionInACorridor, KnowsAlongItOnlyWhatOdometrySays) {
  Ego ego(5, corridor(), {0.0, 0.2, 0.0});
  double along_by_odometry = 0.0;
  for (int i = 0; i < 20; ++i) {
    ego.step({0.5, 0.0, 0.0});
    along_by_odometry += std::pow(sensors::OdometryNoise{}.translation_per_metre, 2) * 0.5;
  }
  const Eigen::Matrix3d covariance = ego.ego.pose().value.covariance;
  EXPECT_GT(covariance(0, 0), 0.9 * along_by_odometry);
  EXPECT_LT(covariance(1, 1), 0.04 * 0.04);
  EXPECT_LT(covariance(2, 2), 0.01 * 0.01);
  EXPECT_LT(std::abs(ego.error().y), 0.03);
}

TEST(EgoMotionInARoom, NoticesThatTheWheelsHaveSlipped) {
  Ego ego(7, test::room(), {1.5, 1.5, 0.0});
  for (int i = 0; i < 5; ++i) ego.step({0.1, 0.0, 0.0});
  ego.step({0.1, 0.0, 0.0}, {0.25, 0.1, 0.2});
  EXPECT_LT(length(ego.error()), 0.06);
  EXPECT_LT(std::abs(ego.error().theta), 0.02);
}

TEST(EgoMotionInARoom, GoesWithoutOdometry) {
  Ego ego(9, test::room(), {1.5, 1.5, 0.0});
  for (int i = 0; i < 20; ++i) ego.step({0.15, 0.0, i < 10 ? 0.1 : -0.15}, {}, false);
  EXPECT_LT(length(ego.error()), 0.1);
  EXPECT_LT(std::abs(ego.error().theta), 0.03);
}

TEST(EgoMotionInARoom, TakesLinesOfAHoughTransform) {
  Drive drive(15);
  const sensors::RangeFinder scanner = test::rig().range_finders.front();
  const Pose2 first{1.5, 1.5, 0.0}, step{0.2, 0.0, kPi / 18.0};
  Pose2 truth = first;
  EgoMotion ego;
  std::vector<sensors::ScanPoint> points;
  for (int i = 0; i < 72; ++i) {
    const sensors::Acquisition acquisition = drive.acquire(truth, step);
    sensors::carry_scan(*acquisition.scan, scanner, {}, acquisition.time, points);
    ego.update(acquisition.time, perception::hough_lines(points, {.range = scanner.noise, .params = {}}),
               acquisition.motion);
    truth = truth * step;
  }
  const Pose2 error = (first.inverse() * truth).inverse() * (ego.pose().value.pose * step);
  EXPECT_LT(length(error), 0.08);
  EXPECT_LT(std::abs(error.theta), 0.03);
}

TEST(EgoMotion, WithoutWallsIsOdometryAndBelievesNothing) {
  EgoMotion ego;
  const PoseEstimate step = sensors::OdometryNoise{}.with_covariance({0.3, 0.0, 0.1});
  for (int i = 0; i < 4; ++i) ego.update(i * 1'000'000'000LL, {}, step);
  const Pose2 expected = step.pose * step.pose * step.pose;
  EXPECT_LT(length(expected.inverse() * ego.pose().value.pose), 1e-12);
  EXPECT_EQ(ego.pose().belief, evidence::BinaryMass::vacuous());
  EXPECT_GT(ego.pose().value.covariance(2, 2), 3.0 * step.covariance(2, 2));
}

TEST(EgoMotion, LearnsThatTheWheelsTurnTheRobot) {
  Ego ego(11, test::room(), {1.5, 1.5, 0.0});
  const Pose2 unnoticed{0.0, 0.0, 0.02};  // on each 0.2 m
  for (int i = 0; i < 60; ++i) ego.step({0.2, 0.0, kPi / 18.0}, unnoticed);
  EXPECT_NEAR(ego.ego.systematic_turn({1.0, 0.0, 0.0}), 0.1, 0.03);
}

TEST(EgoMotion, IsTheSameEachTime) {
  Ego a(13, test::room(), {1.5, 1.5, 0.0}), b(13, test::room(), {1.5, 1.5, 0.0});
  for (int i = 0; i < 20; ++i) {
    a.step({0.2, 0.0, 0.1});
    b.step({0.2, 0.0, 0.1});
  }
  EXPECT_EQ(a.ego.pose(), b.ego.pose());
}

TEST(EgoMotion, ErrorsAreAsLargeAsTheCovarianceSays) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Ego ego(seed, test::room(), {1.5, 1.5, 0.0});
    for (int i = 0; i < 36; ++i) ego.step({0.2, 0.0, kPi / 18.0});
    const PoseEstimate estimate = ego.ego.pose().value;
    const Pose2 truth = ego.first.inverse() * ego.truth;
    const Eigen::Vector3d error(estimate.pose.x - truth.x, estimate.pose.y - truth.y,
                                geometry::angle_difference(estimate.pose.theta, truth.theta));
    sum += error.dot(estimate.covariance.inverse() * error);
    ++count;
  }
  EXPECT_LT(sum / count, 4.0);  // expected 3; the walls of this world are straighter than is allowed for
}

// The derivatives that the filter works with, against numeric ones.
RC_GTEST_PROP(WallFilterLaws, RowsAreTheDerivativesOfTheirResiduals, (unsigned seed)) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Eigen::Vector2d(3.0 * uniform(random), 3.0 * uniform(random)); };
  perception::ScanLine line;
  line.line = {.centroid = point(), .angle = 3.0 * uniform(random), .sigma_across = 0.01, .sigma_angle = 0.01};
  line.extent = {point(), point()};
  line.end_sigma_m = {0.02, 0.02};
  WallFilter filter({{uniform(random), uniform(random), 3.0 * uniform(random)}, Eigen::Matrix3d::Identity()});
  filter.add(line, Eigen::Matrix3d::Zero());
  WallFilter::State at = filter.state();
  for (Eigen::Index i = 0; i < at.size(); ++i) at[i] += 0.1 * uniform(random);
  const FilteredWall& wall = filter.walls().front();
  const auto all = [&](const WallFilter::State& state) {
    const std::array<WallRow, 2> rows = WallFilter::rows(state, line, wall);
    return std::array{rows[0], rows[1], WallFilter::end_row(state, line, wall, 0),
                      WallFilter::end_row(state, line, wall, 1)};
  };
  const std::array<WallRow, 4> rows = all(at);
  constexpr double h = 1e-6;
  for (Eigen::Index column = 0; column < at.size(); ++column) {
    WallFilter::State up = at, down = at;
    up[column] += h;
    down[column] -= h;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double numeric = geometry::wrap_angle(all(up)[r].residual - all(down)[r].residual) / (2.0 * h);
      double told = 0.0;
      if (column < 3) told = rows[r].by_pose[column];
      if (column == wall.column || column == wall.column + 1) told = rows[r].by_wall[column - wall.column];
      if (column == rows[r].end_column) told = -1.0;
      RC_ASSERT(std::abs(numeric - told) < 1e-6);
    }
  }
}

TEST(WallFilter, ForgetsTheWallsUnseenForLongestAndKeepsTheOthers) {
  WallFilter filter({});
  perception::ScanLine line;
  line.line.sigma_across = line.line.sigma_angle = 0.01;
  line.end_sigma_m = {0.02, std::nullopt};
  for (const double y : {1.0, 2.0, 3.0}) {
    line.line.centroid = {0.0, y};
    line.extent = {{-1.0, y}, {1.0, y}};
    filter.add(line, Eigen::Matrix3d::Zero());
    filter.forget(1.0, 10.0, 2);
  }
  ASSERT_EQ(filter.walls().size(), 2u);
  for (const FilteredWall& wall : filter.walls()) {
    EXPECT_GE(wall.anchor.y(), 2.0);
    EXPECT_NEAR(filter.state()[wall.end_column[0]], -1.0, 1e-12);
    line.line.centroid = wall.anchor;
    EXPECT_NEAR(WallFilter::rows(filter.state(), line, wall)[0].residual, 0.0, 1e-12);
  }
  filter.forget(20.0, 10.0, 2);
  EXPECT_TRUE(filter.walls().empty());
}

}  // namespace
}  // namespace credo::localization
