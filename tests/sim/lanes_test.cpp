// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/lanes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/segment.hpp"
#include "sim/free_space.hpp"
#include "sim/passage.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

using testing::HasSubstr;
using Point = Eigen::Vector2d;

/// 8 m by 6 m from the origin on, and a robot with a range finder at 0.8 m.
World room() {
  World world;
  world.name = "room";
  world.materials = common_materials();
  Builder(world).add_walls({{0, 0}, {8, 0}, {8, 6}, {0, 6}}, true, "wall", true);
  world.range_finders.push_back(range_finder_preset("opensimple"));
  return world;
}

World with_path(World world, const Lanes& lanes) {
  world.path = sweep_in_lanes(world, lanes);
  return world;
}

/// The farthest that a place where the robot can be is from its way.
double farthest_from_way(const World& world) {
  double farthest = 0.0;
  for (const Point& place : FreeSpace(world, {world.robot_radius_m, 1.0}, world.path.front().position).places()) {
    double least = 1e9;
    for (std::size_t i = 1; i < world.path.size(); ++i)
      least = std::min(least, geometry::distance(place, {world.path[i - 1].position, world.path[i].position}));
    farthest = std::max(farthest, least);
  }
  return farthest;
}

std::string complaint(const World& world, const Lanes& lanes) {
  try {
    (void)sweep_in_lanes(world, lanes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Lanes, AnEmptyRoomIsDrivenUpAndDown) {
  const World world = with_path(room(), {.start = {0.6, 0.6}, .spacing_m = 1.5});
  ASSERT_EQ(world.path.size(), 8U);  // four lanes of two ends
  for (std::size_t i = 0; i < world.path.size(); ++i) {
    EXPECT_NEAR(world.path[i].position.y(), 0.6 + 1.5 * static_cast<double>(i / 2), 1e-9);
    const bool at_right = i % 4 == 1 || i % 4 == 2;
    EXPECT_NEAR(world.path[i].position.x(), at_right ? 7.55 : i == 0 ? 0.6 : 0.45, 0.15) << i;
  }
  EXPECT_FALSE(find_obstruction(world, Trajectory(world.path, world.drive)));
}

TEST(Lanes, LieAlongTheHeadingInWhichTheRobotSetsOut) {
  for (const double heading : {0.0, 0.6, 1.5708, -2.0}) {
    const Lanes lanes{.start = {4.0, 3.0}, .heading_rad = heading};
    const World world = with_path(room(), lanes);
    const Trajectory way(world.path, world.drive);
    EXPECT_NEAR(geometry::angle_difference(way.pose_at(0.0).theta, heading), 0.0, 1e-9);
    EXPECT_EQ(way.pose_at(0.0).translation(), lanes.start);
    EXPECT_LT(farthest_from_way(world), 1.3) << heading;
    EXPECT_FALSE(find_obstruction(world, way)) << heading;
  }
}

TEST(Lanes, EndBeforeAnObstacleAndGoOnBehindIt) {
  World world = room();
  Builder(world).add_box({4.0, 3.0}, {1.6, 1.2}, 0.3, 0.0, 2.0, "cabinet", false);
  world = with_path(world, {.start = {0.6, 0.6}, .spacing_m = 0.8});
  EXPECT_FALSE(find_obstruction(world, Trajectory(world.path, world.drive)));
  EXPECT_LT(farthest_from_way(world), 0.9);
  const auto on_lane = [&](double from, double to) {
    return std::any_of(world.path.begin(), world.path.end(), [&](const Waypoint& waypoint) {
      return std::abs(waypoint.position.y() - 3.0) < 1e-9 && waypoint.position.x() > from && waypoint.position.x() < to;
    });
  };
  EXPECT_TRUE(on_lane(2.0, 3.2));  // before it
  EXPECT_TRUE(on_lane(4.8, 6.0));  // behind it
}

TEST(Lanes, OneRoomIsDoneBeforeTheNext) {
  World world = room();
  Builder(world).add_walls({{4, 0}, {4, 2.5}}, false, "wall", true);
  Builder(world).add_walls({{4, 3.5}, {4, 6}}, false, "wall", true);
  world = with_path(world, {.start = {0.6, 0.6}, .spacing_m = 0.8});
  int through_the_door = 0;
  for (std::size_t i = 1; i < world.path.size(); ++i)
    through_the_door += (world.path[i - 1].position.x() - 4.0) * (world.path[i].position.x() - 4.0) < 0.0;
  EXPECT_LE(through_the_door, 3);  // there; and once there and back on the lane that goes through it
  EXPECT_LT(farthest_from_way(world), 1.0);
}

TEST(Lanes, KeepTheirMargin) {
  const World world = with_path(room(), {.start = {4.0, 3.0}, .margin_m = 1.2});
  for (const Waypoint& waypoint : world.path)
    for (const Panel& panel : world.panels)
      EXPECT_GE(geometry::distance(waypoint.position, {panel.a, panel.b}), world.robot_radius_m + 1.2);
}

TEST(Lanes, KeepOffWhatComesLater) {
  World world = room();
  const std::size_t first = world.panels.size();
  Builder(world).add_box({4.0, 3.0}, {1.0, 1.0}, 0.0, 0.0, 2.0, "cabinet", false);
  for (std::size_t i = first; i < world.panels.size(); ++i) world.panels[i].from_s = 1e4;
  world = with_path(world, {.start = {0.6, 0.6}});
  for (const Panel& panel : world.panels)
    for (std::size_t i = 1; i < world.path.size(); ++i)
      EXPECT_GT(geometry::distance(panel.a, {world.path[i - 1].position, world.path[i].position}), 0.3);
}

TEST(Lanes, RefuseWhereNoneFits) {
  EXPECT_THAT(complaint(room(), {.start = {0.1, 0.6}}),
              HasSubstr("no room for the robot at the start of the lanes, [0.1"));
  World narrow = room();
  Builder(narrow).add_walls({{1.0, 0}, {1.0, 6}}, false, "wall", true);
  Builder(narrow).add_walls({{0, 1.0}, {1.0, 1.0}}, false, "wall", true);
  EXPECT_THAT(complaint(narrow, {.start = {0.5, 0.5}}), HasSubstr("no lane fits"));
}

}  // namespace
}  // namespace credo::sim
