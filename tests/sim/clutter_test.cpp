// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/clutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/passage.hpp"
#include "sim/random_world.hpp"
#include "sim/ray_caster.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

/// Of what a range finder sees of mapped walls along the way, the share that clutter hides.
double hidden_share(const World& bare, const World& cluttered) {
  const RayCaster before(bare, 0.8), after(cluttered, 0.8);
  const Trajectory way(bare.path, bare.drive);
  int walls = 0, hidden = 0;
  for (double t = 0.0; t < way.duration_s(); t += 2.0)
    for (int i = 0; i < 90; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 90;
      const Eigen::Vector2d at = way.pose_at(t).translation(), direction(std::cos(angle), std::sin(angle));
      const auto wall = before.cast(at, direction, 30.0), now = after.cast(at, direction, 30.0);
      if (!wall || !bare.panels[static_cast<std::size_t>(wall->panel)].in_plan) continue;
      ++walls;
      hidden += now->range_m < wall->range_m - 1e-6;
    }
  return static_cast<double>(hidden) / walls;
}

World with_share(World world, double share, std::uint64_t seed) {
  world.clutter_share = share;
  const Trajectory way(world.path, world.drive);
  return with_clutter(std::move(world), way, seed);
}

TEST(Clutter, HidesAboutTheShareOfTheWallsAskedFor) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const World world = random_world(seed);
    const double share = hidden_share(world, with_share(world, 0.3, seed));
    EXPECT_GT(share, 0.1) << world.name;
    EXPECT_LT(share, 0.6) << world.name;
    sum += share / 6.0;
  }
  EXPECT_NEAR(sum, 0.3, 0.1);
}

TEST(Clutter, LeavesTheWayFreeAndThePlanAsItIs) {
  const World world = load_world(shipped("office"));
  const World cluttered = with_share(world, 0.4, 2);
  EXPECT_FALSE(find_obstruction(cluttered, Trajectory(cluttered.path, cluttered.drive)));
  ASSERT_GT(cluttered.panels.size(), world.panels.size() + 20);
  for (std::size_t i = world.panels.size(); i < cluttered.panels.size(); ++i) EXPECT_FALSE(cluttered.panels[i].in_plan);
}

TEST(Clutter, IsPlacedOnceAndNotAgain) {
  const World once = with_share(load_world(shipped("demo")), 0.3, 5);
  const World twice = with_clutter(once, Trajectory(once.path, once.drive), 5);
  EXPECT_EQ(once.clutter_share, 0.0);
  EXPECT_EQ(once.panels.size(), twice.panels.size());
}

}  // namespace
}  // namespace credo::sim
