// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/spatial_trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class SpatialTrajectoryFiles : public testing::Test {
 protected:
  fs::path write(const std::string& name, std::string_view text) const { return folder_.write(name, text); }
  TemporaryFolder folder_;
};

TEST_F(SpatialTrajectoryFiles, TumKeepsEveryNanosecond) {
  const auto t = read_spatial_trajectory(write("a.tum",
                                               "# timestamp tx ty tz qx qy qz qw\n"
                                               "1600022000.012766001 1 2 3 0 0 0.7071067811865476 0.7071067811865476\n"
                                               "1600022001 1 2 3 0 0 0 1\n1600022001.5  -1 2 3 0 0 0 1 \r\n"));
  ASSERT_EQ(t.poses.size(), 3u);
  EXPECT_EQ(t.poses[0].time, 1600022000012766001);
  EXPECT_EQ(t.poses[1].time, 1600022001000000000);
  EXPECT_EQ(t.poses[2].time, 1600022001500000000);
  EXPECT_NEAR(flatten(t.poses[0]).theta, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(t.poses[0].position, Eigen::Vector3d(1, 2, 3));
}

TEST_F(SpatialTrajectoryFiles, TumTimesMayBeNegativeLongOrInPowersOfTen) {
  const auto t =
      read_spatial_trajectory(write("a.tum", "-1.25 0 0 0 0 0 0 1\n0.12345678951 0 0 0 0 0 0 1\n1e2 0 0 0 0 0 0 1\n"));
  EXPECT_EQ(t.poses[0].time, -1250000000);
  EXPECT_EQ(t.poses[1].time, 123456790);
  EXPECT_EQ(t.poses[2].time, 100000000000);
}

TEST_F(SpatialTrajectoryFiles, KittiHasNoTimes) {
  const auto t = read_spatial_trajectory(write("k.txt", "1 0 0 5 0 1 0 6 0 0 1 7\n0 -1 0 5 1 0 0 6 0 0 1 7\n"));
  EXPECT_FALSE(t.has_times);
  EXPECT_EQ(t.poses[1].position, Eigen::Vector3d(5, 6, 7));
  EXPECT_NEAR(flatten(t.poses[1]).theta, std::numbers::pi / 2, 1e-12);
}

TEST_F(SpatialTrajectoryFiles, EurocHasTheScalarFirst) {
  const auto t = read_spatial_trajectory(write("e.csv",
                                               "#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z, v_x\n"
                                               "1403636580838555648,4.6,-1.7,0.7,0.5,-0.5,-0.5,-0.5,-0.02\n"));
  EXPECT_EQ(t.poses[0].time, 1403636580838555648);
  EXPECT_NEAR(t.poses[0].rotation(1, 0), 0.0, 1e-12);
  EXPECT_NEAR(t.poses[0].rotation(0, 1), 1.0, 1e-12);
}

TEST_F(SpatialTrajectoryFiles, FoldersAreToldApartByWhatIsInThem) {
  write("dataset/groundtruth0/data.csv", "#timestamp [ns],x [m],y [m],theta [rad]\n10,1,2,9.42477796076938\n");
  write("run/localization.csv", "#timestamp [ns],x [m],y [m],theta [rad],var_x,cov_xy,reason\n20,3,4,0.5,0.1,0,\n");
  const auto truth = read_spatial_trajectory(folder_ / "dataset"), run = read_spatial_trajectory(folder_ / "run");
  EXPECT_EQ(truth.poses[0].position.z(), 0.0);
  EXPECT_NEAR(flatten(truth.poses[0]).theta, std::numbers::pi, 1e-9);
  EXPECT_EQ(run.poses[0].time, 20);
  EXPECT_NEAR(flatten(run.poses[0]).theta, 0.5, 1e-12);
  EXPECT_THAT([&] { (void)read_spatial_trajectory(folder_.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no trajectory")));
}

TEST_F(SpatialTrajectoryFiles, ErrorsNameFileAndLine) {
  const auto read = [&](const std::string& text) {
    return [this, text] { (void)read_spatial_trajectory(write("bad.tum", text)); };
  };
  EXPECT_THAT(read("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"),
              ThrowsMessage<std::runtime_error>(HasSubstr("bad.tum:2: expected 8")));
  EXPECT_THAT(read("0 0 zero 0 0 0 0 1\n"),
              ThrowsMessage<std::runtime_error>(HasSubstr("bad.tum:1: column 3: expected a finite")));
  EXPECT_THAT(read("0 0 nan 0 0 0 0 1\n"), ThrowsMessage<std::runtime_error>(HasSubstr("column 3")));
  EXPECT_THAT(read("0 0 0 0 0 0 0 0\n"), ThrowsMessage<std::runtime_error>(HasSubstr("quaternion")));
  EXPECT_THAT(read("0 0 1e300 0 0 0 0 1\n"), ThrowsMessage<std::runtime_error>(HasSubstr("column 3")));
  EXPECT_THAT(read("1e300 0 0 0 0 0 0 1\n"),
              ThrowsMessage<std::runtime_error>(HasSubstr("bad.tum:1: expected a time")));
  EXPECT_THAT(read(std::string("0 0 0 0 0 0 0 1\n\0", 18)),
              ThrowsMessage<std::runtime_error>(HasSubstr("bad.tum:2: holds a zero byte")));
  EXPECT_THAT([this] { (void)read_spatial_trajectory(write("bad.csv", "9223372036854775807,0,0,0\n")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("whole nanoseconds")));
  EXPECT_THAT(read("1.2.3 0 0 0 0 0 0 1\n"), ThrowsMessage<std::runtime_error>(HasSubstr("bad.tum:1")));
  EXPECT_THAT(read("1 2 3\n"), ThrowsMessage<std::runtime_error>(HasSubstr("found 3")));
  EXPECT_THAT(read("# only a comment\n"), ThrowsMessage<std::runtime_error>(HasSubstr("no pose")));
  EXPECT_THROW((void)read_spatial_trajectory(folder_ / "missing"), std::runtime_error);
}

}  // namespace
}  // namespace credo::datasets
