// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/range_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

/// One white wall across the x axis.
World wall_at(double x, const char* material = "board") {
  World world = ideal_room();
  world.panels = {{{x, -20.0}, {x, 20.0}, 0.0, 3.0, material_index(world, material), true}};
  return world;
}

RangeFinderSetup clean(const char* preset) {
  RangeFinderSetup setup = range_finder_preset(preset);
  setup.outlier_share = 0.0;
  setup.bias_per_m = 0.0;
  return setup;
}

struct Statistics {
  double mean = 0.0, sigma = 0.0;
  int finite = 0, inf = 0, nan = 0;
};
Statistics read_many(const World& world, const RangeFinderSetup& setup, double angle = 0.0, int count = 4000) {
  const RangeSimulator simulator(world, setup, 0, 1);
  Random random(9);
  Statistics s;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const float range = simulator.reading({0.0, 0.0}, angle, random);
    s.nan += std::isnan(range);
    s.inf += std::isinf(range);
    if (!std::isfinite(range)) continue;
    ++s.finite;
    s.mean += range;
    squares += static_cast<double>(range) * range;
  }
  s.mean /= s.finite;
  s.sigma = std::sqrt(squares / s.finite - s.mean * s.mean);
  return s;
}

TEST(RangeSimulator, TriangulationErrsWithTheSquareOfTheRange) {
  for (const char* preset : {"opensimple", "lds-neato", "lab-1999"}) {
    const RangeFinderSetup setup = clean(preset);
    for (const double range : {0.8, 1.6, 2.4, 3.2}) {
      const Statistics s = read_many(wall_at(range), setup);
      const double expected = setup.finder.noise.sigma(range);
      // Reading the disparity in steps, and dim light, add up to 20 %.
      EXPECT_GT(s.sigma, 0.95 * expected) << preset << " " << range;
      EXPECT_LT(s.sigma, 1.25 * expected) << preset << " " << range;
      EXPECT_NEAR(s.mean, range, 0.1 * expected + 0.003 * range) << preset;
    }
  }
}

TEST(RangeSimulator, TimeOfFlightErrsAlikeEverywhere) {
  const RangeFinderSetup setup = clean("tof-lms");
  for (const double range : {1.0, 4.0, 8.0}) {
    const Statistics s = read_many(wall_at(range), setup);
    EXPECT_GT(s.sigma, 0.009) << range;
    EXPECT_LT(s.sigma, 0.0165) << range;
  }
}

TEST(RangeSimulator, CalibrationErrorGrowsWithTheSquareOfTheRange) {
  RangeFinderSetup setup = clean("opensimple");
  setup.bias_per_m = 0.02;
  const double near = read_many(wall_at(1.0), setup).mean - 1.0, far = read_many(wall_at(2.0), setup).mean - 2.0;
  EXPECT_GT(std::abs(far), 0.005);
  EXPECT_NEAR(far / near, 4.0, 1.0);
}

TEST(RangeSimulator, NothingComesBackFromBeyondTheRange) {
  const Statistics s = read_many(wall_at(4.6), clean("opensimple"), 0.0, 500);
  EXPECT_GT(s.inf, 480);
}

TEST(RangeSimulator, TooNearIsNoMeasurement) {
  const Statistics s = read_many(wall_at(0.1), clean("opensimple"), 0.0, 500);
  EXPECT_EQ(s.nan, 500);
}

TEST(RangeSimulator, DarkSlantingAndGlassSurfacesAreLost) {
  const RangeFinderSetup setup = clean("opensimple");
  EXPECT_LT(read_many(wall_at(2.0), setup, 0.0, 1000).inf, 10);
  EXPECT_GT(read_many(wall_at(3.5, "dark"), setup, 0.0, 1000).inf, 600);
  EXPECT_NEAR(read_many(wall_at(1.0, "glass"), setup, 0.0, 1000).inf, 700, 60);
  EXPECT_GT(read_many(wall_at(0.5), setup, 1.42, 1000).inf, 500);  // 3.3 m away, 8 degrees off the wall
}

TEST(RangeSimulator, AnEdgeGivesMixedReadings) {
  World world = wall_at(3.0);
  world.panels.push_back({{2.0, 0.0}, {2.0, 5.0}, 0.0, 3.0, material_index(world, "board"), true});
  const RangeFinderSetup setup = clean("lds-neato");
  const RangeSimulator simulator(world, setup, 0, 1);
  Random random(4);
  int between = 0;
  for (int i = 0; i < 200; ++i) {
    const float range = simulator.reading({0.0, 0.0}, 0.0, random);
    between += range > 2.1F && range < 2.9F;
  }
  // The disparities of 2 m and 3 m lie 42 px apart: two images, and the brighter one counts.
  EXPECT_LT(between, 20);
  RangeFinderSetup coarse = setup;
  coarse.finder.noise.k_per_m = 0.02;
  const RangeSimulator blurred(world, coarse, 0, 1);
  double sum = 0.0;
  int finite = 0;
  for (int i = 0; i < 500; ++i)
    if (const float range = blurred.reading({0.0, 0.0}, 0.0, random); std::isfinite(range)) {
      sum += range;
      ++finite;
    }
  EXPECT_GT(sum / finite, 2.1);
  EXPECT_LT(sum / finite, 2.6);
}

TEST(RangeSimulator, BeamsOfATurningRobotAreTakenOneAfterAnother) {
  const World world = ideal_room();
  RangeFinderSetup setup = clean("lds-neato");
  setup.finder.noise = {1e-6, 1e-6};
  setup.finder.scan_time_s = 1.0;
  const RangeSimulator simulator(world, setup, 0, 1);
  constexpr double kTurn = 0.6;  // rad/s
  const auto turning = simulator.scan(
      0,
      [](double s) {
        return geometry::Pose2{0.0, 0.0, kTurn * s};
      },
      0);
  int compared = 0;
  for (int beam = 0; beam < setup.finder.count; ++beam) {
    const float range = turning.ranges_m[static_cast<std::size_t>(beam)];
    if (!std::isfinite(range)) continue;
    const double angle = setup.finder.beam_angle(beam) + kTurn * setup.finder.beam_time(beam);
    const double expected = 4.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    EXPECT_NEAR(range, expected, 0.02) << beam;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

TEST(RangeSimulator, SeesOnlyWhatSpansItsHeight) {
  World world = wall_at(3.0);
  world.panels.push_back({{1.0, -1.0}, {1.0, 1.0}, 0.0, 0.5, material_index(world, "board"), false});
  RangeFinderSetup setup = clean("opensimple");
  EXPECT_NEAR(read_many(world, setup, 0.0, 300).mean, 3.0, 0.05);
  setup.finder.height_m = 0.3;
  EXPECT_NEAR(read_many(world, setup, 0.0, 300).mean, 1.0, 0.05);
}

}  // namespace
}  // namespace credo::sim
