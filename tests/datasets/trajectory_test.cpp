// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>
#include <stdexcept>

#include "tests/datasets/small_dataset.hpp"

namespace credo::datasets {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RC_GTEST_PROP(Seconds, LoseNothingOfANanosecond, ()) {
  const auto time = *rc::gen::inRange<sensors::Timestamp>(-4'000'000'000'000'000'000, 4'000'000'000'000'000'000);
  RC_ASSERT(parse_seconds(to_seconds(time)) == time);
}

TEST(Seconds, AreReadInEveryCommonForm) {
  EXPECT_EQ(parse_seconds("1600000000.012345678"), 1'600'000'000'012'345'678);
  EXPECT_EQ(parse_seconds("12"), 12'000'000'000);
  EXPECT_EQ(parse_seconds(".5"), 500'000'000);
  EXPECT_EQ(parse_seconds("-0.25"), -250'000'000);
  EXPECT_EQ(parse_seconds("0.0000000015"), 2);
  EXPECT_EQ(parse_seconds("1.5e3"), 1'500'000'000'000);
  EXPECT_EQ(to_seconds(-1), "-0.000000001");
  for (const char* text : {"", ".", "x", "1.2.3", "nan", "inf", "1e30", "99999999999", "--1", "1,5"})
    EXPECT_THROW((void)parse_seconds(text), std::invalid_argument) << text;
}

RC_GTEST_PROP(Tum, ComesBackAsItWent, ()) {
  std::vector<TimedPose> poses;
  sensors::Timestamp time = 1'600'000'000'000'000'001;
  for (int i = 0; i < 5; ++i) {
    time += *rc::gen::inRange<sensors::Timestamp>(0, 1'000'000'007);
    const auto metres = [] { return 1e-6 * *rc::gen::inRange(-100'000'000, 100'000'000); };
    poses.push_back({time, {metres(), metres(), 1e-7 * *rc::gen::inRange(-31'415'926, 31'415'926)}});
  }
  const TemporaryFolder folder;
  write_tum(folder / "poses.tum", poses);
  const Trajectory read = read_trajectory(folder / "poses.tum");
  RC_ASSERT(read.format == TrajectoryFormat::kTum);
  RC_ASSERT(read.poses.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    RC_ASSERT(read.poses[i].time == poses[i].time);
    RC_ASSERT(std::abs(read.poses[i].pose.x - poses[i].pose.x) < 1e-9);
    RC_ASSERT(std::abs(read.poses[i].pose.y - poses[i].pose.y) < 1e-9);
    RC_ASSERT(std::abs(geometry::angle_difference(read.poses[i].pose.theta, poses[i].pose.theta)) < 1e-8);
  }
}

TEST(Tum, IsWrittenForOtherTools) {
  std::ostringstream out;
  write_tum(out, std::vector<TimedPose>{{1'600'000'000'000'000'001, {1.0, -2.5, 0.0}}});
  EXPECT_EQ(
      out.str(),
      "1600000000.000000001 1.000000000 -2.500000000 0.000000000 0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(ReadTrajectory, TellsFormatsApartByTheirContent) {
  const TemporaryFolder folder;
  const auto read = [&](std::string_view content) { return read_trajectory(folder.write("poses", content)); };

  const Trajectory tum =
      read("# a comment\n1.5 1 2 0 0 0 0.7071067811865476 0.7071067811865476 \n\n2 3 4 0 0 0 0 -1\n");
  EXPECT_EQ(tum.format, TrajectoryFormat::kTum);
  ASSERT_EQ(tum.poses.size(), 2U);
  EXPECT_EQ(tum.poses[0].time, 1'500'000'000);
  EXPECT_NEAR(tum.poses[0].pose.theta, 1.5707963267948966, 1e-12);
  EXPECT_NEAR(tum.poses[1].pose.theta, 0.0, 1e-12);

  const Trajectory euroc = read("#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n1500,1,2,3,0.6,0,0,0.8\n");
  EXPECT_EQ(euroc.format, TrajectoryFormat::kEuroc);
  EXPECT_EQ(euroc.poses[0].time, 1500);
  EXPECT_NEAR(euroc.poses[0].pose.theta, 2.0 * std::atan2(0.8, 0.6), 1e-12);

  const Trajectory table = read("#timestamp [ns],x [m],y [m],theta [rad],var_x\n7,1,2,7.0,0.1\n");
  EXPECT_EQ(table.format, TrajectoryFormat::kPoseTable);
  EXPECT_NEAR(table.poses[0].pose.theta, 7.0 - 2.0 * 3.141592653589793, 1e-12);

  // Forward along the camera's z, then a quarter turn to the left (about -y).
  const Trajectory kitti = read("1 0 0 0 0 1 0 0 0 0 1 0\n0 0 -1 -2 0 1 0 0 1 0 0 5\n");
  EXPECT_EQ(kitti.format, TrajectoryFormat::kKitti);
  EXPECT_FALSE(kitti.has_times);
  EXPECT_EQ(kitti.poses[1].time, 1'000'000'000);
  EXPECT_NEAR(kitti.poses[1].pose.x, 5.0, 1e-12);
  EXPECT_NEAR(kitti.poses[1].pose.y, 2.0, 1e-12);
  EXPECT_NEAR(kitti.poses[1].pose.theta, 1.5707963267948966, 1e-12);

  const Trajectory planar = read("1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 3 1 0 0 4 0 0 1 0\n");
  EXPECT_NEAR(planar.poses[1].pose.y, 4.0, 1e-12);
  EXPECT_NEAR(planar.poses[1].pose.theta, 1.5707963267948966, 1e-12);
}

TEST(ReadTrajectory, TakesTheTruthOfADatasetAndTheTrajectoryOfResults) {
  const TemporaryFolder folder;
  write_small_dataset(folder / "small");
  const Trajectory truth = read_trajectory(folder / "small");
  EXPECT_EQ(truth.format, TrajectoryFormat::kPoseTable);
  EXPECT_EQ(truth.poses.size(), 40U);
  write_tum(folder / "trajectory.tum", truth.poses);
  const Trajectory results = read_trajectory(folder.path());
  EXPECT_EQ(results.format, TrajectoryFormat::kTum);
  EXPECT_EQ(results.poses[7].time, truth.poses[7].time);
  std::filesystem::remove_all(folder / "small/groundtruth0");
  EXPECT_THAT(complaint([&] { (void)read_trajectory(folder / "small"); }), HasSubstr("no groundtruth0"));
}

TEST(ReadTrajectory, NamesTheLineOfAMistake) {
  const TemporaryFolder folder;
  const auto said = [&](std::string_view content) {
    const auto file = folder.write("poses", content);
    return complaint([&] { (void)read_trajectory(file); });
  };
  EXPECT_THAT(said(""), HasSubstr("holds no pose"));
  EXPECT_THAT(said("# nothing\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(said("1 2 3\n"), AllOf(HasSubstr("poses:1:"), HasSubstr("found 3 columns")));
  EXPECT_THAT(said("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n"),
              HasSubstr("poses:2: expected 8 columns, as in line 1, found 7"));
  EXPECT_THAT(said("1 0 nan 0 0 0 0 1\n"), AllOf(HasSubstr("poses:1: column 3"), HasSubstr("'nan'")));
  EXPECT_THAT(said("1 0 1e99 0 0 0 0 1\n"), HasSubstr("poses:1: column 3"));
  EXPECT_THAT(said("1 0 0 0 0 0 0 0\n"), HasSubstr("norm 1, found norm 0"));
  EXPECT_THAT(said("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), HasSubstr("poses:2: the time 1.000000000 s comes after 2.0"));
  EXPECT_THAT(said(std::string_view("\x7f\0ELF", 5)), HasSubstr("zero byte"));
  EXPECT_THAT(complaint([&] { (void)read_trajectory(folder / "nowhere"); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace credo::datasets
