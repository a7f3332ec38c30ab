// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/bearing_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Pose2;

/// A hall of 8 m x 6 m with marks along its walls, at irregular distances.
geometry::FloorPlan hall() {
  geometry::FloorPlan plan;
  plan.walls = {{{0, 0}, {8, 0}}, {{8, 0}, {8, 6}}, {{8, 6}, {0, 6}}, {{0, 6}, {0, 0}}};
  for (const double x : {0.7, 1.1, 2.9, 3.6, 5.2, 6.9}) plan.verticals.emplace_back(x, 0.0);
  for (const double x : {0.4, 2.2, 3.1, 4.7, 5.0, 7.3}) plan.verticals.emplace_back(x, 6.0);
  return plan;
}

/// What an ideal camera at a pose sees of the plan, turned by `turn_rad` against the base.
perception::Scene seen_from(const Pose2& pose, const LandmarkMap& map, double turn_rad = 0.0) {
  perception::Scene scene;
  for (const PointLandmark& point : map.points()) {
    const Vector2d way = pose.inverse() * point.position;
    scene.radial_lines.push_back({.azimuth = geometry::wrap_angle(std::atan2(way.y(), way.x()) + turn_rad)});
  }
  std::sort(scene.radial_lines.begin(), scene.radial_lines.end(),
            [](const auto& a, const auto& b) { return a.azimuth < b.azimuth; });
  return scene;
}

TEST(BearingAgreement, FromTheRightPoseMostBearingsAgree) {
  const LandmarkMap map(hall());
  for (const Pose2& pose : {Pose2{3.0, 2.5, 0.4}, Pose2{5.5, 3.5, -2.9}, Pose2{2.0, 4.0, 3.1}}) {
    const BearingAgreement agreement = compare_bearings(seen_from(pose, map), map, pose);
    EXPECT_GT(agreement.at_pose, 10);
    EXPECT_GT(agreement.share().value(), 0.6);
  }
}

TEST(BearingAgreement, FromAHeadingThatIsOffTheyAgreeUnderAnother) {
  const LandmarkMap map(hall());
  const Pose2 pose{3.0, 2.5, 0.4};
  for (const double turn : {-0.17, -0.08, 0.08, 0.17}) {
    const BearingAgreement agreement = compare_bearings(seen_from(pose, map, turn), map, pose);
    EXPECT_NEAR(agreement.turn_rad, turn, 0.025);
    EXPECT_LT(agreement.share().value(), 0.4);
  }
}

TEST(BearingAgreement, FewBearingsSayNothing) {
  const LandmarkMap map(hall());
  perception::Scene scene = seen_from({3.0, 2.5, 0.4}, map);
  scene.radial_lines.resize(2);
  EXPECT_FALSE(compare_bearings(scene, map, {3.0, 2.5, 0.4}).share().has_value());
  scene.radial_lines.clear();
  EXPECT_FALSE(compare_bearings(scene, map, {3.0, 2.5, 0.4}).share().has_value());
}

}  // namespace
}  // namespace credo::localization
