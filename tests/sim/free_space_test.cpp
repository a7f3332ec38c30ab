// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/free_space.hpp"

#include <gtest/gtest.h>

#include "geometry/segment.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

/// Two rooms of 4 m by 4 m, side by side, with a doorway of 1 m between them.
World two_rooms() {
  World world;
  world.materials = common_materials();
  Builder builder(world);
  builder.add_walls({{0, 0}, {8, 0}, {8, 4}, {0, 4}}, true, "wall", true);
  builder.add_walls({{4, 0}, {4, 1.5}}, false, "wall", true);
  builder.add_walls({{4, 2.5}, {4, 4}}, false, "wall", true);
  return world;
}

TEST(FreeSpace, ReachesWhereTheBodyFits) {
  const FreeSpace space(two_rooms(), {0.3, 1.0}, {1.0, 1.0});
  EXPECT_TRUE(space.reaches({7.0, 3.0}));
  EXPECT_FALSE(space.reaches({7.0, 3.8}));
  EXPECT_FALSE(space.reaches({9.0, 3.0}));
  EXPECT_NEAR(space.clearance({2.0, 0.55}), 0.55, 0.08);
  EXPECT_EQ(space.clearance({2.0, 2.0}), FreeSpace::kFar_m);
  const FreeSpace stout(two_rooms(), {0.5, 1.0}, {1.0, 1.0});
  EXPECT_FALSE(stout.reaches({7.0, 3.0}));
}

TEST(FreeSpace, OverWhatIsHighOneWalksUnder) {
  World world = two_rooms();
  Builder(world).add_box({4.0, 2.0}, {0.2, 1.0}, 0.0, 1.5, 2.6, "cabinet", false);
  EXPECT_TRUE(FreeSpace(world, {0.3, 1.0}, {1.0, 1.0}).reaches({7.0, 3.0}));
  EXPECT_FALSE(FreeSpace(world, {0.3, 1.8}, {1.0, 1.0}).reaches({7.0, 3.0}));
}

TEST(FreeSpace, ARouteGoesThroughTheDoorInFewLegs) {
  const World world = two_rooms();
  const FreeSpace space(world, {0.3, 1.0}, {1.0, 1.0});
  const auto route = space.route({1.0, 3.5}, {7.0, 3.5});
  ASSERT_GE(route.size(), 3U);
  EXPECT_LE(route.size(), 8U);
  EXPECT_EQ(route.front(), Eigen::Vector2d(1.0, 3.5));
  EXPECT_EQ(route.back(), Eigen::Vector2d(7.0, 3.5));
  for (std::size_t i = 1; i < route.size(); ++i)
    for (double share = 0.0; share <= 1.0; share += 0.05)
      for (const Panel& panel : world.panels)
        EXPECT_GT(geometry::distance(route[i - 1] + share * (route[i] - route[i - 1]), {panel.a, panel.b}), 0.29);
  EXPECT_TRUE(space.route({1.0, 3.5}, {9.0, 3.5}).empty());
}

}  // namespace
}  // namespace credo::sim
