// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/crowd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/segment.hpp"
#include "sim/random_world.hpp"
#include "sim/simulation.hpp"
#include "sim/sonar_simulator.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

constexpr double kWaist_m = 0.8;

TEST(Crowd, KeepsOffWallsAndTheRobot) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    World world = random_world(seed);
    SCOPED_TRACE(world.name);
    world.people = 4;
    const Trajectory way(world.path, world.drive);
    const Crowd crowd(world, way, seed);
    int near = 0, seen = 0;
    for (double t = 0.0; t < way.duration_s(); t += 0.25)
      for (const Disc& person : crowd.cut(kWaist_m, t)) {
        for (const Panel& panel : world.panels) {
          if (panel.z0_m > 1.8) continue;
          EXPECT_GE(geometry::distance(person.centre, {panel.a, panel.b}), person.radius_m);
        }
        const double distance = (person.centre - way.pose_at(t).translation()).norm();
        EXPECT_GT(distance, world.robot_radius_m + person.radius_m);
        near += distance < world.robot_radius_m + person.radius_m + 0.45;
        ++seen;
      }
    EXPECT_LT(near, 0.05 * seen);
  }
}

TEST(Crowd, WalksAtAWalkingPace) {
  World world = load_world(shipped("demo"));
  world.people = 3;
  const Trajectory way(world.path, world.drive);
  const Crowd crowd(world, way, 1);
  std::vector<double> gone(3, 0.0);
  for (double t = 0.0; t + 0.1 < way.duration_s(); t += 0.1) {
    const auto now = crowd.cut(kWaist_m, t), next = crowd.cut(kWaist_m, t + 0.1);
    for (std::size_t i = 0; i < 3; ++i) {
      const double step = (next[i].centre - now[i].centre).norm();
      EXPECT_LT(step, 0.2);
      gone[i] += step;
    }
  }
  EXPECT_GT(*std::max_element(gone.begin(), gone.end()), 3.0);
}

TEST(Crowd, IsTheSameForTheSameSeed) {
  World world = load_world(shipped("demo"));
  world.people = 2;
  const Trajectory way(world.path, world.drive);
  const auto places = [&](std::uint64_t seed) {
    const Crowd crowd(world, way, seed);
    std::vector<double> all;
    for (double t = 0.0; t < 20.0; t += 1.0)
      for (const Disc& person : crowd.cut(kWaist_m, t)) all.insert(all.end(), {person.centre.x(), person.centre.y()});
    return all;
  };
  EXPECT_EQ(places(4), places(4));
  EXPECT_NE(places(4), places(5));
}

TEST(Crowd, ARayMeetsTheNearSideOfTheNearestPerson) {
  const std::vector<Disc> discs{{{3.0, 0.0}, 0.2, 1}, {{2.0, 0.1}, 0.2, 2}, {{-1.0, 0.0}, 0.2, 3}};
  const auto hit = first_hit(discs, {0.0, 0.0}, {1.0, 0.0}, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->material, 2);
  EXPECT_NEAR(hit->range_m, 2.0 - std::sqrt(0.03), 1e-12);
  EXPECT_NEAR(hit->cos_incidence, std::sqrt(0.03) / 0.2, 1e-12);
  EXPECT_FALSE(first_hit(discs, {0.0, 0.0}, {1.0, 0.0}, 1.5));
  EXPECT_FALSE(first_hit(discs, {0.0, 0.0}, {0.0, 1.0}, 10.0));
}

/// What changes in a reading of the same noise can only be people.
TEST(Crowd, IsSeenByCameraAndRangeFinderAndNotInThePlan) {
  World world = ideal_room();
  world.range_finders = {range_finder_preset("rplidar-a1")};
  const auto record = [&](int people) {
    world.people = people;
    std::pair<std::vector<float>, cv::Mat> readings;
    Sink sink;
    sink.scan = [&](const sensors::RangeScan& scan) { readings.first = scan.ranges_m; };
    sink.image = [&](const sensors::OmniImage& image) { readings.second = image.pixels; };
    const Simulation simulation(world, 2);
    EXPECT_EQ(simulation.floor_plan().walls.size(), 4U);
    simulation.run(sink);
    return readings;
  };
  const auto without = record(0), with = record(6);
  int nearer = 0;
  for (std::size_t i = 0; i < without.first.size(); ++i) nearer += with.first[i] < without.first[i] - 0.2F;
  EXPECT_GT(nearer, 5);
  EXPECT_LT(nearer, 180);
  int changed = 0;
  for (std::size_t i = 0; i < with.second.total(); ++i)
    changed += std::abs(int{with.second.data[i]} - int{without.second.data[i]}) > 20;
  EXPECT_GT(changed, 500);
}

TEST(Crowd, AnswersTheSonar) {
  World world = ideal_room();
  const SonarSetup setup = sonar_preset("pioneer-16");
  const SonarSimulator sonar(world, setup, 0, 1);
  const std::vector<Disc> person{{{1.5, 0.0}, 0.2, 0}};
  EXPECT_NEAR(sonar.first_echo({0.0, 0.0, 0.0}, person), 1.3, 1e-9);
  EXPECT_GT(sonar.first_echo({0.0, 0.0, 1.0}, person), 2.0);
}

}  // namespace
}  // namespace credo::sim
