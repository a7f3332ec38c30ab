// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/rearrangement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <tuple>

#include "geometry/segment.hpp"
#include "sim/plan.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

std::vector<geometry::Segment> plan_of(World world) {
  world.plan_uncertainty_m = 0.0;
  std::vector<geometry::Segment> walls = draw_floor_plan(world, 0.8, 1).walls;
  std::sort(walls.begin(), walls.end(), [](const auto& p, const auto& q) {
    return std::tuple(p.a.x(), p.a.y(), p.b.x(), p.b.y()) < std::tuple(q.a.x(), q.a.y(), q.b.x(), q.b.y());
  });
  return walls;
}

bool has_panel(const World& world, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::any_of(world.panels.begin(), world.panels.end(),
                     [&](const Panel& panel) { return (panel.a - a).norm() < 1e-9 && (panel.b - b).norm() < 1e-9; });
}

TEST(Rearrangement, AWallMovesWithWhatHangsOnIt) {
  World world = ideal_room();
  world.panels.clear();
  Builder builder(world);
  builder.add_walls({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, true, "plain", true);
  builder.add_overlay({.at = {3.9, 1.0}, .width_m = 1.0});
  const auto plan = plan_of(world);
  move_thing(world, {4.0, 0.0}, {-0.4, 0.0}, 0.0);
  EXPECT_TRUE(has_panel(world, {3.6, -4.0}, {3.6, 4.0}));
  EXPECT_TRUE(has_panel(world, {3.596, 0.5}, {3.596, 1.5}));
  EXPECT_TRUE(has_panel(world, {-4.0, -4.0}, {4.0, -4.0}));
  EXPECT_EQ(plan_of(world), plan);
}

TEST(Rearrangement, FurnitureMovesAsAWhole) {
  World world = ideal_room();
  Builder(world).add_box({2.0, 2.0}, {1.0, 0.5}, 0.0, 0.0, 1.2, "cabinet", true);
  const auto plan = plan_of(world);
  move_thing(world, {2.0, 1.8}, {0.0, -1.0}, 0.5 * std::numbers::pi);
  EXPECT_TRUE(has_panel(world, {2.25, 0.5}, {2.25, 1.5}));
  EXPECT_EQ(world.only_planned.size(), 4U);
  EXPECT_EQ(plan_of(world), plan);
}

TEST(Rearrangement, WhereThePlanShowsNothingNothingCanBeMoved) {
  World world = ideal_room();
  Builder(world).add_box({2.0, 2.0}, {1.0, 0.5}, 0.0, 0.0, 1.2, "cabinet", false);
  EXPECT_THAT(
      [&] {
        move_thing(world, {2.0, 1.8}, {0.0, 1.0}, 0.0);
      },
      testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("nothing within 0.5 m of [2, 1.8]")));
}

TEST(Rearrangement, AnOpenDoorMayBeClosedInThePlan) {
  const auto built = [](bool planned_closed) {
    World world;
    world.materials = common_materials();
    Builder builder(world);
    builder.add_walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, true, "wall", true);
    builder.add_door(
        {.at = {2.0, 3.0}, .kind = Door::Kind::kOpening, .width_m = 0.8, .planned_closed = planned_closed});
    return world;
  };
  const auto in_doorway = [](const World& world) {
    const auto plan = plan_of(world);
    return std::any_of(plan.begin(), plan.end(), [](const auto& wall) {
      return geometry::distance({2.0, 3.0}, wall) < 0.01;
    });
  };
  EXPECT_FALSE(in_doorway(built(false)));
  EXPECT_TRUE(in_doorway(built(true)));
}

}  // namespace
}  // namespace credo::sim
