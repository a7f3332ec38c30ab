// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/sonar_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

World wall_for_sonar(double x, const char* material = "plain") {
  World world = ideal_room();
  world.panels = {{{x, -20.0}, {x, 20.0}, 0.0, 3.0, material_index(world, material), true}};
  return world;
}

double echo(const World& world, const geometry::Pose2& pose) {
  const SonarSetup setup = sonar_preset("pioneer-16");
  return SonarSimulator(world, setup, 0, 1).first_echo(pose);
}

TEST(SonarSimulator, ASmoothWallAnswersOnlyWhenMetNearlyHeadOn) {
  const World world = wall_for_sonar(1.5);
  EXPECT_NEAR(echo(world, {0.0, 0.0, 0.0}), 1.5, 0.01);
  // The nearest point of the wall still lies in the beam: its distance is read, not that along the axis.
  EXPECT_NEAR(echo(world, {0.0, 0.0, 0.15}), 1.5, 0.02);
  for (const double incidence : {0.6, 0.9, 1.2})
    EXPECT_TRUE(std::isinf(echo(world, {0.0, 0.0, incidence}))) << incidence;
}

TEST(SonarSimulator, ARoughWallAnswersFromFurtherAside) {
  EXPECT_TRUE(std::isfinite(echo(wall_for_sonar(1.0, "brick"), {0.0, 0.0, 0.6})));
  EXPECT_TRUE(std::isinf(echo(wall_for_sonar(1.0), {0.0, 0.0, 0.6})));
  EXPECT_TRUE(std::isinf(echo(wall_for_sonar(1.0, "brick"), {0.0, 0.0, 1.2})));
}

TEST(SonarSimulator, ACornerAnswersWhateverItsWallsAngle) {
  for (const double turn : {-0.5, -0.2, 0.0, 0.3, 0.6}) {
    World world = ideal_room();
    const geometry::Pose2 T_map_corner{1.8, 0.0, std::numbers::pi * 0.75 + turn};
    const int plain = material_index(world, "plain");
    const Eigen::Vector2d at = T_map_corner.translation();
    world.panels = {{at, T_map_corner * Eigen::Vector2d(6.0, 0.0), 0.0, 3.0, plain, true},
                    {at, T_map_corner * Eigen::Vector2d(0.0, 6.0), 0.0, 3.0, plain, true}};
    EXPECT_LT(echo(world, {0.0, 0.0, 0.0}), 1.81) << turn;
  }
}

TEST(SonarSimulator, AnEdgeAnswersWhenNearOnly) {
  // The two walls run away from the transducer: only where they meet can answer.
  const auto edge_at = [](double x) {
    World world = ideal_room();
    const int plain = material_index(world, "plain");
    world.panels = {{{x, 0.0}, {x + 5.0, 5.0}, 0.0, 3.0, plain, true},
                    {{x, 0.0}, {x + 5.0, -5.0}, 0.0, 3.0, plain, true}};
    return world;
  };
  EXPECT_NEAR(echo(edge_at(0.8), {}), 0.8, 1e-9);
  EXPECT_TRUE(std::isinf(echo(edge_at(2.8), {})));
}

TEST(SonarSimulator, ADetourIsReadTooLong) {
  // A smooth wall at 45 degrees throws the pulse onto another one that it meets head-on.
  World world = ideal_room();
  const int plain = material_index(world, "plain");
  world.panels = {{{0.5, -0.5}, {1.5, 0.5}, 0.0, 3.0, plain, true}, {{0.0, 1.2}, {3.0, 1.2}, 0.0, 3.0, plain, true}};
  EXPECT_NEAR(echo(world, {0.0, 0.0, 0.0}), 1.0 + 1.2, 0.05);
}

TEST(SonarSimulator, RangesCarryNoiseCrossTalkAndLimits) {
  const World world = wall_for_sonar(1.5);
  SonarSetup setup = sonar_preset("pioneer-16");
  setup.cross_talk_share = 0.05;
  const SonarSimulator simulator(world, setup, 0, 1);
  double sum = 0.0, squares = 0.0;
  int phantoms = 0, echoes = 0;
  constexpr std::size_t kAhead = 3;  // 10 degrees to the left
  const double true_range = 1.5 - setup.ring.T_base_transducer[kAhead].x;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto sweep = simulator.sweep(
        0, [](double) { return geometry::Pose2{}; }, i);
    for (const float range : sweep.ranges_m)
      EXPECT_TRUE(std::isinf(range) || (range >= 0.2F && range <= 3.0F)) << range;
    const double range = sweep.ranges_m[kAhead];
    if (range < true_range - 0.2) {
      ++phantoms;
    } else {
      ++echoes;
      sum += range;
      squares += range * range;
    }
  }
  EXPECT_NEAR(phantoms, 3000 * 0.05 * (true_range - 0.4) / (true_range - 0.2), 40);
  EXPECT_NEAR(sum / echoes, true_range, 0.02);
  EXPECT_NEAR(std::sqrt(squares / echoes - sum / echoes * sum / echoes), 0.02, 0.01);
}

TEST(SonarSimulator, TransducersFireOneAfterAnother) {
  const World world = wall_for_sonar(2.0);
  SonarSetup setup = sonar_preset("pioneer-16");
  setup.cross_talk_share = 0.0;
  setup.ring.sigma_m = setup.relative_sigma = 0.0;
  const SonarSimulator simulator(world, setup, 0, 1);
  // Driving at the wall at an absurd speed makes the 10 ms between the two front transducers 10 cm.
  const auto sweep = simulator.sweep(
      0,
      [](double s) {
        return geometry::Pose2{10.0 * s, 0.0, 0.0};
      },
      0);
  EXPECT_NEAR(sweep.ranges_m[3] - sweep.ranges_m[4], 0.1, 0.01);
}

}  // namespace
}  // namespace credo::sim
