// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/degradation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/passage.hpp"
#include "sim/random_world.hpp"
#include "sim/simulation.hpp"
#include "sim/trajectory.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

TEST(Degradation, EveryOneOfThemLeavesAWorldThatCanBeSimulated) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const World world = random_world(seed);
    for (const std::string& name : degradation_names()) {
      SCOPED_TRACE(world.name + " " + name);
      World worse;
      ASSERT_NO_THROW(worse = degraded(world, name, seed));
      EXPECT_NO_THROW((void)Simulation(worse, seed));
    }
  }
}

TEST(Degradation, ACarriedRobotIsAMetreOffAndDrivesOnForSixMetres) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const World world = degraded(random_world(seed), "kidnap", seed);
    SCOPED_TRACE(world.name);
    const Trajectory way(world.path, world.drive);
    ASSERT_EQ(way.carried().size(), 1U);
    const double when = way.carried()[0];
    EXPECT_GT(when, 0.15 * way.duration_s());
    const geometry::Pose2 before = way.pose_at(when - 1e-6), after = way.pose_at(when + 1e-6);
    EXPECT_GE((before.translation() - after.translation()).norm(), 1.0);
    const double turn = std::abs(geometry::angle_difference(after.theta, before.theta));
    EXPECT_TRUE(turn < 1e-6 || turn >= geometry::to_radians(30.0) - 1e-6) << turn;
    double driven = 0.0;
    for (double t = when + 0.1; t < way.duration_s(); t += 0.1)
      driven += (way.pose_at(t + 0.1).translation() - way.pose_at(t).translation()).norm();
    EXPECT_GE(driven, 5.9);
  }
}

TEST(Degradation, ATurnedRobotStaysWhereItIs) {
  const World world = degraded(load_world(shipped("demo")), "turned", 3);
  const Trajectory way(world.path, world.drive);
  const double when = way.carried().at(0);
  const geometry::Pose2 before = way.pose_at(when - 1e-6), after = way.pose_at(when + 1e-6);
  EXPECT_LT((before.translation() - after.translation()).norm(), 1e-4);
  EXPECT_GE(std::abs(geometry::angle_difference(after.theta, before.theta)), geometry::to_radians(30.0) - 1e-6);
}

TEST(Degradation, TheWorstRangeFinderHas128Beams) {
  const World world = degraded(load_world(shipped("demo")), "worst", 1);
  EXPECT_EQ(world.range_finders[0].finder.count, 128);
  EXPECT_DOUBLE_EQ(world.range_finders[0].finder.noise.k_per_m, 0.01);
  EXPECT_EQ(world.range_finders[0].finder.height_m, 0.8);
  EXPECT_GT(world.people, 0);
  EXPECT_EQ(world.clutter_share, 0.3);
}

TEST(Degradation, AMovedWallIsWhereThePlanDoesNotShowIt) {
  const World world = load_world(shipped("office"));
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const World worse = degraded(world, "moved_wall", seed);
    const auto mapped = [](const World& w) {
      return std::count_if(w.panels.begin(), w.panels.end(), [](const Panel& p) { return p.in_plan; });
    };
    const bool moved =
        mapped(worse) + static_cast<long>(worse.only_planned.size()) == mapped(world) && !worse.only_planned.empty();
    const bool is_new = worse.panels.size() == world.panels.size() + 1;
    EXPECT_TRUE(moved || is_new);
    EXPECT_EQ(Simulation(worse, 1).floor_plan().walls.size(), Simulation(world, 1).floor_plan().walls.size());
  }
}

TEST(Degradation, AnUnknownOneIsRefusedWithTheNearest) {
  EXPECT_THAT([] { (void)degraded(load_world(shipped("demo")), "kidnapp", 1); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("did you mean 'kidnap'?")));
}

}  // namespace
}  // namespace credo::sim
