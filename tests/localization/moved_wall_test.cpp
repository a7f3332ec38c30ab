// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/moved_wall.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "localization/integrity_monitor.hpp"
#include "localization/observations.hpp"
#include "tests/localization/sightings.hpp"

namespace credo::localization {
namespace {

using namespace test;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using geometry::Segment;

constexpr double kPlan_m = 0.01;
const geometry::FloorPlan kRoom{.walls = {{{0, 0}, {8, 0}}, {{8, 0}, {8, 4}}, {{8, 4}, {0, 4}}, {{0, 4}, {0, 0}}},
                                .verticals = {},
                                .uncertainty_m = kPlan_m};

/// Drives along the wall y = 0, which stands `aside` of its place in the plan, and sees little of the one across.
class AlongAWall : public ::testing::Test {
 protected:
  AlongAWall() : map(kRoom) {
    prior = calibrated_pose({}, {pose, Vector3d(1e-4, 1e-4, 1e-5).asDiagonal()},
                            2 * (map.junction_count() + map.landmark_count()));
  }

  void look(double aside) {
    std::vector<Observation> seen;
    for (std::size_t w = 0; w < map.walls().size(); ++w) {
      const Segment extent = map.walls()[w].extent;
      const bool moved = std::abs(map.walls()[w].direction.x()) > 0.9 && extent.a.y() < 1.0;
      const Vector2d shift(0.0, moved ? aside : 0.0);
      Primitive wall = wall_seen({extent.a + shift, extent.b + shift}, pose);
      if (!moved) wall.line.sigma_across = 0.05;
      if (moved) wall_id = map.wall_id(w);
      seen.push_back(observe_wall(wall, map.walls()[w], pose, kPlan_m));
      seen.back().landmark = map.wall_id(w);
      seen.back().own_column = map.own_column(map.wall_id(w));
    }
    for (std::size_t p = 0; corners && p < map.points().size(); ++p) {
      const PointLandmark& point = map.points()[p];
      if (point.position.y() > 1.0) continue;
      Primitive corner = point_seen(PrimitiveType::kCorner, point.position + Vector2d(0.0, aside), pose);
      corner.position_covariance *= 0.1;
      seen.push_back(observe_point({}, corner, point, {}, kPlan_m));
      seen.back().landmark = map.point_id(p);
      seen.back().own_column = map.own_column(map.point_id(p));
    }
    solution = solver.solve(prior, seen);
    observed = seen.size();
  }

  void drive(int steps, double aside) {
    const geometry::PoseEstimate step{{0.2, 0.0, 0.0}, Vector3d(1e-5, 1e-5, 1e-6).asDiagonal()};
    for (int i = 0; i < steps; ++i) {
      look(aside);
      prior = solution.pose;
      move(prior, step);
      pose = pose * step.pose;
    }
    look(aside);
  }

  [[nodiscard]] double error() const { return solution.pose.pose.y - pose.y; }

  LandmarkMap map;
  Pose2 pose{1.0, 1.5, 0.0};
  CalibratedPose prior;
  PoseSolver solver;
  PoseSolution solution;
  tracking::LandmarkId wall_id = tracking::kNoLandmark;
  std::size_t observed = 0;
  bool corners = false;  ///< those of the wall are seen, too, and stand aside with it
};

TEST(WallFootprints, AWallCarriesItsEndsAndWhatMeetsIt) {
  geometry::FloorPlan plan = kRoom;
  plan.walls.push_back({{3, 0}, {3, 2}});
  const LandmarkMap map(plan);
  const std::vector<WallFootprint> footprints = wall_footprints(map);
  ASSERT_EQ(footprints.size(), map.walls().size());
  for (std::size_t w = 0; w < footprints.size(); ++w) {
    for (std::size_t p = 0; p < map.points().size(); ++p) {
      const bool carried = footprints[w].carries(map.point_id(p));
      const bool at_an_end = (map.points()[p].position - map.walls()[w].extent.a).norm() < 0.01 ||
                             (map.points()[p].position - map.walls()[w].extent.b).norm() < 0.01;
      const bool far = geometry::distance(map.points()[p].position, map.walls()[w].extent) > 0.1;
      EXPECT_TRUE(carried || !at_an_end) << w << ' ' << p;
      EXPECT_FALSE(carried && far) << w << ' ' << p;
    }
  }
}

/// The error across the wall of the pose without what a moved wall tells, and its standard deviation.
struct Without {
  double error = 0.0, sigma = 0.0;
};
Without without(const PoseSolution& solution, double error, tracking::LandmarkId wall, const WallFootprint& footprint,
                bool memory) {
  PoseState::Matrix information = solution.information;
  PoseState::Vector gradient = PoseState::Vector::Zero();
  for (const LinearisedObservation& o : solution.linearised) {
    if (o.landmark != wall && !footprint.carries(o.landmark)) continue;
    information -= o.by_state.transpose() * o.information * o.by_state;
    gradient += o.by_state.transpose() * (o.information * o.residual);
  }
  if (memory) {
    const BelievedWall told = believed_wall(footprint, solution, solution.prior_information.inverse());
    information -= told.by_state.transpose() * told.information * told.by_state;
    gradient += told.by_state.transpose() * told.weighted_residual;
  }
  const PoseState::Matrix covariance = information.inverse();
  return {error + (covariance * gradient)(PoseState::kY), std::sqrt(covariance(PoseState::kY, PoseState::kY))};
}

TEST_F(AlongAWall, WithoutItAndWhatItHasToldThePoseIsWhatTheRestSays) {
  for (const bool seen : {false, true}) {
    corners = seen;
    prior = calibrated_pose({}, {pose = {1.0, 1.5, 0.0}, Vector3d(1e-4, 1e-4, 1e-5).asDiagonal()},
                            2 * (map.junction_count() + map.landmark_count()));
    drive(10, 0.06);
    ASSERT_GT(std::abs(error()), 0.04) << "the wall draws the pose along";
    const WallFootprint footprint = wall_footprints(map)[static_cast<std::size_t>(wall_id)];
    EXPECT_GT(std::abs(without(solution, error(), wall_id, footprint, false).error), 0.04)
        << "the prior has believed it, too";
    const Without rest = without(solution, error(), wall_id, footprint, true);
    EXPECT_LT(std::abs(rest.error), 2.0 * rest.sigma) << seen;
    EXPECT_LT(std::abs(rest.error), 0.02) << seen;
    EXPECT_GT(rest.sigma, 2.0 * std::sqrt(solution.pose.covariance()(1, 1)));
  }
}

TEST_F(AlongAWall, TheProtectionLevelCoversWhatAMovedWallHasDone) {
  const std::vector<WallFootprint> footprints = wall_footprints(map);
  for (const int steps : {0, 1, 3, 10, 20}) {
    drive(steps, 0.06);
    const Integrity integrity = IntegrityMonitor(footprints).assess(solution, std::vector(observed, 0.9));
    EXPECT_GT(integrity.protection.position_high_m, std::abs(error())) << steps;
  }
}

TEST_F(AlongAWall, AWallThatHasToldThePriorNothingIsAnObservationOfNothing) {
  look(0.0);
  const WallFootprint footprint = wall_footprints(map)[static_cast<std::size_t>(wall_id)];
  const BelievedWall told = believed_wall(footprint, solution, solution.prior_information.inverse());
  EXPECT_EQ(told.by_state.norm(), 0.0);
  EXPECT_EQ(told.weighted_residual.norm(), 0.0);
}

}  // namespace
}  // namespace credo::localization
