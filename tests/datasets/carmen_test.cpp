// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/carmen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "datasets/acquisitions.hpp"
#include "datasets/format_error.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {
namespace {

using testing::HasSubstr;

constexpr const char* kLog =
    "# a comment\n"
    "PARAM robot_front_laser_max 60.5 1.0 host 1.0\n"
    "ODOM 1 2 0.5 0.1 0 0 10.25 host 10.25\n"
    "FLASER 4 1.5 81.83 0 60.7 3 4 0.1 2.9 4 0.1 10.5 host 10.5\n"
    "SYNC tag 10.6 host 10.6\n"
    "FLASER 4 1.5 50 nan 2 3.2 4 0.1 3.1 4 0.1 10.75 host 10.75\n"
    "NEFF 0.5 10.8 host 10.8\n";

TEST(Carmen, ReadsScansPosesAndOdometry) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.log", kLog);
  EXPECT_TRUE(is_carmen(file));
  const CarmenLog log = read_carmen(file);
  EXPECT_TRUE(log.times_usable);
  ASSERT_EQ(log.scans.size(), 1U);
  ASSERT_EQ(log.scans[0].size(), 2U);
  EXPECT_EQ(log.laser_names[0], "FLASER");
  EXPECT_EQ(log.scans[0][0].time, 10'500'000'000);
  const auto& first = log.scans[0][0].ranges_m;
  EXPECT_EQ(first[0], 1.5F);
  EXPECT_TRUE(std::isinf(first[1]));  // no return
  EXPECT_TRUE(std::isnan(first[2]));
  EXPECT_TRUE(std::isinf(first[3]));  // beyond what the log says the laser reaches
  EXPECT_TRUE(std::isinf(log.scans[0][1].ranges_m[1]));
  EXPECT_TRUE(std::isnan(log.scans[0][1].ranges_m[2]));
  EXPECT_EQ(log.laser_poses[0][0], (TimedPose{10'500'000'000, {3.0, 4.0, 0.1}}));
  EXPECT_EQ(log.base_poses[0][1].pose.x, 3.1);
  EXPECT_EQ(log.odometry.size(), 1U);
  const sensors::RangeFinder& finder = log.rig.range_finders[0];
  EXPECT_DOUBLE_EQ(finder.angle_min_rad, -std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(finder.angle_increment_rad, std::numbers::pi / 4.0);
  EXPECT_NEAR(finder.T_base_sensor.x, 0.1 * std::cos(0.1), 1e-9);
}

TEST(Carmen, ReadsNewLaserMessagesOldAndNew) {
  const TemporaryFolder folder;
  const std::string head = "ROBOTLASER1 0 -1.57 3.14 1.57 20.0 0.02 0 3 1 20 2 ";
  const std::string poses = "5 6 0.1 4.9 6 0.1 0.5 0.1 ";
  const auto file = folder.write("a.log", head + "2 7 8 " + poses + "0.6 0.4 100000 33.5 host 1.5\n" + head + poses +
                                              "0.6 0.4 34.5 host 2.5\n" +
                                              "RAWLASER2 0 1.57 3.14 -1.57 20.0 0 0 3 1 2 3 0 35 host 35\n");
  const CarmenLog log = read_carmen(file);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_THAT(log.laser_names, testing::ElementsAre("RAWLASER2", "ROBOTLASER1"));
  ASSERT_EQ(log.scans[1].size(), 2U);
  for (const TimedPose& row : log.laser_poses[1]) EXPECT_EQ(row.pose, (geometry::Pose2{5.0, 6.0, 0.1}));
  EXPECT_EQ(log.scans[1][1].time, 34'500'000'000);
  EXPECT_TRUE(std::isinf(log.scans[1][0].ranges_m[1]));
  EXPECT_EQ(log.rig.range_finders[1].noise.sigma_0_m, 0.02);
  EXPECT_TRUE(log.laser_poses[0].empty());
  EXPECT_EQ(log.scans[0][0].ranges_m[0], 3.0F);  // clockwise, so turned round
  EXPECT_GT(log.rig.range_finders[0].angle_increment_rad, 0.0);
}

TEST(Carmen, ReadsSonar) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.log",
                                 "SONAR 0.35 2 1.25 5.0 0.1 0.2 1.5 0.1 -0.2 -1.5 7.5 host 7.5\n"
                                 "SONAR 0.35 2 5.0 2.5 0.1 0.2 1.5 0.1 -0.2 -1.5 8.5 host 8.5\n");
  const CarmenLog log = read_carmen(file);
  ASSERT_EQ(log.sonar.size(), 1U);
  EXPECT_EQ(log.sonar[0][0].ranges_m[0], 1.25F);
  EXPECT_TRUE(std::isinf(log.sonar[0][0].ranges_m[1]));
  EXPECT_EQ(log.rig.sonar_rings[0].T_base_transducer[1], (geometry::Pose2{0.1, -0.2, -1.5}));
  const Dataset dataset = to_dataset(log, "sonar");
  EXPECT_EQ(Acquisitions(dataset).size(), 2U);
}

TEST(Carmen, TimesThatTellNothingApartAreMadeUp) {
  const TemporaryFolder folder;
  const std::string row = "FLASER 2 1 2 0 0 0 0 0 0 1.01893e+09 host 1.01893e+09\n";
  const CarmenLog log = read_carmen(folder.write("a.log", row + row + row));
  EXPECT_FALSE(log.times_usable);
  EXPECT_EQ(log.scans[0][1].time - log.scans[0][0].time, 100'000'000);
  EXPECT_THAT(log.remarks, testing::Contains(HasSubstr("do not tell its scans apart")));
}

TEST(Carmen, RowsOutOfOrderAreSortedWithTheirPoses) {
  const TemporaryFolder folder;
  const CarmenLog log = read_carmen(folder.write("a.log",
                                                 "FLASER 1 1 2 0 0 2 0 0 20 host 20\n"
                                                 "FLASER 1 1 1 0 0 1 0 0 10 host 10\n"));
  EXPECT_EQ(log.laser_poses[0][0], (TimedPose{10'000'000'000, {1.0, 0.0, 0.0}}));
  EXPECT_EQ(log.scans[0][0].time, 10'000'000'000);
  EXPECT_THAT(log.remarks, testing::Contains(HasSubstr("were sorted")));
}

TEST(Carmen, NamesTheLineOfAMistake) {
  const TemporaryFolder folder;
  const auto said = [&](std::string_view content) {
    const auto file = folder.write("a.log", content);
    return complaint([&] { (void)read_carmen(file); });
  };
  EXPECT_THAT(said(""), HasSubstr("holds no scan"));
  EXPECT_THAT(said("ODOM 1 2 3 0 0 0 1 h 1\n"), HasSubstr("holds no scan"));
  EXPECT_THAT(said("\nFLASER 3 1 2\n"), HasSubstr("a.log:2: FLASER: ends too early"));
  EXPECT_THAT(said("FLASER 0 0 0 0 0 0 0 1 h 1\n"), HasSubstr("a.log:1: FLASER: expected how many readings"));
  EXPECT_THAT(said("FLASER 1 one 0 0 0 0 0 0 1 h 1\n"), HasSubstr("'one'"));
  EXPECT_THAT(said("FLASER 1 1 nan 0 0 0 0 0 1 h 1\n"), HasSubstr("finite"));
  EXPECT_THAT(said("FLASER 1 1 0 0 0 0 0 0 1 h 1\nFLASER 2 1 1 0 0 0 0 0 0 2 h 2\n"),
              HasSubstr("a.log:2: FLASER: expected 1"));
  EXPECT_FALSE(is_carmen(folder.write("b", "1 0 0 0 0 0 0 1\n")));
  EXPECT_FALSE(is_carmen(folder / "nowhere"));
}

TEST(Carmen, ReadsGzippedLogsAndRefusesTruncatedOnes) {
  const TemporaryFolder folder;
  const auto file = folder / "a.log.gz";
  const gzFile out = gzopen(file.c_str(), "wb");
  std::string content;
  for (int i = 0; i < 200; ++i)
    content += "FLASER 2 1." + std::to_string(i * 7919 % 1000) + " 2 0 0 0 0 0 0 " + std::to_string(i) + ".5 h 1\n";
  gzwrite(out, content.data(), static_cast<unsigned>(content.size()));
  gzclose(out);
  EXPECT_TRUE(is_carmen(file));
  EXPECT_EQ(read_carmen(file).scans[0].size(), 200U);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(complaint([&] { (void)read_carmen(file); }), HasSubstr("truncated"));
}

TEST(Carmen, ReadsPublishedLogs) {
  const char* data = std::getenv("CREDO_DATA");
  if (data == nullptr) GTEST_SKIP() << "CREDO_DATA is not set";
  const std::filesystem::path real = std::filesystem::path(data) / "real";
  const CarmenLog intel = read_carmen(real / "carmen_corrected/intel-corrected.log.gz");
  ASSERT_EQ(intel.scans.size(), 1U);
  EXPECT_EQ(intel.scans[0].size(), 910U);
  EXPECT_EQ(intel.laser_poses[0].size(), 910U);
  EXPECT_EQ(intel.rig.range_finders[0].count, 180);
  EXPECT_TRUE(intel.times_usable);
  std::size_t no_return = 0, beyond = 0;
  for (const auto& scan : intel.scans[0])
    for (const float range : scan.ranges_m)
      no_return += std::isinf(range) ? 1 : 0, beyond += range > 60.0F && !std::isinf(range);
  EXPECT_EQ(no_return, 4172U);
  EXPECT_EQ(beyond, 0U);
  EXPECT_EQ(read_carmen(real / "intel_lab/DERIVED_intel_raw_odometry.clf.gz").scans[0].size(), 910U);
  EXPECT_EQ(read_carmen(real / "carmen_corrected/aces-corrected.log.gz").scans[0].size(), 440U);
  const CarmenLog belgioioso = read_carmen(real / "carmen_corrected/belgioioso-corrected.log.gz");
  EXPECT_FALSE(belgioioso.times_usable);
  EXPECT_EQ(belgioioso.rig.range_finders[0].count, 361);
}

TEST(Carmen, AWholeNumberIsToldAsOne) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.log", "FLASER 0 1 0 0 0 0 0 0 1 host 1\n");
  EXPECT_THAT([&] { (void)read_carmen(file); },
              testing::ThrowsMessage<FormatError>(testing::EndsWith("1 to 100000, found 0")));
}

}  // namespace
}  // namespace credo::datasets
