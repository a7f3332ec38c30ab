// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/random_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "sim/passage.hpp"
#include "sim/simulation.hpp"

namespace credo::sim {
namespace {

double length_of(const World& world) {
  double length = 0.0;
  for (std::size_t i = 1; i < world.path.size(); ++i)
    length += (world.path[i].position - world.path[i - 1].position).norm();
  return length;
}

TEST(RandomWorld, OfEveryKindCanBeDrivenFarEnough) {
  for (const BuildingKind kind : building_kinds())
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const World world = random_world(seed, {.kind = kind});
      SCOPED_TRACE(world.name);
      EXPECT_FALSE(find_obstruction(world, Trajectory(world.path, world.drive)));
      EXPECT_GE(length_of(world), 10.0 - 1e-6);
      EXPECT_LE(length_of(world), 25.0 + 1e-6);
      if (seed > 0) continue;
      EXPECT_NO_THROW((void)Simulation(world, seed));
    }
}

TEST(RandomWorld, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto corners = [](const World& world) {
    std::vector<double> all;
    for (const Panel& p : world.panels) all.insert(all.end(), {p.a.x(), p.a.y(), p.b.x(), p.b.y(), p.z0_m, p.z1_m});
    for (const Waypoint& waypoint : world.path) all.insert(all.end(), {waypoint.position.x(), waypoint.position.y()});
    return all;
  };
  EXPECT_EQ(corners(random_world(7)), corners(random_world(7)));
  EXPECT_NE(corners(random_world(7)), corners(random_world(8)));
}

TEST(RandomWorld, GoesThroughSeveralRooms) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const World world = random_world(seed);
    const Trajectory way(world.path, world.drive);
    std::set<std::size_t> visited;
    for (double t = 0.0; t < way.duration_s(); t += 0.5)
      for (std::size_t room = 0; room < world.areas.size(); ++room) {
        Eigen::AlignedBox2d box;
        for (const Eigen::Vector2d& corner : world.areas[room]) box.extend(corner);
        if (world.areas[room].size() == 4 && box.contains(way.pose_at(t).translation())) visited.insert(room);
      }
    EXPECT_GE(visited.size(), 2U) << world.name;  // besides an angled corridor
  }
}

TEST(RandomWorld, TheModulesLookAlike) {
  const World world = random_world(3, {.kind = BuildingKind::kModules});
  ASSERT_GE(world.areas.size(), 5U);
  const double module = world.areas[2][0].x() - world.areas[1][0].x();
  // What stands in the second room, moved by a module, stands in the third.
  int compared = 0;
  for (const Panel& panel : world.panels) {
    const double left = world.areas[2][0].x(), right = world.areas[2][1].x(), front = world.areas[2][0].y();
    const auto inside = [&](const Eigen::Vector2d& p) { return p.x() > left && p.x() < right && p.y() > front + 0.1; };
    if (!inside(panel.a) || !inside(panel.b)) continue;
    const Eigen::Vector2d shift(module, 0.0);
    EXPECT_TRUE(std::any_of(world.panels.begin(), world.panels.end(), [&](const Panel& other) {
      return (other.a - panel.a - shift).norm() < 1e-9 && (other.b - panel.b - shift).norm() < 1e-9;
    }));
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(RandomWorld, TakesTheRangeFinderAndTheModeAskedFor) {
  const World world = random_world(1, {.range_preset = "lab-1999", .mode = Drive::Mode::kStopAndGo});
  EXPECT_EQ(world.range_finders[0].finder.count, 256);
  EXPECT_EQ(world.range_finders[0].rate_hz, 0.0);
  EXPECT_GE(world.drive.pause_s, world.range_finders[0].finder.scan_time_s);
  EXPECT_THROW((void)random_world(1, {.range_preset = "none"}), std::invalid_argument);
}

TEST(RandomWorld, KindsHaveNames) {
  for (const BuildingKind kind : building_kinds()) EXPECT_EQ(building_kind(name_of(kind)), kind);
  EXPECT_THAT([] { (void)building_kind("cellar"); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("one of corridor")));
}

}  // namespace
}  // namespace credo::sim
