// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/motion_prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::localization {
namespace {

using geometry::Pose2;
using perception::PrimitiveType;

TEST(MotionPredictor, BeforeAnyStepItRestsAndKnowsLittle) {
  const MotionPredictor predictor;
  const geometry::PoseEstimate next = predictor.predict(1.0);
  EXPECT_EQ(next.pose, Pose2{});
  EXPECT_GT(std::sqrt(next.covariance(0, 0)), 0.3);
  EXPECT_TRUE(predictor.empty());
}

TEST(MotionPredictor, StepsScaleWithTime) {
  MotionPredictor predictor;
  predictor.add({0.3, 0.0, 0.0}, 1.0);
  EXPECT_NEAR(predictor.predict(2.0).pose.x, 0.6, 1e-12);
  EXPECT_NEAR(predictor.predict(0.5).pose.x, 0.15, 1e-12);
}

TEST(MotionPredictor, OneWrongPoseIsNotFollowed) {
  MotionPredictor predictor;
  predictor.add({0.3, 0.0, 0.0}, 1.0);
  predictor.add({0.8, 0.0, 0.3}, 1.0);    // to a wrong pose
  predictor.add({-0.2, 0.0, -0.3}, 1.0);  // and back
  EXPECT_NEAR(predictor.predict(1.0).pose.x, 0.3, 1e-12);
  EXPECT_NEAR(predictor.predict(1.0).pose.theta, 0.0, 1e-12);
}

/// Landmarks around the robot as tracks at time 1, and the scene after `step` at time 2.
struct Surroundings {
  std::vector<tracking::Track> tracks;
  perception::Scene scene;

  explicit Surroundings(const Pose2& step) {
    for (int i = 0; i < 9; ++i) {
      perception::Primitive seen;
      seen.type = i % 2 == 0 ? PrimitiveType::kCorner : PrimitiveType::kEdge;
      seen.position = (2.0 + 0.2 * i) * Eigen::Vector2d(std::cos(0.25 * i * i), std::sin(0.25 * i * i));
      seen.azimuth = std::atan2(seen.position.y(), seen.position.x());
      tracking::Track track;
      track.type = seen.type;
      track.last_seen = seen;
      track.last_seen_time = 1;
      tracks.push_back(track);
      seen.position = step.inverse() * seen.position;
      seen.azimuth = std::atan2(seen.position.y(), seen.position.x());
      scene.primitives.push_back(seen);
    }
  }
};

TEST(UnforeseenTurn, IsFoundInTheAzimuths) {
  for (const double turn : {-0.6, -0.3, 0.25, 0.7}) {
    const Surroundings seen(Pose2{0.3, 0.0, turn});
    EXPECT_NEAR(unforeseen_turn(seen.tracks, 1, seen.scene, {0.3, 0.0, 0.0}), turn, 0.02);
  }
}

TEST(UnforeseenTurn, IsNoneWhereTheStepWasForeseen) {
  const Surroundings seen(Pose2{0.3, 0.0, 0.2});
  EXPECT_EQ(unforeseen_turn(seen.tracks, 1, seen.scene, {0.3, 0.0, 0.2}), 0.0);
}

TEST(UnforeseenTurn, IsNoneWhereNothingLeads) {
  Surroundings seen(Pose2{0.0, 0.0, 0.4});
  EXPECT_EQ(unforeseen_turn(seen.tracks, 2, seen.scene, {}), 0.0);  // no track was seen then
  seen.scene.primitives.clear();
  EXPECT_EQ(unforeseen_turn(seen.tracks, 1, seen.scene, {}), 0.0);
}

}  // namespace
}  // namespace credo::localization
