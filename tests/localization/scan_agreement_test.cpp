// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/scan_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Pose2;
using geometry::PoseEstimate;

/// A room of 5 m x 3 m with a niche, so that it looks different from everywhere.
geometry::FloorPlan room() {
  const std::vector<Vector2d> p{{0, 0}, {5, 0}, {5, 3}, {3.5, 3}, {3.5, 3.7}, {2.2, 3.7}, {2.2, 3}, {0, 3}};
  geometry::FloorPlan plan;
  for (std::size_t i = 0; i < p.size(); ++i) plan.walls.push_back({p[i], p[(i + 1) % p.size()]});
  return plan;
}

std::vector<sensors::ScanPoint> scan_from(const LandmarkMap& map, const Pose2& pose, int beams = 360) {
  std::vector<sensors::ScanPoint> points;
  for (int beam = 0; beam < beams; ++beam) {
    const double angle = 2.0 * std::numbers::pi * beam / beams;
    const Vector2d ray(std::cos(angle), std::sin(angle));
    const double range = map.cast(pose.translation(), pose.rotation() * ray, 20.0);
    points.push_back({.position = range * ray, .ray = ray, .range_m = range, .sigma_m = 0.01, .beam = beam});
  }
  return points;
}

PoseEstimate about(const Pose2& pose, double sigma_m, double sigma_rad) {
  return {pose, Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal()};
}

class ScanAgreementInARoom : public ::testing::Test {
 protected:
  LandmarkMap map_{room()};
  ScanMatcher matcher_{map_};
  Pose2 truth_{1.4, 1.2, 0.3};
  std::vector<sensors::ScanPoint> scan_ = scan_from(map_, truth_);
};

TEST_F(ScanAgreementInARoom, FromTheTruePoseAllPointsLieOnThePlan) {
  const ScanAgreement agreement = matcher_.compare(scan_, truth_);
  EXPECT_EQ(agreement.on_plan, 120);
  EXPECT_DOUBLE_EQ(*agreement.share(), 1.0);
}

TEST_F(ScanAgreementInARoom, FromAPoseThatIsOffManyPointsDoNot) {
  EXPECT_LT(*matcher_.compare(scan_, Pose2{1.8, 1.5, 0.3}).share(), 0.6);
  EXPECT_LT(*matcher_.compare(scan_, Pose2{1.4, 1.2, 0.5}).share(), 0.7);
}

TEST_F(ScanAgreementInARoom, PointsBeforeAWallAreToldFromPointsBehindIt) {
  for (sensors::ScanPoint& point : scan_) point.position = (point.range_m *= 0.7) * point.ray;
  EXPECT_GT(matcher_.compare(scan_, truth_).before, 100);
  for (sensors::ScanPoint& point : scan_) point.position = (point.range_m *= 2.0) * point.ray;
  EXPECT_GT(matcher_.compare(scan_, truth_).behind, 100);
}

TEST_F(ScanAgreementInARoom, AFewPointsSayNothing) {
  scan_.resize(20);
  EXPECT_FALSE(matcher_.compare(scan_, truth_).share());
}

TEST_F(ScanAgreementInARoom, TheSearchFindsThePoseNearby) {
  for (const Pose2& off : {Pose2{0.6, -0.4, 0.1}, Pose2{-0.5, 0.5, -0.15}, Pose2{0.0, 0.0, 0.2}}) {
    const Pose2 expected{truth_.x + off.x, truth_.y + off.y, truth_.theta + off.theta};
    const Pose2 found = matcher_.search(scan_, about(expected, 0.3, 0.1));
    EXPECT_NEAR(found.x, truth_.x, 0.05);
    EXPECT_NEAR(found.y, truth_.y, 0.05);
    EXPECT_NEAR(found.theta, truth_.theta, 0.02);
  }
}

TEST_F(ScanAgreementInARoom, TheSearchStaysWithinTheExpectedPosesSigmas) {
  const Pose2 expected{truth_.x + 0.8, truth_.y, truth_.theta};
  const Pose2 found = matcher_.search(scan_, about(expected, 0.02, 0.005));
  EXPECT_LT(std::hypot(found.x - expected.x, found.y - expected.y), 0.3);
}

TEST_F(ScanAgreementInARoom, TheSearchWithoutPointsReturnsTheExpectedPose) {
  EXPECT_EQ(matcher_.search({}, about(truth_, 0.3, 0.1)), truth_);
}

TEST(ScanSearch, AlongACorridorTheExpectedPoseDecides) {
  geometry::FloorPlan corridor;
  corridor.walls = {{{-50, -1}, {50, -1}}, {{-50, 1}, {50, 1}}};
  const LandmarkMap map(corridor);
  ScanMatcher matcher(map);
  std::vector<sensors::ScanPoint> scan = scan_from(map, {0.0, 0.2, 0.05});
  std::erase_if(scan, [](const sensors::ScanPoint& point) { return !(point.range_m < 8.0); });
  const Pose2 found = matcher.search(scan, about({0.3, 0.0, 0.0}, 0.3, 0.1));
  EXPECT_NEAR(found.x, 0.3, 0.11);
  EXPECT_NEAR(found.y, 0.2, 0.05);
  EXPECT_NEAR(found.theta, 0.05, 0.02);
}

}  // namespace
}  // namespace credo::localization
