// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

TEST(MapperPose, AnUnsurePoseMapsLessAndALostOneNothing) {
  const sensors::RangeFinder finder = panoramic();
  const Pose2 pose{1.0, 1.2, 0.3};
  const sensors::RangeScan scan = scan_of_room(finder, pose, 6.0, 3.0);
  const auto map = [&](const Believed<PoseEstimate>& from) {
    Mapper mapper(rig_with(finder));
    mapper.insert(from, scan);
    return mapper.take_grid();
  };
  const grids::CellIndex free{24, 24}, far_wall{120, 24};
  const grids::EvidentialGrid sure = map(certain(pose)), unsure = map(with_sigma(pose, 0.02, 0.0)),
                              turned = map(with_sigma(pose, 0.0, 0.004));
  EXPECT_LT(weight(unsure.at(free)), 0.9 * weight(sure.at(free)));
  EXPECT_LT(weight(turned.at(far_wall)), 0.9 * weight(sure.at(far_wall)));  // 5 m x 0.004 rad: less than half a cell
  Believed<PoseEstimate> doubted = certain(pose), ignorant = certain(pose), lost = certain(pose);
  doubted.belief = {.yes = 0.5, .no = 0.2, .unknown = 0.3};
  ignorant.belief = {};
  lost.belief = {.yes = 0.2, .no = 0.5, .unknown = 0.3};
  EXPECT_LT(weight(map(doubted).at(free)), weight(sure.at(free)));
  EXPECT_GT(weight(map(doubted).at(free)), weight(map(ignorant).at(free)));
  EXPECT_GT(weight(map(ignorant).at(free)), 0.0);
  EXPECT_TRUE(map(lost).tiles().empty());
}

TEST(MapperPose, ALostPoseIsCountedForSonarToo) {
  Mapper mapper(rig_with(one_sonar()));
  sensors::SonarSweep sweep;
  sweep.ranges_m = {1.0F};
  Believed<PoseEstimate> lost = certain({});
  lost.belief = {.yes = 0.0, .no = 1.0, .unknown = 0.0};
  mapper.insert(lost, sweep);
  EXPECT_TRUE(mapper.grid().tiles().empty());
  EXPECT_EQ(mapper.counts().refused, 1);
  EXPECT_EQ(mapper.counts().sweeps, 1);
}

TEST(MapperPose, AFarPoseTakesNoMoreMemoryThanANearOne) {
  const sensors::RangeFinder finder = panoramic();
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 4.0F);
  Mapper near(rig_with(finder)), far(rig_with(finder));
  near.insert(certain({0.0, 0.0, 0.0}), scan);
  far.insert(certain({-5e6, 5e6, 0.0}), scan);
  EXPECT_EQ(far.grid().tiles().size(), near.grid().tiles().size());
  EXPECT_NEAR(cells_in(far.grid()), cells_in(near.grid()), 40);
}

TEST(MapperPose, RefusesPosesThatAreNone) {
  sensors::Rig rig = rig_with(panoramic());
  rig.sonar_rings = {one_sonar()};
  Mapper mapper(rig);
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 2.0F);
  sensors::SonarSweep sweep;
  sweep.ranges_m = {2.0F};
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Pose2& pose : {Pose2{nan, 0, 0}, Pose2{0, inf, 0}, Pose2{0, 0, nan}}) {
    EXPECT_THROW(mapper.insert(certain(pose), scan), std::invalid_argument);
    EXPECT_THROW(mapper.insert(certain(pose), sweep), std::invalid_argument);
  }
  EXPECT_THROW(mapper.insert(certain({1e8, 0, 0}), scan), std::out_of_range);
  EXPECT_THROW(mapper.insert(certain({0, -1e8, 0}), sweep), std::out_of_range);
  Believed<PoseEstimate> bad = certain({});
  bad.value.covariance(1, 1) = nan;
  EXPECT_THROW(mapper.insert(bad, scan), std::invalid_argument);
  bad.value.covariance(1, 1) = -1.0;
  EXPECT_THROW(mapper.insert(bad, sweep), std::invalid_argument);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

TEST(MapperPose, RefusesAMotionThatCannotBe) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.1;
  Mapper mapper(rig_with(finder));
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 2.0F);
  const sensors::MotionPath jump({{0, {0, 0, 0}}, {1'000'000, {1e5, 0, 0}}});
  EXPECT_THROW(mapper.insert(certain({}), scan, jump), std::out_of_range);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

}  // namespace
}  // namespace credo::mapping
