// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/scan_lines.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "perception/observer.hpp"
#include "tests/perception/range_world.hpp"

namespace credo::perception {
namespace {

std::vector<ScanLine> lines_in(const RangeWorld& world) {
  sensors::Rig rig;
  rig.range_finders.push_back(full_turn(360));
  sensors::Acquisition acquisition;
  acquisition.scan = scan_of(world, rig.range_finders.front(), {}, 2);
  Observer observer(rig);
  std::vector<ScanLine> lines;
  scan_lines(observer.observe(acquisition), {}, lines);
  return lines;
}

TEST(ScanLines, HaveTheRobotOnTheirLeft) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 3.0, 2.0);
  const std::vector<ScanLine> lines = lines_in(world);
  EXPECT_EQ(lines.size(), 4u);
  for (const ScanLine& line : lines) {
    EXPECT_GT(line.line.normal().dot(-line.line.centroid), 0.0);
    EXPECT_FALSE(line.end_sigma_m[0] || line.end_sigma_m[1]);  // the walls that meet there tell it
  }
}

TEST(ScanLines, KnowTheEndOfAFaceWithSomethingBehindIt) {
  RangeWorld world;
  world.add_room(-4.0, -4.0, 4.0, 4.0);
  world.add(1.0, -1.0, 1.0, 1.0);  // a screen, whose lower end comes first counter-clockwise
  bool found = false;
  for (const ScanLine& line : lines_in(world)) {
    if (line.extent.centre().norm() > 1.2) continue;
    found = true;
    ASSERT_TRUE(line.end_sigma_m[0] && line.end_sigma_m[1]);
    EXPECT_LT(*line.end_sigma_m[0], 0.05);
    EXPECT_NEAR(line.extent.a.y(), -1.0, 0.05);
  }
  EXPECT_TRUE(found);
}

TEST(ScanLines, LeaveOutTheFacesOfAPillar) {
  RangeWorld world;
  world.add_room(-4.0, -4.0, 4.0, 4.0);
  constexpr int kFaces = 12;
  const auto corner = [](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kFaces;
    return Eigen::Vector2d(1.6 + 0.6 * std::cos(angle), 0.6 * std::sin(angle));
  };
  for (int i = 0; i < kFaces; ++i) world.walls.push_back({corner(i), corner(i + 1)});
  for (const ScanLine& line : lines_in(world)) EXPECT_GT(line.extent.centre().norm(), 2.3) << line.extent;
}

}  // namespace
}  // namespace credo::perception
