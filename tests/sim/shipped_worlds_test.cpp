// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/segment.hpp"
#include "sim/trajectory.hpp"
#include "sim/world.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped_worlds() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(std::string(CREDO_SOURCE_DIR) + "/sim/worlds"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  return files;
}

TEST(ShippedWorlds, AllLoadAndTheRobotFitsThrough) {
  const auto files = shipped_worlds();
  ASSERT_GE(files.size(), 5U);
  for (const std::string& file : files) {
    const World world = load_world(file);
    EXPECT_EQ(world.name, fs::path(file).stem().string());
    EXPECT_FALSE(world.description.empty()) << file;
    const Trajectory way(world.path, world.drive);
    for (double t = 0.0; t < way.duration_s(); t += 0.2) {
      const Eigen::Vector2d at = way.pose_at(t).translation();
      for (const Panel& panel : world.panels) {
        if (panel.z0_m > 1.2) continue;
        ASSERT_GT(geometry::distance(at, {panel.a, panel.b}), world.robot_radius_m)
            << file << ": the robot hits something at " << at.transpose();
      }
    }
  }
}

TEST(ShippedWorlds, TheCorridorEndHas42AcquisitionsOnTwoWays) {
  const World one = load_world(shipped("corridor_end"));
  EXPECT_EQ(Trajectory(one.path, one.drive).stops().size(), 21U);
  for (const char* second : {"corridor_end_2", "corridor_end_curve"}) {
    const World two = load_world(shipped(second));
    EXPECT_EQ(Trajectory(two.path, two.drive).stops().size(), 21U) << second;
    EXPECT_EQ(one.panels.size(), two.panels.size()) << second;
  }
}

TEST(ShippedWorlds, ThePapersRoomsAreMeasuredAsPrinted) {
  struct Case {
    const char* name;
    double width_m, height_m;
    geometry::Pose2 start;
    std::size_t transducers;
  };
  const Case cases[] = {{"li2006", 20.0, 20.0, {1.0, 1.0, 0.0}, 16},
                        {"li2007", 4.55, 3.75, {1.0, 0.6, 0.0}, 16},
                        {"lip_1", 13.0, 8.0, {0.0, 0.0, 0.0}, 16},
                        {"lip_2", 13.0, 8.0, {6.0, 0.0, 0.0}, 16},
                        {"zhu", 9.0, 7.0, {0.6, 0.6, 0.0}, 5}};
  for (const Case& c : cases) {
    const World world = load_world(shipped(c.name));
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : world.areas.front()) box.extend(corner);
    EXPECT_NEAR(box.sizes().x(), c.width_m, 1e-9) << c.name;
    EXPECT_NEAR(box.sizes().y(), c.height_m, 1e-9) << c.name;
    EXPECT_EQ(Trajectory(world.path, world.drive).pose_at(0.0), c.start) << c.name;
    EXPECT_EQ(world.sonars.at(0).ring.T_base_transducer.size(), c.transducers) << c.name;
  }
}

TEST(ShippedWorlds, ThePapersPeriodsAreDriven) {
  for (const auto& [name, duration_s] :
       {std::pair{"li2007", 23.6}, {"li2007_slow", 36.6}, {"lip_1", 70.0}, {"lip_2", 70.0}}) {
    const World world = load_world(shipped(name));
    const Trajectory way(world.path, world.drive);
    EXPECT_EQ(way.duration_s(), duration_s) << name;
    Drive open_end = world.drive;
    open_end.duration_s.reset();
    // All of the way is driven, and the robot does not wait for long.
    EXPECT_NEAR(Trajectory(world.path, open_end).duration_s(), duration_s, 0.1 * duration_s) << name;
    EXPECT_LE(Trajectory(world.path, open_end).duration_s(), duration_s) << name;
  }
  EXPECT_LE(load_world(shipped("zhu")).drive.speed_mps, 0.05);
}

TEST(ShippedWorlds, WhatChangesIsPassedAgain) {
  const World world = load_world(shipped("changing"));
  const Trajectory way(world.path, world.drive);
  std::set<std::string> events;
  for (const Change& change : world.changes) {
    events.insert(change.event);
    // Two legs of 8 m, that is more than 200 scans.
    EXPECT_GT(way.duration_s() - change.when_s, 40.0) << change.event;
  }
  EXPECT_EQ(events.size(), 5U);
  EXPECT_GT(world.people, 0);
}

TEST(ShippedWorlds, TheCurveOfTheCorridorEndIsGentle) {
  const World world = load_world(shipped("corridor_end_curve"));
  const Trajectory way(world.path, world.drive);
  double before = 0.0, most = 0.0;
  for (std::size_t i = 1; i < way.stops().size(); ++i) {
    const double turn =
        geometry::angle_difference(way.pose_at(way.stops()[i]).theta, way.pose_at(way.stops()[i - 1]).theta);
    EXPECT_NEAR((way.pose_at(way.stops()[i]).translation() - way.pose_at(way.stops()[i - 1]).translation()).norm(), 0.3,
                0.005)
        << "at " << i;
    EXPECT_LT(std::abs(turn - before), geometry::to_radians(3.5)) << "at " << i;
    most = std::max(most, std::abs(turn));
    before = turn;
  }
  EXPECT_GT(most, geometry::to_radians(5.0));
}

}  // namespace
}  // namespace credo::sim
