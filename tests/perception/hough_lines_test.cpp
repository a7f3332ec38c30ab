// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/hough_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/perception/range_world.hpp"

namespace credo::perception {
namespace {

std::vector<ScanLine> lines_in(const RangeWorld& world, const geometry::Pose2& pose, std::uint32_t seed = 0) {
  const sensors::RangeFinder finder = full_turn(360);
  std::vector<sensors::ScanPoint> points;
  sensors::carry_scan(scan_of(world, finder, pose, seed), finder, {}, 0, points);
  return hough_lines(points, {.range = finder.noise, .params = {}});
}

/// The line of the scan that lies on a wall of the world and is seen from its side; nullptr: none.
const ScanLine* on_wall(const std::vector<ScanLine>& lines, const geometry::Segment& wall,
                        const geometry::Pose2& pose) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const ScanLine& line) {
    return std::abs(wall.normal().dot(pose * line.line.centroid - wall.a)) < 0.01 &&
           std::abs(geometry::wrap_line_angle(line.line.angle + pose.theta -
                                              std::atan2(wall.direction().y(), wall.direction().x()))) < 0.01;
  });
  return found == lines.end() ? nullptr : &*found;
}

TEST(HoughLines, FindTheFourWallsOfARoom) {
  RangeWorld world;
  world.add_room(0.0, 0.0, 5.0, 4.0);
  const geometry::Pose2 pose{1.5, 1.2, 0.4};
  const std::vector<ScanLine> lines = lines_in(world, pose, 3);
  EXPECT_EQ(lines.size(), 4u);
  for (const geometry::Segment& wall : world.walls) {
    const ScanLine* line = on_wall(lines, wall, pose);
    ASSERT_NE(line, nullptr) << wall;
    EXPECT_NEAR(line->extent.length(), wall.length(), 0.3);
    EXPECT_GT(line->line.normal().dot(-line->line.centroid), 0.0);  // towards the robot
    EXPECT_GT(line->extent.direction().dot(line->line.direction()), 0.999);
  }
}

TEST(HoughLines, AWallBehindPillarsIsOneLine) {
  RangeWorld world;
  world.add(-3.0, 3.0, 3.0, 3.0);
  for (const double x : {-0.8, -0.1, 0.6}) world.add(x - 0.02, 2.0, x + 0.02, 2.0);
  const std::vector<ScanLine> lines = lines_in(world, {});
  const ScanLine* line = on_wall(lines, world.walls.front(), {});
  ASSERT_NE(line, nullptr);
  EXPECT_GT(line->extent.length(), 5.5);
}

TEST(HoughLines, ADoorWiderThanTheGapPartsTwoWalls) {
  RangeWorld world;
  world.add(-3.0, 2.0, -0.5, 2.0);
  world.add(0.5, 2.0, 3.0, 2.0);
  EXPECT_EQ(lines_in(world, {}).size(), 2u);
}

TEST(HoughLines, OfNoPointsAreNone) { EXPECT_TRUE(hough_lines({}, {}).empty()); }

TEST(HoughLines, RefuseStepsThatAreNone) {
  EXPECT_THROW((void)hough_lines({}, {}, {.angle_step_rad = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::perception
