// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

TEST(MapAlong, IsTheSameAsInsertingOneByOne) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.1;
  sensors::Rig rig = rig_with(finder);
  rig.sonar_rings = {one_sonar()};
  std::vector<sensors::OdometryReading> rows;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
  for (int k = 0; k < 40; ++k) {
    const sensors::Timestamp time = sensors::Timestamp{100'000'000} * k;
    const Pose2 pose{1.0 + 0.05 * k, 1.2, 0.1 * k};
    if (k < 30) rows.push_back({time, pose});  // the last scan has no pose near
    scans.push_back(scan_of_room(finder, pose, 6.0, 3.0));
    scans.back().time = time;
    sweeps.push_back({time, 0, {1.0F}});
  }
  const sensors::MotionPath trajectory(rows);
  const TrajectoryMap map = map_along(trajectory, rig, scans, sweeps);
  Mapper one_by_one(rig);
  for (std::size_t k = 0; k < 35; ++k) {
    const auto pose = certain(trajectory.pose_at(scans[k].time));
    one_by_one.insert(pose, scans[k], trajectory);
    one_by_one.insert(pose, sweeps[k], trajectory);
  }
  EXPECT_EQ(map.without_pose, 10);
  EXPECT_EQ(map.counts.scans, 35);
  EXPECT_EQ(map.grid, one_by_one.grid());
  EXPECT_EQ(map.counts, one_by_one.counts());
  EXPECT_THROW(static_cast<void>(map_along(sensors::MotionPath{}, rig, scans, sweeps)), std::invalid_argument);
}

TEST(MapAlong, TellsItsProgressAndCanBeStopped) {
  const sensors::Rig rig = rig_with(one_sonar());
  const sensors::MotionPath still(std::vector<sensors::OdometryReading>{{0, {}}});
  const std::vector<sensors::SonarSweep> sweeps(200, {0, 0, {1.0F}});
  std::vector<double> shares;
  static_cast<void>(map_along(still, rig, {}, sweeps, {}, [&](double share) { shares.push_back(share); }));
  EXPECT_GT(shares.size(), 2u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  struct Stop {};
  EXPECT_THROW(static_cast<void>(map_along(still, rig, {}, sweeps, {}, [](double) { throw Stop(); })), Stop);
}

}  // namespace
}  // namespace credo::mapping
