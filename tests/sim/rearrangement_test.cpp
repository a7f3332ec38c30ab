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

/// The ideal room, with something put on its walls.
template <typename Furnish>
World walled(const Furnish& furnish) {
  World world = ideal_room();
  world.panels.clear();
  Builder builder(world);
  builder.add_walls({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, true, "plain", true);
  furnish(builder);
  return world;
}

TEST(Rearrangement, AWallMovesWithWhatHangsOnIt) {
  World world = walled([](Builder& builder) { builder.add_overlay({.at = {3.9, 1.0}, .width_m = 1.0}); });
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

/// What stands at breast height at a moment.
bool stands_at(const World& world, double seconds, const Eigen::Vector2d& place) {
  const World now = world_at(world, seconds);
  return std::any_of(now.panels.begin(), now.panels.end(), [&](const Panel& panel) {
    return panel.z0_m <= 1.0 && panel.z1_m >= 1.0 && geometry::distance(place, {panel.a, panel.b}) < 1e-6;
  });
}

TEST(Rearrangement, WhatIsPutMovedAndTakenIsThereInBetween) {
  World world = ideal_room();
  const auto plan = plan_of(world);
  const std::size_t first = world.panels.size();
  Builder(world).add_box({2.0, 2.0}, {1.0, 0.5}, 0.0, 0.0, 1.2, "cabinet", false);
  appear(world, 10.0, first);
  shift(world, 20.0, {2.0, 2.0}, {0.0, -1.0}, 0.5 * std::numbers::pi);
  take_away(world, 30.0, {2.0, 1.0});
  const Eigen::Vector2d before(2.5, 2.0), after(2.25, 1.0);
  for (const double seconds : {0.0, 9.9, 10.0, 19.9, 20.0, 29.9, 30.0, 99.0}) {
    EXPECT_EQ(stands_at(world, seconds, before), seconds >= 10.0 && seconds < 20.0) << seconds;
    EXPECT_EQ(stands_at(world, seconds, after), seconds >= 20.0 && seconds < 30.0) << seconds;
    EXPECT_TRUE(stands_at(world, seconds, {4.0, 0.0})) << seconds;
    EXPECT_EQ(world_at(world, seconds).panels.size(), world.panels.size());
  }
  EXPECT_EQ(state_times(world), (std::vector<double>{0.0, 10.0, 20.0, 30.0}));
  EXPECT_EQ(plan_of(world), plan);
  EXPECT_THROW(take_away(world, 40.0, {2.0, 1.0}), std::invalid_argument);
}

TEST(Rearrangement, WhatThePlanShowsMovesInTheDriveOnly) {
  World world = ideal_room();
  Builder(world).add_box({2.0, 2.0}, {1.0, 0.5}, 0.0, 0.0, 1.2, "cabinet", true);
  const auto plan = plan_of(world);
  shift(world, 20.0, {2.0, 2.0}, {0.0, -1.0}, 0.0);
  EXPECT_EQ(plan_of(world), plan);
  EXPECT_TRUE(stands_at(world, 0.0, {2.5, 2.0}));
  EXPECT_TRUE(stands_at(world, 20.0, {2.5, 1.0}));
}

TEST(Rearrangement, WallsAndWhatHangsOnThemStay) {
  World world = walled([](Builder& builder) { builder.add_overlay({.at = {3.9, 1.0}, .width_m = 1.0}); });
  EXPECT_THAT(
      [&] {
        take_away(world, 5.0, {3.9, 1.0});
      },
      testing::ThrowsMessage<std::invalid_argument>(
          testing::HasSubstr("nothing that can be moved stands within 0.5 m of [3.9, 1]")));
  EXPECT_TRUE(world.changes.empty());
}

TEST(Rearrangement, ADoorTurnsOnItsHinge) {
  World world = walled([](Builder& builder) {
    builder.add_door({.at = {4.0, 0.0}, .kind = Door::Kind::kOpening, .width_m = 1.0, .leaf_rad = 0.0});
  });
  turn_leaf(world, 10.0, {4.0, 0.2}, 0.5 * std::numbers::pi);
  turn_leaf(world, 20.0, {4.0, 0.0}, 0.0);
  const Eigen::Vector2d hinge = world.leaves.front().hinge, away = world.leaves.front().away;
  EXPECT_TRUE(stands_at(world, 0.0, hinge + 0.5 * world.leaves.front().shut));
  EXPECT_FALSE(stands_at(world, 0.0, hinge + 0.5 * away));
  EXPECT_FALSE(stands_at(world, 10.0, hinge + 0.5 * world.leaves.front().shut));
  EXPECT_TRUE(stands_at(world, 10.0, hinge + 0.5 * away));
  EXPECT_TRUE(stands_at(world, 20.0, hinge + 0.5 * world.leaves.front().shut));
  ASSERT_EQ(world.changes.size(), 2U);
  EXPECT_EQ(world.changes[0].event, "door_opened");
  EXPECT_EQ(world.changes[1].event, "door_closed");
  EXPECT_THROW(turn_leaf(world, 30.0, {0.0, 0.0}, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace credo::sim
