// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "sim/random.hpp"
#include "sim/rearrangement.hpp"
#include "sim/together.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

using sensors::Timestamp;

/// The demo world, with the first metre of its way.
World short_demo() {
  World world = load_world(shipped("demo"));
  world.path.resize(2);
  world.path[1].position.x() = 1.7;
  return world;
}

/// Everything that a simulation gave, as one number, and how much of each.
struct Recording {
  std::uint64_t digest = 0;
  std::map<std::string, int> count;
  std::vector<Timestamp> order;

  template <typename T>
  void take(const char* what, Timestamp time, const T* data, std::size_t n) {
    ++count[what];
    order.push_back(time);
    digest = mix_bits(digest ^ static_cast<std::uint64_t>(time));
    for (std::size_t i = 0; i < n; ++i) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, data + i, sizeof(T));
      digest = mix_bits(digest + bits);
    }
  }
};

Recording record(const World& world, std::uint64_t seed, int threads) {
  const Simulation simulation(world, seed);
  Recording recording;
  Sink sink;
  sink.image = [&](const sensors::OmniImage& i) { recording.take("image", i.time, i.pixels.data, i.pixels.total()); };
  sink.scan = [&](const sensors::RangeScan& s) {
    recording.take("scan", s.time, s.ranges_m.data(), s.ranges_m.size());
  };
  sink.sonar = [&](const sensors::SonarSweep& s) {
    recording.take("sonar", s.time, s.ranges_m.data(), s.ranges_m.size());
  };
  sink.odometry = [&](const sensors::OdometryReading& o) { recording.take("odometry", o.time, &o.T_odom_base.x, 3); };
  sink.truth = [&](Timestamp t, const geometry::Pose2& p) { recording.take("truth", t, &p.x, 3); };
  sink.verticals = [&](Timestamp t, std::span<const TrueVertical> v) {
    recording.take("verticals", t, reinterpret_cast<const double*>(v.data()), 3 * v.size());
  };
  sink.event = [&](Timestamp t, std::string_view e) {
    recording.take(("event " + std::string(e)).c_str(), t, e.data(), e.size());
  };
  simulation.run(sink, threads);
  return recording;
}

TEST(Simulation, GivesTheSameBytesForTheSameSeedOnAnyNumberOfThreads) {
  const World world = short_demo();
  const Recording one = record(world, 42, 1);
  EXPECT_EQ(one.digest, record(world, 42, 3).digest);
  EXPECT_NE(one.digest, record(world, 43, 1).digest);
}

TEST(Simulation, StreamsEverythingInTheOrderOfTime) {
  const Recording recording = record(short_demo(), 1, 2);
  EXPECT_TRUE(std::is_sorted(recording.order.begin(), recording.order.end()));
  EXPECT_EQ(recording.count.at("image"), 4);
  EXPECT_EQ(recording.count.at("scan"), 4);
  EXPECT_EQ(recording.count.at("verticals"), 4);
  EXPECT_GT(recording.count.at("sonar"), 30);
  EXPECT_GT(recording.count.at("odometry"), 30);
  EXPECT_GT(recording.count.at("truth"), recording.count.at("sonar"));
}

TEST(Simulation, PlaysTheSameTwice) {
  const Simulation simulation(short_demo(), 5);
  std::vector<float> ranges[2];
  for (auto& all : ranges) {
    Sink sink;
    sink.scan = [&](const sensors::RangeScan& scan) {
      for (const float range : scan.ranges_m) all.push_back(std::isnan(range) ? -1.0F : range);
    };
    simulation.run(sink);
  }
  EXPECT_EQ(ranges[0], ranges[1]);
}

TEST(Simulation, ASensorMoreChangesNoOther) {
  World world = short_demo();
  const auto scans = [](const World& w) {
    std::vector<float> ranges;
    Sink sink;
    sink.scan = [&](const sensors::RangeScan& scan) {
      if (scan.sensor == 0)
        for (const float range : scan.ranges_m) ranges.push_back(std::isnan(range) ? -1.0F : range);
    };
    Simulation(w, 6).run(sink);
    return ranges;
  };
  const auto before = scans(world);
  world.range_finders.push_back(world.range_finders.front());
  world.sonars.clear();
  EXPECT_EQ(before, scans(world));
}

TEST(Simulation, ProgressGoesFromNothingToAll) {
  double last = 0.0;
  Sink sink;
  sink.progress = [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  };
  Simulation(short_demo(), 1).run(sink);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(Simulation, BeingCarriedIsAnEventThatOdometryMisses) {
  World world = short_demo();
  world.camera.reset();
  world.path.push_back({{7.0, 3.4}, true});
  world.path.push_back({{7.0, 4.0}, false});
  std::vector<std::pair<Timestamp, std::string>> events;
  double farthest = 0.0;
  Sink sink;
  sink.event = [&](Timestamp t, std::string_view e) { events.emplace_back(t, e); };
  sink.odometry = [&](const sensors::OdometryReading& o) {
    farthest = std::max(farthest, std::hypot(o.T_odom_base.x, o.T_odom_base.y));
  };
  Simulation(world, 1).run(sink);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].second, "kidnapped");
  EXPECT_LT(farthest, 2.0);
}

TEST(Simulation, TheFloorPlanIsOffAsSaidAndLeavesOutTheClutter) {
  const World world = load_world(shipped("office"));
  const Simulation simulation(world, 3);
  const geometry::FloorPlan& plan = simulation.floor_plan();
  EXPECT_DOUBLE_EQ(plan.uncertainty_m, 0.01);
  std::vector<Panel> mapped;
  for (const Panel& panel : world.panels)
    if (panel.in_plan && panel.z0_m <= 0.8 && panel.z1_m >= 0.8) mapped.push_back(panel);
  ASSERT_EQ(plan.walls.size(), mapped.size());
  EXPECT_LT(mapped.size(), world.panels.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    squares += (plan.walls[i].a - mapped[i].a).squaredNorm() + (plan.walls[i].b - mapped[i].b).squaredNorm();
    // What met before still meets.
    for (std::size_t j = 0; j < mapped.size(); ++j) {
      if ((mapped[i].b - mapped[j].a).norm() > 1e-9) continue;
      EXPECT_EQ(plan.walls[i].b, plan.walls[j].a);
    }
  }
  EXPECT_NEAR(std::sqrt(squares / (4.0 * static_cast<double>(mapped.size()))), 0.01, 0.002);
  EXPECT_EQ(plan.verticals.size(), world.marks.size());
}

TEST(Simulation, TheStartIsToldWithItsError) {
  const World world = short_demo();
  double squares = 0.0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    World blind = world;
    blind.camera.reset();
    const Simulation simulation(blind, seed);
    ASSERT_TRUE(simulation.initial_pose().has_value());
    squares += std::pow(simulation.initial_pose()->pose.x - 0.7, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kSeeds), 0.05, 0.015);
  World lost = world;
  lost.initial_pose_known = false;
  EXPECT_FALSE(Simulation(lost, 1).initial_pose().has_value());
}

TEST(Simulation, TheTruthMapHasWallsRoomsAndTheOutside) {
  const Simulation simulation(short_demo(), 1);
  const TruthMap map = simulation.truth_map(0.05);
  const auto at = [&](double x, double y) {
    return map.at(static_cast<int>((x - map.origin.x()) / map.resolution_m),
                  static_cast<int>((y - map.origin.y()) / map.resolution_m));
  };
  EXPECT_EQ(at(3.0, 1.0), TruthMap::Cell::kFree);
  EXPECT_EQ(at(6.0, 4.0), TruthMap::Cell::kFree);       // through two doors
  EXPECT_EQ(at(4.0, 0.01), TruthMap::Cell::kOccupied);  // the corridor's wall
  EXPECT_EQ(at(3.0, -0.3), TruthMap::Cell::kUnknown);
  EXPECT_EQ(at(3.6, 2.06), TruthMap::Cell::kUnknown);  // inside of a wall
  EXPECT_THROW((void)simulation.truth_map(0.0), std::invalid_argument);
}

/// A robot that stands 3 m before a closed door with a leaf, behind which is a small room; at 20 s the door opens. A
/// box behind the robot is there from 10 to 30 s.
World before_a_door() {
  World world = ideal_room();
  world.panels.clear();
  Builder builder(world);
  builder.add_walls({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, true, "plain", true);
  builder.add_walls({{4.2, -1}, {6, -1}, {6, 1}, {4.2, 1}}, true, "plain", true);
  builder.add_door({.at = {4.0, 0.0}, .kind = Door::Kind::kOpening, .width_m = 1.6, .leaf_rad = 0.0});
  turn_leaf(world, 20.0, {4.0, 0.0}, 1.6);
  const std::size_t first = world.panels.size();
  builder.add_box({-2.0, 0.0}, {0.5, 2.0}, 0.0, 0.0, 2.6, "concrete", false);
  appear(world, 10.0, first);
  std::swap(world.changes[0], world.changes[1]);
  take_away(world, 30.0, {-2.0, 0.0});
  world.path = {{{0.9, 0.0}}, {{1.0, 0.0}}};
  world.drive = {.pause_s = 20.0};
  world.drive.duration_s = 40.0;
  return world;
}

TEST(Simulation, ChangesAreSeenByEverySensorFromTheirTimeOn) {
  World world = before_a_door();
  world.camera->rate_hz = 0.5;
  RangeFinderSetup finder = range_finder_preset("opensimple");
  finder.finder.range_max_m = 8.0;
  finder.faintest = 0.0;
  finder.rate_hz = 5.0;
  world.range_finders = {finder};
  world.sonars = {sonar_preset("pioneer-16")};
  world.sonars[0].cross_talk_share = 0.0;
  const Simulation simulation(world, 3);
  const auto seconds_of = [start = simulation.truth_states().front().since](Timestamp time) {
    return sensors::seconds_between(start, time);
  };
  std::map<double, float> ahead, behind;
  std::map<double, std::size_t> edges;
  std::vector<std::string> events;
  Sink sink;
  sink.scan = [&](const sensors::RangeScan& scan) {
    if (std::isfinite(scan.ranges_m[90])) ahead[seconds_of(scan.time)] = scan.ranges_m[90];
  };
  sink.sonar = [&](const sensors::SonarSweep& sweep) { behind[seconds_of(sweep.time)] = sweep.ranges_m[11]; };
  sink.verticals = [&](Timestamp time, std::span<const TrueVertical> v) { edges[seconds_of(time)] = v.size(); };
  sink.event = [&](Timestamp, std::string_view event) { events.emplace_back(event); };
  simulation.run(sink);
  EXPECT_EQ(events, (std::vector<std::string>{"obstacle_added", "door_opened", "obstacle_removed"}));
  int outliers = 0;
  for (const auto& [when, range] : ahead) outliers += std::abs(range - (when < 20.0 ? 3.1F : 5.1F)) > 0.5F;
  EXPECT_LT(outliers, 8) << "of " << ahead.size();
  for (const auto& [when, range] : behind)
    EXPECT_EQ(range < 2.9F, when >= 10.0 && when < 30.0) << "at " << when << " s: " << range;
  EXPECT_LT(edges.begin()->second, edges.lower_bound(12.0)->second);
  EXPECT_GT(edges.lower_bound(21.0)->second, edges.rbegin()->second);
}

TEST(Simulation, TheTruthIsToldForEveryStateOfTheWorld) {
  World world = before_a_door();
  world.camera.reset();
  world.range_finders = {range_finder_preset("opensimple")};
  const Simulation simulation(world, 3);
  const std::vector<TruthState> states = simulation.truth_states(0.1);
  ASSERT_EQ(states.size(), 4U);
  const auto at = [&](const TruthMap& map, double x, double y) {
    return map.at(static_cast<int>((x - map.origin.x()) / map.resolution_m),
                  static_cast<int>((y - map.origin.y()) / map.resolution_m));
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_DOUBLE_EQ(sensors::seconds_between(states[0].since, states[i].since), 10.0 * static_cast<double>(i));
    const bool box = i == 1 || i == 2, open = i >= 2;
    EXPECT_EQ(at(states[i].map, -1.76, 0.05) == TruthMap::Cell::kOccupied, box) << i;
    EXPECT_EQ(at(states[i].map, -2.0, 0.05) == TruthMap::Cell::kUnknown, box) << i;  // inside of what is solid
    EXPECT_EQ(at(states[i].map, 5.0, 0.05) == TruthMap::Cell::kFree, open) << i;
  }
  EXPECT_EQ(simulation.truth_map(0.1).cells, states.back().map.cells);
}

TEST(Simulation, ChangesComeWithTheSameBytesOnAnyNumberOfThreads) {
  World world = before_a_door();
  world.camera->rate_hz = 0.2;
  world.people = 1;
  EXPECT_EQ(record(world, 4, 1).digest, record(world, 4, 3).digest);
}

TEST(Simulation, NeedsASensorAndAWay) {
  World world = short_demo();
  world.path.resize(1);
  EXPECT_THROW(Simulation(world, 1), std::invalid_argument);
  world = short_demo();
  world.camera.reset();
  world.range_finders.clear();
  world.sonars.clear();
  EXPECT_THROW(Simulation(world, 1), std::invalid_argument);
}

TEST(Simulation, DrivesThroughNoWall) {
  World world = short_demo();
  world.path[1].position = {0.7, 3.5};
  EXPECT_THROW(Simulation(world, 1), std::invalid_argument);
  world = short_demo();
  world.robot_radius_m = 1.5;
  EXPECT_THROW(Simulation(world, 1), std::invalid_argument);
}

TEST(Together, EveryIndexIsTakenOnceAndAnExceptionComesOut) {
  std::vector<std::atomic<int>> taken(100);
  run_together(3, taken.size(), [&](NextIndex& next) {
    while (const auto i = next()) ++taken[*i];
  });
  for (const auto& times : taken) EXPECT_EQ(times, 1);
  for (const int threads : {1, 3}) {
    EXPECT_THROW(run_together(threads, 100,
                              [](NextIndex& next) {
                                while (next()) throw std::runtime_error("no memory for an image");
                              }),
                 std::runtime_error);
  }
}

TEST(Random, StreamsAreIndependentAndNormalIsNormal) {
  Random a(1, 2, 3), b(1, 2, 4), c(1, 2, 3);
  EXPECT_EQ(a.bits(), c.bits());
  EXPECT_NE(a.bits(), b.bits());
  double sum = 0.0, squares = 0.0, beyond = 0.0, product = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double x = a.normal();
    sum += x;
    squares += x * x;
    beyond += std::abs(x) > 1.96;
    product += x * b.normal();
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.015);
  EXPECT_NEAR(squares / kCount, 1.0, 0.02);
  EXPECT_NEAR(beyond / kCount, 0.05, 0.003);
  EXPECT_NEAR(product / kCount, 0.0, 0.015);
}

}  // namespace
}  // namespace credo::sim
