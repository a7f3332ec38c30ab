// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localization_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "localization/localization_belief.hpp"

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

/// A room of 4 m x 3 m without anything in it, seen from (1, 1) as its corner (0, 0) and whatever else is added.
class EmptyRoom : public ::testing::Test {
 protected:
  EmptyRoom() : map_(plan()) {
    scene_.camera_seen = scene_.range_finder_seen = true;
    solution_.pose.pose = {1.0, 1.0, 0.0};
    widen(solution_.pose, 1e-4 * Eigen::Matrix3d::Identity());
  }

  static geometry::FloorPlan plan() {
    geometry::FloorPlan plan;
    plan.walls = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}, {{4, 3}, {0, 3}}, {{0, 3}, {0, 0}}};
    return plan;
  }

  void see(PrimitiveType type, const Vector2d& place, bool bearing_only = false) {
    Primitive primitive;
    primitive.type = type;
    primitive.position = place - Vector2d(1.0, 1.0);
    primitive.range_m = primitive.position.norm();
    primitive.bearing_only = bearing_only;
    primitive.existence = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
    scene_.primitives.push_back(primitive);
  }

  /// The corner at `place` is seen and matched.
  void match(const Vector2d& place, bool outlier = false) {
    see(PrimitiveType::kCorner, place);
    Observation o;
    o.kind = ObservationKind::kPoint;
    o.primitive = static_cast<int>(scene_.primitives.size()) - 1;
    for (std::size_t k = 0; k < map_.points().size(); ++k)
      if ((map_.points()[k].position - place).norm() < 0.1) o.landmark = map_.point_id(k);
    observations_.push_back(o);
    solution_.outlier.push_back(outlier);
  }

  [[nodiscard]] LocalizationEvidence evidence() const {
    return gather_evidence(scene_, map_, observations_, solution_, params_);
  }
  [[nodiscard]] double ratio() const { return evidence().explained / evidence().detected; }

  LandmarkMap map_;
  Scene scene_;
  PoseSolution solution_;
  std::vector<Observation> observations_;
  LocalizationEvidenceParams params_;
};

TEST_F(EmptyRoom, CountsThePointsInSightAndThoseRecognised) {
  match({0, 0});
  match({4, 0});
  const LocalizationEvidence found = evidence();
  EXPECT_EQ(found.in_sight, 4) << "the corner at (4, 3) is 3.6 m away";
  EXPECT_EQ(found.recognised, 2);
  EXPECT_EQ(found.matched, 2);
  params_.sight_m = 3.0;
  EXPECT_EQ(evidence().in_sight, 2) << "(0, 0) and (0, 3)";
  scene_.camera_seen = scene_.range_finder_seen = false;
  EXPECT_EQ(evidence().in_sight, 0) << "who sees nothing misses nothing";
}

TEST_F(EmptyRoom, WhatStandsBeforeAPointHidesIt) {
  match({0, 0});
  ASSERT_EQ(evidence().in_sight, 4) << "without a scan nothing is hidden";
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(0, 3), Vector2d(4, 3)})
    scene_.points.push_back({.position = corner - Vector2d(1, 1)});
  EXPECT_EQ(evidence().in_sight, 3) << "no beam passes near (4, 0)";
  const Vector2d to_corner = Vector2d(4, 0) - Vector2d(1, 1);
  scene_.points.push_back({.position = 0.6 * to_corner});
  EXPECT_EQ(evidence().in_sight, 3);
  const Vector2d aside(-to_corner.y(), to_corner.x());
  scene_.points.push_back({.position = to_corner - 0.02 * aside});
  EXPECT_EQ(evidence().in_sight, 4) << "the beam on the other side passes";
}

TEST_F(EmptyRoom, AnOutlierIsNeitherMatchedNorRecognised) {
  match({0, 0}, true);
  EXPECT_EQ(evidence().matched, 0);
  EXPECT_EQ(evidence().recognised, 0);
}

TEST_F(EmptyRoom, WhatStandsBehindAWallCountsInFull) {
  match({0, 0});
  EXPECT_DOUBLE_EQ(ratio(), 1.0);
  see(PrimitiveType::kEdge, {1, -1});
  EXPECT_DOUBLE_EQ(ratio(), 0.5);
}

TEST_F(EmptyRoom, WhatWasPutIntoTheRoomCountsLittle) {
  match({0, 0});
  see(PrimitiveType::kEdge, {2, 1});
  EXPECT_DOUBLE_EQ(ratio(), 1.0 / 1.25);
}

TEST_F(EmptyRoom, AMarkOnAWallSaysNothingAJunctionThereDoes) {
  match({0, 0});
  see(PrimitiveType::kOther, {2, 0.01});
  EXPECT_DOUBLE_EQ(ratio(), 1.0);
  see(PrimitiveType::kWall, {2, 0.01});
  EXPECT_DOUBLE_EQ(ratio(), 1.0) << "the face of a curve";
  see(PrimitiveType::kCorner, {2, 0.01});
  EXPECT_DOUBLE_EQ(ratio(), 1.5 / 2.0);
}

TEST_F(EmptyRoom, ABearingAloneIsNotHeldAgainstThePlan) {
  match({0, 0});
  see(PrimitiveType::kOther, {1, -1}, true);
  EXPECT_DOUBLE_EQ(ratio(), 1.0);
}

TEST_F(EmptyRoom, OnThePaperAPrimitiveIsMatchedOrNot) {
  params_.method = perception::Method::kPaper;
  match({0, 0});
  see(PrimitiveType::kOther, {2, 0.01});
  see(PrimitiveType::kOther, {1, -1}, true);
  EXPECT_DOUBLE_EQ(ratio(), 1.0 / 3.0);
}

TEST_F(EmptyRoom, AFewPointsSayNothingOfRecognitionManyMissedOnesDo) {
  LocalizationEvidence few;
  few.in_sight = 3;
  EXPECT_DOUBLE_EQ(recognition_belief(few).unknown, 1.0);
  LocalizationEvidence missed;
  missed.in_sight = 4;
  EXPECT_GT(recognition_belief(missed).no, 0.5);
  LocalizationEvidence seen = missed;
  seen.recognised = 4;
  EXPECT_GT(recognition_belief(seen).yes, 0.5);
  LocalizationBeliefParams paper;
  paper.method = perception::Method::kPaper;
  EXPECT_DOUBLE_EQ(recognition_belief(missed, paper).unknown, 1.0);
}

}  // namespace
}  // namespace credo::localization
