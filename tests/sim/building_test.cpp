// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/building.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

TEST(Builder, AnOpeningIsCutThroughBothFacesOfAWall) {
  World world;
  world.materials = common_materials();
  Builder builder(world);
  builder.add_walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, true, "wall", true);
  builder.add_walls({{0, 3.12}, {4, 3.12}, {4, 6}, {0, 6}}, true, "wall", true);
  builder.add_door({.at = {2.0, 3.0}, .kind = Door::Kind::kOpening, .width_m = 0.8});
  int blocking = 0, jambs = 0;
  for (const Panel& panel : world.panels) {
    if (panel.z0_m > 1.0) continue;
    blocking += geometry::distance({2.0, 3.06}, {panel.a, panel.b}) < 0.35;
    jambs += std::abs((panel.b - panel.a).norm() - 0.12) < 1e-9 && panel.in_plan;
  }
  EXPECT_EQ(blocking, 0);
  EXPECT_EQ(jambs, 2);
  EXPECT_EQ(world.marks.size(), 4U);
}

TEST(Builder, AClosedDoorLeavesTheWallWholeAndMarksItsFrame) {
  World world;
  world.materials = common_materials();
  Builder builder(world);
  builder.add_walls({{0, 0}, {4, 0}}, false, "wall", true);
  builder.add_door({.at = {2.0, 0.1}, .width_m = 0.9, .frame_m = 0.05});
  EXPECT_EQ(std::count_if(world.panels.begin(), world.panels.end(), [](const Panel& p) { return p.in_plan; }), 1);
  ASSERT_EQ(world.marks.size(), 4U);
  for (const Eigen::Vector2d& mark : world.marks) EXPECT_NEAR(mark.y(), 0.0, 1e-12);
}

TEST(Builder, RefusesWhatDoesNotFit) {
  World world;
  world.materials = common_materials();
  Builder builder(world);
  builder.add_walls({{0, 0}, {1, 0}}, false, "wall", true);
  EXPECT_THROW(builder.add_door({.at = {5.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(builder.add_door({.at = {0.5, 0.0}, .width_m = 1.5}), std::invalid_argument);
  EXPECT_THROW(builder.add_overlay({.at = {0.5, 0.0}, .material = "stone"}), std::invalid_argument);
  EXPECT_THROW(builder.add_pillar({0, 0}, 0.3, 2, 0.0, "wall", true), std::invalid_argument);
}

}  // namespace
}  // namespace credo::sim
