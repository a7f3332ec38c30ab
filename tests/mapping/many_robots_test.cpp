// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>
#include <random>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

constexpr std::size_t kRobots = 20;

/// What one of many robots in a room of 6 m x 3 m records: scans, sweeps, and some of both from where it rests.
struct Robot {
  sensors::Rig rig;
  sensors::MotionPath path;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
  TrajectoryMappingParams params;
};

Robot robot(std::size_t number) {
  Robot robot;
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.05;
  robot.rig = rig_with(finder);
  robot.rig.sonar_rings = {one_sonar()};
  robot.params.covariance.diagonal().setConstant(number % 4 == 0 ? 0.04 * 0.04
                                                                 : 0.0);  // some are unsure of their poses
  std::vector<sensors::OdometryReading> rows;
  for (int k = 0; k < 24; ++k) {
    const double way = 0.15 * std::min(k, 16);
    const Pose2 pose{1.0 + way, 0.8 + 0.07 * static_cast<double>(number), 0.2 * static_cast<double>(number)};
    const sensors::Timestamp time = sensors::from_seconds(0.1 * k);
    rows.push_back({time, pose});
    robot.scans.push_back(scan_of_room(finder, pose, 6.0, 3.0));
    robot.scans.back().time = time;
    robot.sweeps.push_back(
        {time, 0, {static_cast<float>(std::min(2.9, distance_to_room(pose.translation(), pose.theta, 6.0, 3.0)))}});
  }
  robot.path = sensors::MotionPath(rows);
  return robot;
}

grids::EvidentialGrid map_of(const Robot& robot) {
  return map_along(robot.path, robot.rig, robot.scans, robot.sweeps, robot.params).grid;
}

/// Merges maps two at a time, which two being left to chance, until one is left.
grids::EvidentialGrid merged_by_chance(std::vector<grids::EvidentialGrid> maps, std::mt19937& generator) {
  while (maps.size() > 1) {
    std::shuffle(maps.begin(), maps.end(), generator);
    const grids::EvidentialGrid last = std::move(maps.back());
    maps.pop_back();
    maps.front().merge(last);
  }
  return std::move(maps.front());
}

TEST(ManyRobots, MakeOneMapToTheBitInAnyOrderGroupingAndNumberOfThreads) {
  std::vector<Robot> robots;
  for (std::size_t number = 0; number < kRobots; ++number) robots.push_back(robot(number));
  grids::EvidentialGrid expected;
  for (const Robot& one : robots) expected.merge(map_of(one));
  std::mt19937 generator(20);
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<grids::EvidentialGrid> maps;
    for (Robot& one : robots) {
      std::shuffle(one.scans.begin(), one.scans.end(), generator);
      std::shuffle(one.sweeps.begin(), one.sweeps.end(), generator);
      maps.push_back(map_of(one));
    }
    EXPECT_EQ(merged_by_chance(std::move(maps), generator), expected) << threads << " threads";
  }
}

/// The readings of all robots of one kind, dealt out to mappers one by one, each with its share of its robot's drive.
TEST(ManyRobots, MakeOneMapToTheBitHoweverTheirReadingsAreDealtOut) {
  std::vector<Robot> robots;
  std::vector<std::pair<std::size_t, std::size_t>> readings;  // of which robot, and which
  std::vector<std::vector<double>> scan_shares, sweep_shares;
  grids::EvidentialGrid expected;
  for (std::size_t number = 0; number < kRobots; ++number) {
    robots.push_back(robot(number));
    const Robot& last = robots.back();
    expected.merge(map_of(last));
    scan_shares.push_back(new_shares(last.path, last.scans, last.params));
    sweep_shares.push_back(new_shares(last.path, last.sweeps, last.params));
    for (std::size_t k = 0; k < robots.back().scans.size(); ++k) readings.emplace_back(number, k);
  }
  std::mt19937 generator(21);
  std::shuffle(readings.begin(), readings.end(), generator);
  std::vector<Mapper> mappers;
  for (int k = 0; k < 7; ++k) mappers.emplace_back(robots.front().rig);
  for (const auto& [number, k] : readings) {
    const Robot& one = robots[number];
    const auto pose_of = [&](sensors::Timestamp time) {
      return Believed<PoseEstimate>{{one.path.pose_at(time), one.params.covariance}, one.params.belief};
    };
    mappers[generator() % mappers.size()].insert(pose_of(one.scans[k].time), one.scans[k], one.path,
                                                 scan_shares[number][k]);
    mappers[generator() % mappers.size()].insert(pose_of(one.sweeps[k].time), one.sweeps[k], one.path,
                                                 sweep_shares[number][k]);
  }
  std::vector<grids::EvidentialGrid> maps;
  for (Mapper& mapper : mappers) maps.push_back(mapper.take_grid());
  EXPECT_EQ(merged_by_chance(std::move(maps), generator), expected);
}

/// A drive dealt out to map_along, in parts that interleave.
TEST(ManyRobots, OrPartsOfOneDriveMakeItsMapToTheBit) {
  const Robot whole = robot(3);
  const std::vector<double> of_scans = new_shares(whole.path, whole.scans, whole.params),
                            of_sweeps = new_shares(whole.path, whole.sweeps, whole.params);
  grids::EvidentialGrid merged;
  for (std::size_t part = 0; part < 3; ++part) {
    std::vector<sensors::RangeScan> scans;
    std::vector<sensors::SonarSweep> sweeps;
    NewShares shares;
    for (std::size_t k = part; k < whole.scans.size(); k += 3) {
      scans.push_back(whole.scans[k]);
      sweeps.push_back(whole.sweeps[k]);
      shares.of_scans.push_back(of_scans[k]);
      shares.of_sweeps.push_back(of_sweeps[k]);
    }
    merged.merge(map_along(whole.path, whole.rig, scans, sweeps, shares, whole.params).grid);
  }
  EXPECT_EQ(merged, map_of(whole));
  EXPECT_THROW(static_cast<void>(map_along(whole.path, whole.rig, whole.scans, whole.sweeps, NewShares{})),
               std::invalid_argument);
}

}  // namespace
}  // namespace credo::mapping
