// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/point_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/vectors.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Pose2;
using nlohmann::json;

std::vector<PointPair> pairs_of(const json& before, const json& now) {
  std::vector<PointPair> pairs(before.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].before = {before[i][0].get<double>(), before[i][1].get<double>()};
    pairs[i].now = {now[i][0].get<double>(), now[i][1].get<double>()};
  }
  return pairs;
}

/// Points around the robot and the same seen after a motion.
std::vector<PointPair> seen_twice(const Pose2& T_before_now, std::mt19937& random, int count) {
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::vector<PointPair> pairs(static_cast<std::size_t>(count));
  for (PointPair& pair : pairs) {
    pair.before = {place(random), place(random)};
    pair.now = T_before_now.inverse() * pair.before;
  }
  return pairs;
}

TEST(PointMotionVectors, AgreeWithTheReference) {
  const testing::Operations operations{{"ego_motion", [](const json& in) -> std::optional<json> {
                                          const PointMotion m = point_motion(pairs_of(in.at("p_prime"), in.at("p")));
                                          return json{{"dx", m.dx}, {"dy", m.dy}, {"dtheta", m.dtheta}};
                                        }}};
  const auto tallies = testing::run_vectors(testing::vectors_path(), operations);
  ASSERT_TRUE(tallies.contains("ego_motion"));
  EXPECT_GT(tallies.at("ego_motion").run, 0);
  EXPECT_EQ(tallies.at("ego_motion").not_covered, 0);
  EXPECT_EQ(tallies.at("ego_motion").failed, 0) << tallies.at("ego_motion").first_failure;
}

TEST(PointMotion, OfAQuarterTurnToTheLeft) {
  // What stood ahead is at the right after it.
  const std::vector<PointPair> pairs{{.before = {2.0, 0.0}, .now = {0.0, -2.0}},
                                     {.before = {3.0, 0.0}, .now = {0.0, -3.0}}};
  const PointMotion motion = point_motion(pairs);
  EXPECT_NEAR(motion.dtheta, 1.5707963267948966, 1e-12);
  EXPECT_NEAR(motion.dx, 0.0, 1e-12);
  EXPECT_NEAR(motion.dy, 0.0, 1e-12);
  EXPECT_NEAR(motion.T_before_now().theta, 1.5707963267948966, 1e-12);
}

RC_GTEST_PROP(PointMotionLaws, ExactPointsGiveTheMotion, (unsigned seed)) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Pose2 truth{uniform(random), uniform(random), 3.0 * uniform(random)};
  const Pose2 found = point_motion(seen_twice(truth, random, 2 + static_cast<int>(seed % 9))).T_before_now();
  RC_ASSERT((found.translation() - truth.translation()).norm() < 1e-8);
  RC_ASSERT(std::abs(geometry::angle_difference(found.theta, truth.theta)) < 1e-8);
}

TEST(PointMotion, CovarianceIsThatOfTheErrorsItMakes) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Pose2 truth{0.4, -0.2, 0.5};
  const std::vector<PointPair> exact = seen_twice(truth, random, 6);
  const Vector2d sigma_before(0.01, 0.03), sigma_now(0.02, 0.005);
  Matrix3d scatter = Matrix3d::Zero();
  Matrix3d told;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<PointPair> pairs = exact;
    for (PointPair& pair : pairs) {
      pair.before += sigma_before.cwiseProduct(Vector2d(normal(random), normal(random)));
      pair.now += sigma_now.cwiseProduct(Vector2d(normal(random), normal(random)));
      pair.before_covariance = sigma_before.cwiseAbs2().asDiagonal();
      pair.now_covariance = sigma_now.cwiseAbs2().asDiagonal();
    }
    const geometry::PoseEstimate found = point_motion_estimate(pairs);
    const Eigen::Vector3d error(found.pose.x - truth.x, found.pose.y - truth.y,
                                geometry::angle_difference(found.pose.theta, truth.theta));
    scatter += error * error.transpose() / kRuns;
    told = found.covariance;
  }
  EXPECT_LT((scatter - told).norm(), 0.1 * told.norm()) << scatter << "\n\n" << told;
}

TEST(PointMotion, CovarianceIsFiniteHoweverFarThePointsAre) {
  std::vector<PointPair> pairs(2);
  for (std::size_t i = 0; i < 2; ++i) {
    pairs[i].before = pairs[i].now = {2e3, 2e3 + 1e-5 * static_cast<double>(i)};
    pairs[i].before_covariance = pairs[i].now_covariance = 1e-4 * Eigen::Matrix2d::Identity();
  }
  const Matrix3d covariance = point_motion_estimate(pairs).covariance;
  EXPECT_NEAR(covariance(2, 2) * 0.5e-10, 2e-4, 1e-9);  // of the turn: the points' over what they are apart
}

TEST(PointMotion, RefusesPointsThatTellNoTurn) {
  using ::testing::HasSubstr;
  using ::testing::ThrowsMessage;
  const PointPair pair{.before = {1.0, 2.0}, .now = {0.5, 2.0}};
  const std::vector<PointPair> none, one{pair}, same{pair, pair, pair};
  EXPECT_THAT([&] { (void)point_motion(none); }, ThrowsMessage<std::invalid_argument>(HasSubstr("found 0 pairs")));
  EXPECT_THAT([&] { (void)point_motion(one); }, ThrowsMessage<std::invalid_argument>(HasSubstr("found 1 pairs")));
  EXPECT_THAT([&] { (void)point_motion_estimate(same); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("3 pairs at a single place")));
  for (const bool forth : {true, false}) {
    const Vector2d a(0.0, 0.0), b(1.0, 0.0), here(2.0, 2.0);
    const std::vector<PointPair> to_one{
        forth ? PointPair{.before = a, .now = here} : PointPair{.before = here, .now = a},
        forth ? PointPair{.before = b, .now = here} : PointPair{.before = here, .now = b}};
    EXPECT_THAT([&] { (void)point_motion_estimate(to_one); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("2 pairs at a single place")));
  }
  std::vector<PointPair> broken{pair, {.before = {0.0, std::numeric_limits<double>::quiet_NaN()}, .now = {}}};
  EXPECT_THAT([&] { (void)point_motion(broken); }, ThrowsMessage<std::invalid_argument>(HasSubstr("not all finite")));
}

}  // namespace
}  // namespace credo::localization
