// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/transition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The corner of a block at (2, 1): one face along x towards +x, the other along y towards +y.
const Eigen::Vector2d kBlock(2.0, 1.0);
const geometry::Segment kFaceX{{4.0, 1.0}, {2.0, 1.0}}, kFaceY{{2.0, 1.0}, {2.0, 3.0}};

Scene one_face(const geometry::Pose2& T_map_base) { return scene({wall(T_map_base.inverse() * kFaceX)}); }

Scene both_faces(const geometry::Pose2& T_map_base) {
  const geometry::Pose2 T_base_map = T_map_base.inverse();
  Scene s = scene({point(PrimitiveType::kEdge, T_base_map * kBlock)});
  s.segments = {face(T_base_map * kFaceX), face(T_base_map * kFaceY)};
  s.primitives[0].first_segment = 0;
  s.primitives[0].last_segment = 1;
  return s;
}

TEST(Transition, EdgeToWallToEdgeIsOneTrack) {
  // Clerentin et al., fig. 22: an edge until 32, one of its faces until 36, an edge again.
  for (const bool with_odometry : {false, true}) {
    Tracker tracker(with_odometry ? TrackerParams{} : paper());
    geometry::Pose2 robot{0.0, -0.5, 0.0};
    const auto step = motion(0.1, 0.0, 0.0);
    for (int t = 28; t <= 40; ++t) {
      const bool faces = t <= 32 || t >= 37;
      const Scene seen = faces ? both_faces(robot) : one_face(robot);
      const auto& matches = follow(tracker, seen, with_odometry && t > 28 ? std::optional(step) : std::nullopt);
      ASSERT_EQ(tracker.tracks().size(), 1u) << "at " << t;
      EXPECT_EQ(tracker.tracks()[0].id, 0);
      EXPECT_EQ(tracker.tracks()[0].type, faces ? PrimitiveType::kEdge : PrimitiveType::kWall);
      if (t > 28) {
        ASSERT_EQ(matches.size(), 1u) << "at " << t;
        EXPECT_EQ(matches[0].transition, t == 33 || t == 37) << "at " << t;
      }
      robot = robot * step.pose;
    }
    EXPECT_EQ(tracker.tracks()[0].hits, 13);
  }
}

TEST(Transition, KeepsTheMassOfTheTrack) {
  Tracker tracker;
  const geometry::Pose2 robot{};
  for (int t = 0; t < 3; ++t) follow(tracker, both_faces(robot), motion(0.0, 0.0, 0.0));
  const auto before = tracker.tracks()[0].existence;
  follow(tracker, one_face(robot), motion(0.0, 0.0, 0.0));
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].existence, before);
}

TEST(Transition, LeavesAWallAloneThatIsSeenTogetherWithItsCorner) {
  Tracker tracker;
  const geometry::Pose2 robot{};
  Scene both = both_faces(robot);
  both.primitives.push_back(wall(kFaceX));
  follow(tracker, one_face(robot), motion(0.0, 0.0, 0.0));
  const auto& matches = follow(tracker, both, motion(0.0, 0.0, 0.0));
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_FALSE(matches[0].transition);
  EXPECT_EQ(matches[0].primitive, 1);
  ASSERT_EQ(tracker.tracks().size(), 2u) << "the edge is new";
  follow(tracker, both_faces(robot), motion(0.0, 0.0, 0.0));  // now the wall is hidden: the edge has its own track
  EXPECT_EQ(tracker.tracks()[0].state, TrackState::kMissed);
  EXPECT_EQ(tracker.tracks()[0].type, PrimitiveType::kWall);
  EXPECT_EQ(tracker.tracks()[1].state, TrackState::kTracked);
}

TEST(Transition, DoesNotTurnAWallIntoADoorFrameAmidIt) {
  Tracker tracker;
  const geometry::Segment long_wall{{4.0, 1.0}, {-4.0, 1.0}};
  follow(tracker, scene({wall(long_wall)}), motion(0.0, 0.0, 0.0));
  Scene frame = scene({point(PrimitiveType::kOther, {0.5, 1.0})});
  frame.segments = {face({{4.0, 1.0}, {0.5, 1.0}}), face({{0.5, 1.0}, {-4.0, 1.0}})};
  frame.primitives[0].first_segment = 0;
  frame.primitives[0].last_segment = 1;
  EXPECT_THAT(follow(tracker, frame, motion(0.0, 0.0, 0.0)), IsEmpty());
}

TEST(Transition, DoesNotTurnAWallIntoSomebodyElsesCorner) {
  // A corner near the wall's end whose faces run elsewhere.
  Tracker tracker;
  follow(tracker, scene({wall(kFaceX)}), motion(0.0, 0.0, 0.0));
  Scene other = scene({point(PrimitiveType::kEdge, kBlock)});
  other.segments = {face({kBlock + Eigen::Vector2d(1.0, 1.0), kBlock}),
                    face({kBlock, kBlock + Eigen::Vector2d(-1.0, 1.0)})};
  other.primitives[0].first_segment = 0;
  other.primitives[0].last_segment = 1;
  EXPECT_THAT(follow(tracker, other, motion(0.0, 0.0, 0.0)), IsEmpty());
}

TEST(Transition, NeedsTheJunctionOnTheWall) {
  const TransitionParams params;
  const WallLine wall_x = wall_line(line_through(kFaceX), kFaceX);
  Junction junction{.position = kBlock, .faces = {}, .known_faces = 0};
  EXPECT_NEAR(distance_from_end(wall_x, junction, 0.0, params).value(), 0.0, 1e-12);
  junction.position = kBlock + Eigen::Vector2d(0.1, 0.1);
  EXPECT_NEAR(distance_from_end(wall_x, junction, 0.0, params).value(), 0.1, 1e-12);
  junction.position = kBlock + Eigen::Vector2d(0.0, 0.4);
  EXPECT_FALSE(distance_from_end(wall_x, junction, 0.0, params));
  EXPECT_TRUE(distance_from_end(wall_x, junction, params.unmoved_m, params));
  junction.position = kBlock + Eigen::Vector2d(1.0, 0.0);
  EXPECT_FALSE(distance_from_end(wall_x, junction, 0.0, params)) << "amid the wall";
  junction.position = kBlock - Eigen::Vector2d(1.0, 0.0);
  EXPECT_FALSE(distance_from_end(wall_x, junction, 0.0, params)) << "beyond it, and no face between";
  junction.faces[0] = wall_line(line_through({{1.0, 1.0}, {3.0, 1.0}}), {{1.0, 1.0}, {3.0, 1.0}});
  junction.known_faces = 1;
  EXPECT_NEAR(distance_from_end(wall_x, junction, 0.0, params).value(), 1.0, 1e-12);
}

}  // namespace
}  // namespace credo::tracking
