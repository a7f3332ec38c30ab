// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/observations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/localization/sightings.hpp"
#include "tests/support/seeded.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using geometry::Pose2;
using geometry::Segment;
using perception::Scene;
using namespace test;  // NOLINT: the helpers of these tests

constexpr auto kCorner = PrimitiveType::kCorner;
constexpr double kPlan_m = 0.01;

Vector2d residual_at(const Pose2& pose, const Observation& o) {
  Vector2d residual;
  evaluate(o, pose, residual);
  return residual;
}

double smallest_variance(const Matrix2d& covariance) {
  return Eigen::SelfAdjointEigenSolver<Matrix2d>(covariance).eigenvalues()(0);
}

WallLandmark landmark(const Segment& extent) {
  WallLandmark wall;
  wall.extent = extent;
  wall.direction = extent.direction();
  wall.length_m = extent.length();
  wall.plan_terms = {{0, 1.0, -1.0 / wall.length_m}, {1, 0.0, 1.0 / wall.length_m}};
  return wall;
}

PointLandmark landmark(const Vector2d& position) {
  PointLandmark point;
  point.position = position;
  return point;
}

/// The corner (6, 0) of the walls y = 0 and x = 6, its two faces being segments 0 and 1, seen from kPose.
class CornerOfTwoWalls : public ::testing::Test {
 protected:
  CornerOfTwoWalls() : corner_(point_seen(kCorner, place_, kPose)) {
    for (const Segment& wall : {Segment{{3, 0}, {6, 0}}, Segment{{6, 0}, {6, 3}}}) {
      perception::FusedSegment face;
      face.line = wall_seen(wall, kPose).line;
      scene_.segments.push_back(face);
    }
    corner_.first_segment = 0;
    corner_.last_segment = 1;
    scene_.camera_origin = {0.2, 0.1};
    scene_.radial_lines.push_back(
        {.azimuth = bearing_seen(place_, kPose, scene_.camera_origin, 0).azimuth, .sigma = 0.002});
  }

  [[nodiscard]] Observation observe(const std::vector<bool>& wall_in_use) const {
    return observe_point(scene_, corner_, landmark(place_), wall_in_use, kPlan_m);
  }
  /// Variance of the observed position along a direction of the map.
  static double variance_along(const Observation& o, const Vector2d& in_map) {
    const Vector2d in_base = kPose.rotation().transpose() * in_map;
    return in_base.dot(o.noise * in_base);
  }

  Vector2d place_{6.0, 0.0};
  Primitive corner_;
  Scene scene_;
};

TEST_F(CornerOfTwoWalls, IsAPositionWhereItsWallsAreNotUsed) {
  corner_.radial_line = 0;
  const Observation o = observe({false, false});
  EXPECT_EQ(o.kind, ObservationKind::kPoint);
  EXPECT_LT(residual_at(kPose, o).norm(), 1e-12);
  EXPECT_LT(variance_along(o, Vector2d::UnitX()), 2e-4);
  EXPECT_LT(variance_along(o, Vector2d::UnitY()), 2e-4);
  const double own = ObservationParams{}.as_built_sigma_m;
  EXPECT_LT((o.plan - (kPlan_m * kPlan_m + own * own) * Matrix2d::Identity()).norm(), 1e-12);
}

TEST_F(CornerOfTwoWalls, IsTheCamerasBearingWhereAWallIsUsed) {
  corner_.radial_line = 0;
  for (const auto& used : {std::vector<bool>{true, false}, {false, true}, {true, true}}) {
    const Observation o = observe(used);
    EXPECT_EQ(o.kind, ObservationKind::kBearing);
    EXPECT_EQ(o.dimension(), 1);
    EXPECT_EQ(o.base_point, scene_.camera_origin);
    EXPECT_LT(residual_at(kPose, o).norm(), 1e-12);
    EXPECT_GT(o.noise(0, 0), 0.0);
  }
}

TEST_F(CornerOfTwoWalls, SaysNothingAcrossAWallThatIsUsed) {
  const Observation o = observe({true, false});
  EXPECT_EQ(o.kind, ObservationKind::kPoint);
  EXPECT_LT(variance_along(o, Vector2d::UnitX()), 2e-4) << "along the wall y = 0";
  EXPECT_GT(variance_along(o, Vector2d::UnitY()), 10.0) << "across it";
  EXPECT_GT(smallest_variance(observe({true, true}).noise), 10.0) << "both walls say it all";
}

TEST_F(CornerOfTwoWalls, ABearingOnlyIsABearingWhateverIsUsed) {
  corner_ = bearing_seen(place_, kPose, scene_.camera_origin, 0);
  for (const bool used : {false, true}) {
    const Observation o = observe({used, used});
    EXPECT_EQ(o.kind, ObservationKind::kBearing);
    EXPECT_LT(residual_at(kPose, o).norm(), 1e-12);
  }
}

TEST_F(CornerOfTwoWalls, NoiseHasAFloor) {
  const ObservationParams floors;
  corner_.position_covariance.setZero();
  EXPECT_NEAR(smallest_variance(observe({false, false}).noise), floors.min_wall_sigma_m * floors.min_wall_sigma_m,
              1e-12);
  corner_.radial_line = 0;
  scene_.radial_lines[0].sigma = 0.0;
  EXPECT_DOUBLE_EQ(observe({true, true}).noise(0, 0), floors.min_bearing_sigma_rad * floors.min_bearing_sigma_rad);
  Primitive wall = wall_seen({{3, 0}, {6, 0}}, kPose);
  wall.line.sigma_across = wall.line.sigma_angle = 0.0;
  const Observation o = observe_wall(wall, landmark(Segment{{0, 0}, {6, 0}}), kPose, kPlan_m);
  EXPECT_DOUBLE_EQ(o.noise(0, 0), floors.min_wall_sigma_m * floors.min_wall_sigma_m);
  EXPECT_DOUBLE_EQ(o.noise(1, 1), floors.min_wall_sigma_rad * floors.min_wall_sigma_rad);
}

TEST(ObserveWall, AStepAcrossOrATurnIsTheResidual) {
  const Segment wall{{0, 0}, {6, 0}};
  const Observation o = observe_wall(wall_seen({{1, 0}, {3, 0}}, kPose), landmark(wall), kPose, kPlan_m);
  EXPECT_EQ(o.kind, ObservationKind::kWall);
  EXPECT_LT(residual_at({kPose.x + 0.7, kPose.y, kPose.theta}, o).norm(), 1e-12) << "along a wall nothing is said";
  EXPECT_NEAR(std::abs(residual_at({kPose.x, kPose.y + 0.2, kPose.theta}, o)(0)), 0.2, 1e-12);
  EXPECT_NEAR(std::abs(residual_at({kPose.x, kPose.y, kPose.theta + 0.1}, o)(1)), 0.1, 1e-12);
}

TEST(ObserveWall, ThePlansErrorIsThatWhereTheWallIsSeen) {
  const Segment wall{{0, 0}, {6, 0}};
  const auto across = [&](double from, double to) {
    return observe_wall(wall_seen({{from, 0}, {to, 0}}, kPose), landmark(wall), kPose, kPlan_m).plan(0, 0);
  };
  EXPECT_LT(across(2, 4), across(0, 1)) << "amid the wall the errors of both ends average out";
  EXPECT_DOUBLE_EQ(across(-4, -2), across(-1, 1)) << "never worse than at its end";
}

// ---------------------------------------------------------------------------------------------- laws

/// No residual at the truth; each part of its covariance is a covariance, and together they can be inverted.
bool is_of_the_truth(const Observation& o, const Pose2& truth) {
  const bool bearing = o.kind == ObservationKind::kBearing;
  return residual_at(truth, o).norm() < 1e-9 && (bearing ? o.noise(0, 0) : smallest_variance(o.noise)) > 0.0 &&
         smallest_variance(o.plan) >= 0.0;
}

RC_GTEST_PROP(Observations, OfTheTruthHaveNoResidualThere, (unsigned seed)) {
  Random random(seed);
  const Pose2 pose = random.pose();
  const Segment wall = random.segment();
  const Segment piece{wall.a + 0.2 * (wall.b - wall.a), wall.a + 0.7 * (wall.b - wall.a)};
  RC_ASSERT(is_of_the_truth(observe_wall(wall_seen(piece, pose), landmark(wall), pose, kPlan_m), pose));
  const Vector2d place = random.place();
  Scene scene;
  scene.camera_origin = 0.05 * random.place();
  RC_ASSERT(
      is_of_the_truth(observe_point(scene, point_seen(kCorner, place, pose), landmark(place), {}, kPlan_m), pose));
  const Primitive bearing = bearing_seen(place, pose, scene.camera_origin, 0);
  scene.radial_lines.push_back({.azimuth = bearing.azimuth, .sigma = 0.002});
  RC_ASSERT(is_of_the_truth(observe_point(scene, bearing, landmark(place), {}, kPlan_m), pose));
}

RC_GTEST_PROP(Observations, ThePlacesDerivativeByThePoseIsTheNumericOne, (unsigned seed)) {
  Random random(seed);
  const Pose2 pose = random.pose();
  const Vector2d place = random.place();
  constexpr double h = 1e-6;
  Eigen::Matrix<double, 2, 3> numeric;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    const Pose2 up{pose.x + step.x(), pose.y + step.y(), pose.theta + step.z()};
    const Pose2 down{pose.x - step.x(), pose.y - step.y(), pose.theta - step.z()};
    numeric.col(k) = (up.inverse() * place - down.inverse() * place) / (2.0 * h);
  }
  RC_ASSERT((base_coordinates_by_pose(pose, pose.inverse() * place) - numeric).norm() < 1e-7);
}

}  // namespace
}  // namespace credo::localization
