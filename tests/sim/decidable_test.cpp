// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/decidable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/random_world.hpp"
#include "sim/trajectory.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

geometry::Pose2 half_way(const World& world) {
  const Trajectory way(world.path, world.drive);
  return way.pose_at(0.5 * way.duration_s());
}

TEST(DecidablePlace, ASquareRoomHasNone) {
  World world = ideal_room();
  world.range_finders = {range_finder_preset("rplidar-a1")};
  EXPECT_FALSE(decidable(world, {1.3, 0.4, 0.2}));
}

TEST(DecidablePlace, ACupboardInASquareRoomDecides) {
  World world = ideal_room();
  world.range_finders = {range_finder_preset("rplidar-a1")};
  Builder(world).add_box({3.0, 2.0}, {0.8, 1.6}, 0.0, 0.0, 2.0, "cabinet", true);
  EXPECT_TRUE(decidable(world, {1.3, 0.4, 0.2}));
}

TEST(DecidablePlace, WhatIsOutOfReachDecidesNothing) {
  World world = ideal_room();
  world.range_finders = {range_finder_preset("rplidar-a1")};
  Builder(world).add_box({3.0, 2.0}, {0.8, 1.6}, 0.0, 0.0, 0.5, "cabinet", true);  // lower than the range finder
  EXPECT_FALSE(decidable(world, {1.3, 0.4, 0.2}));
}

TEST(DecidablePlace, TheMiddleOfALongBareCorridorIsNone) {
  World world;
  world.materials = common_materials();
  Builder(world).add_walls({{0, 0}, {30, 0}, {30, 2}, {0, 2}}, true, "wall", true);
  world.path = {{{5.0, 1.0}, false}, {{25.0, 1.0}, false}};
  world.range_finders = {range_finder_preset("opensimple")};
  EXPECT_FALSE(decidable(world, {15.0, 1.0, 0.1}));
  world.range_finders = {range_finder_preset("rplidar-a1")};
  world.range_finders[0].finder.range_max_m = 40.0;
  EXPECT_FALSE(decidable(world, {15.0, 1.0, 0.1}));  // the corridor turned by half a turn
  Builder(world).add_box({12.0, 0.2}, {0.5, 0.4}, 0.0, 0.0, 2.0, "cabinet", true);
  EXPECT_TRUE(decidable(world, {15.0, 1.0, 0.1}));
}

TEST(DecidablePlace, ASymmetricRoomHasNoneAndAnOfficeHasSome) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const World world = random_world(seed, {.kind = BuildingKind::kSymmetricRoom});
    EXPECT_FALSE(decidable(world, half_way(world))) << seed;
  }
  const World office = load_world(shipped("demo"));
  EXPECT_TRUE(decidable(office, half_way(office)));
}

TEST(DecidablePlace, NeedsARangeFinder) {
  EXPECT_THROW((void)decidable(ideal_room(), {0.0, 0.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::sim
