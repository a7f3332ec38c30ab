// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/global_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "localization/scan_agreement.hpp"
#include "tests/localization/drive.hpp"

namespace credo::localization {
namespace {

using namespace test;

bool is_near(const Pose2& a, const Pose2& b, double metres, double radians) {
  return (a.translation() - b.translation()).norm() < metres &&
         std::abs(geometry::angle_difference(a.theta, b.theta)) < radians;
}

/// The candidates for what a robot at `truth` sees.
std::vector<PoseCandidate> found_from(const Pose2& truth, const geometry::FloorPlan& plan,
                                      const GlobalSearchParams& params = {}) {
  perception::Observer observer(rig());
  const LandmarkMap map(plan);
  const ScanMatcher matcher(map);
  return GlobalSearch(map, matcher.field(), params).search(observer.observe(Drive(1, plan).acquire(truth, {})));
}

TEST(GlobalSearch, FindsTheRobotWhereverItIs) {
  for (const Pose2& truth : {Pose2{1.0, 1.5, 0.0}, Pose2{5.2, 3.1, 2.5}, Pose2{2.6, 4.1, -1.2}, Pose2{3.0, 0.6, 3.1}}) {
    const auto candidates = found_from(truth, room());
    ASSERT_FALSE(candidates.empty());
    EXPECT_TRUE(is_near(candidates.front().pose, truth, 0.05, 0.02)) << candidates.front().pose << " for " << truth;
    EXPECT_GT(candidates.front().score, 0.9);
  }
}

TEST(GlobalSearch, InARectangleBothWaysRoundFit) {
  geometry::FloorPlan plan;
  plan.walls = {{{0, 0}, {5, 0}}, {{5, 0}, {5, 3}}, {{5, 3}, {0, 3}}, {{0, 3}, {0, 0}}};
  const Pose2 truth{1.2, 1.0, 0.7};
  const auto candidates = found_from(truth, plan);
  ASSERT_GE(candidates.size(), 2U);
  EXPECT_NEAR(candidates[0].score, candidates[1].score, 0.02);
  for (const Pose2& expected : {truth, Pose2{3.8, 2.0, geometry::wrap_angle(0.7 + kPi)}})
    EXPECT_TRUE(is_near(candidates[0].pose, expected, 0.05, 0.02) || is_near(candidates[1].pose, expected, 0.05, 0.02))
        << expected;
}

TEST(GlobalSearch, AmongPillarsWithoutAWallItTriesAllHeadings) {
  geometry::FloorPlan plan;
  for (const Vector2d& at :
       {Vector2d(0, 0), Vector2d(4, 0.5), Vector2d(1, 3.5), Vector2d(5, 4.2), Vector2d(2.7, 1.9)}) {
    constexpr int kSides = 12;
    for (int i = 0; i < kSides; ++i) {
      const auto corner = [&](int k) -> Vector2d {
        return at + 0.25 * Vector2d(std::cos(2 * kPi * k / kSides), std::sin(2 * kPi * k / kSides));
      };
      plan.walls.push_back({corner(i), corner(i + 1)});
    }
  }
  const Pose2 truth{3.4, 3.0, -2.2};
  GlobalSearchParams params;
  params.points = 120;
  const auto candidates = found_from(truth, plan, params);
  ASSERT_FALSE(candidates.empty());
  EXPECT_TRUE(std::any_of(candidates.begin(), candidates.end(),
                          [&](const PoseCandidate& c) { return is_near(c.pose, truth, 0.1, 0.1); }));
}

TEST(GlobalSearch, WithoutAScanOrAPlanThereIsNothingToSay) {
  const LandmarkMap map(room());
  const ScanMatcher matcher(map);
  EXPECT_TRUE(GlobalSearch(map, matcher.field()).search(perception::Scene{}).empty());
  EXPECT_TRUE(found_from({1.0, 1.5, 0.0}, room()).size() > 0);
  const LandmarkMap nothing(geometry::FloorPlan{});
  const ScanMatcher no_matcher(nothing);
  perception::Observer observer(rig());
  EXPECT_TRUE(GlobalSearch(nothing, no_matcher.field())
                  .search(observer.observe(Drive(1).acquire({1.0, 1.5, 0.0}, {})))
                  .empty());
}

}  // namespace
}  // namespace credo::localization
