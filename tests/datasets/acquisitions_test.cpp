// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/acquisitions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/datasets/small_dataset.hpp"

namespace credo::datasets {
namespace {

using sensors::Timestamp;

constexpr Timestamp kSecond = 1'000'000'000;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class SmallDatasetRead : public testing::Test {
 protected:
  SmallDatasetRead() { write_small_dataset(temporary_ / "small"); }

  [[nodiscard]] Dataset open() const { return Dataset::open(temporary_ / "small"); }

  TemporaryFolder temporary_;
};

TEST_F(SmallDatasetRead, GathersWhatBelongsToAnImage) {
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  ASSERT_EQ(acquisitions.size(), 4U);
  const sensors::Acquisition second = acquisitions.read(1);  // at 750 ms, after the one at 250 ms
  EXPECT_EQ(second.time, kStart + 750 * kMillisecond);
  EXPECT_EQ(second.image->time, second.time);
  EXPECT_EQ(second.image->pixels.at<unsigned char>(5, 5), 15);
  EXPECT_EQ(second.scan->time, kStart + 703 * kMillisecond);  // 47 ms before; the next is 53 ms after
  EXPECT_EQ(second.scan->sensor, 0);
  EXPECT_EQ(second.odometry.size(), 10U);
  EXPECT_EQ(second.odometry.front().time, kStart + 300 * kMillisecond);
  EXPECT_EQ(second.sonar.size(), 2U);       // at 450 and 650; the one at 250 belongs to the first acquisition
  EXPECT_EQ(second.scans.size(), 5U + 2U);  // 303 .. 703 of range0; 400 and 600 of range1
  for (std::size_t i = 1; i < second.scans.size(); ++i) EXPECT_GE(second.scans[i].time, second.scans[i - 1].time);
  ASSERT_TRUE(second.motion);
  EXPECT_NEAR(second.motion->pose.x, 0.2, 1e-9);
  EXPECT_NEAR(second.motion->pose.theta, 0.0, 1e-12);
}

TEST_F(SmallDatasetRead, LosesNoRowAndGivesNoneTwice) {
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  std::size_t scans = 0, sonar = 0, odometry = 0;
  const auto count = [&](const sensors::Acquisition& acquisition) {
    scans += acquisition.scans.size();
    sonar += acquisition.sonar.size();
    odometry += acquisition.odometry.size();
  };
  for (const sensors::Acquisition& acquisition : acquisitions) count(acquisition);
  const sensors::Acquisition rest = acquisitions.trailing();
  EXPECT_GT(rest.scans.size(), 0U);
  EXPECT_EQ(rest.time, kStart + 1950 * kMillisecond);
  EXPECT_NEAR(rest.motion->pose.x, 0.08, 1e-9);
  count(rest);
  EXPECT_EQ(scans, dataset.scans[0].size() + dataset.scans[1].size());
  EXPECT_EQ(sonar, dataset.sonar[0].size());
  EXPECT_EQ(odometry, dataset.odometry.size());
}

TEST_F(SmallDatasetRead, PathCoversEveryReading) {
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  for (std::size_t i = 1; i < acquisitions.size(); ++i) {
    const sensors::Acquisition acquisition = acquisitions.read(i);
    EXPECT_LE(acquisition.path.rows().front().time, acquisitions.times()[i - 1]);
    EXPECT_GE(acquisition.path.rows().back().time, acquisition.scan->time + 20 * kMillisecond);
    EXPECT_GE(acquisition.path.rows().back().time, acquisition.time);
  }
}

TEST_F(SmallDatasetRead, WorksWithoutACamera) {
  std::filesystem::remove_all(temporary_ / "small/camera0");
  replace_in(temporary_ / "small/dataset.yaml", "acquisition_sensor: camera0\n", "");
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  EXPECT_EQ(acquisitions.size(), 20U);
  const sensors::Acquisition acquisition = acquisitions.read(4);
  EXPECT_FALSE(acquisition.image);
  EXPECT_EQ(acquisition.scan->time, acquisition.time);
}

TEST_F(SmallDatasetRead, WorksWithSonarAlone) {
  for (const char* name : {"camera0", "range0", "range1", "odometry0"})
    std::filesystem::remove_all(temporary_ / "small" / name);
  replace_in(temporary_ / "small/dataset.yaml", "acquisition_sensor: camera0\n", "");
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  EXPECT_EQ(acquisitions.size(), 10U);
  const sensors::Acquisition acquisition = acquisitions.read(3);
  EXPECT_FALSE(acquisition.scan);
  EXPECT_FALSE(acquisition.motion);
  EXPECT_TRUE(acquisition.path.empty());
  EXPECT_EQ(acquisition.sonar.size(), 1U);
}

TEST_F(SmallDatasetRead, EmptyFileNameIsAMissingImage) {
  replace_in(temporary_ / "small/camera0/data.csv", "01600000000750000000.png", "");
  const Dataset dataset = open();
  const Acquisitions acquisitions(dataset);
  EXPECT_TRUE(acquisitions.read(0).image);
  EXPECT_FALSE(acquisitions.read(1).image);
  EXPECT_TRUE(acquisitions.read(1).scan);
}

/// A dataset in memory, driven by range finder 0 at the given times.
Dataset driven_by_scans(const std::vector<Timestamp>& times) {
  Dataset dataset;
  dataset.header.acquisition_sensor = "range0";
  dataset.range_finder_names = {"range0"};
  sensors::RangeFinder finder;
  finder.count = 2;
  finder.scan_time_s = 1.0;
  dataset.header.rig.range_finders = {finder};
  dataset.header.rig.odometry = sensors::OdometryNoise{};
  dataset.scans.resize(1);
  for (const Timestamp time : times) dataset.scans[0].push_back({time, 0, {1.0F, 2.0F}});
  return dataset;
}

TEST(Acquisitions, ScanOfNanIsMissing) {
  Dataset dataset = driven_by_scans({0, kSecond});
  dataset.scans[0][1].ranges_m = {kNan, kNan};
  const Acquisitions acquisitions(dataset);
  EXPECT_TRUE(acquisitions.read(0).scan);
  EXPECT_FALSE(acquisitions.read(1).scan);
}

TEST(Acquisitions, ImageFartherThanATenthOfASecondIsMissing) {
  TemporaryFolder temporary;
  write_small_dataset(temporary / "small");
  replace_in(temporary / "small/dataset.yaml", "acquisition_sensor: camera0", "acquisition_sensor: range1");
  const Dataset dataset = Dataset::open(temporary / "small");
  const Acquisitions acquisitions(dataset);  // at 0, 200, 400 ... ms; images at 250, 750, 1250 ... ms
  EXPECT_FALSE(acquisitions.read(0).image);
  EXPECT_TRUE(acquisitions.read(1).image);
  EXPECT_FALSE(acquisitions.read(2).image);
  EXPECT_EQ(acquisitions.read(1).scan->time, kStart + 203 * kMillisecond);  // range0's
}

TEST(Acquisitions, RowsOfOneTimeAreOneAcquisition) {
  Dataset dataset = driven_by_scans({0, kSecond, kSecond, 2 * kSecond});
  dataset.scans[0][2].ranges_m[0] = 5.0F;
  const Acquisitions acquisitions(dataset);
  ASSERT_EQ(acquisitions.size(), 3U);
  EXPECT_EQ(acquisitions.read(1).scan->ranges_m[0], 5.0F);
  EXPECT_EQ(acquisitions.read(1).scans.size(), 2U);
}

TEST(Acquisitions, OdometryThatDiedGivesNoMotion) {
  std::vector<Timestamp> times;
  for (int i = 0; i < 10; ++i) times.push_back(i * kSecond);
  Dataset dataset = driven_by_scans(times);
  for (int i = 0; i <= 40; ++i) dataset.odometry.push_back({i * kSecond / 10, {0.05 * i, 0.0, 0.0}});  // until 4 s
  const Acquisitions acquisitions(dataset);
  EXPECT_TRUE(acquisitions.read(4).motion);
  EXPECT_FALSE(acquisitions.read(5).motion);
  EXPECT_TRUE(acquisitions.read(5).path.empty());
  EXPECT_FALSE(acquisitions.read(9).motion);
}

TEST(Acquisitions, StopAndGoOdometryDoesNotBendTheScanOfAStop) {
  Dataset dataset = driven_by_scans({0, 3 * kSecond, 6 * kSecond});
  for (int i = 0; i < 3; ++i) dataset.odometry.push_back({3 * i * kSecond, {0.3 * i, 0.0, 0.0}});
  const sensors::Acquisition stop = Acquisitions(dataset).read(1);
  for (const Timestamp off : {-kSecond / 2, Timestamp{0}, kSecond / 2})
    EXPECT_NEAR(stop.path.pose_at(stop.time + off).x, 0.3, 1e-12);
  EXPECT_NEAR(stop.motion->pose.x, 0.3, 1e-12);
}

TEST(Acquisitions, DrivingOdometryCarriesTheScan) {
  Dataset dataset = driven_by_scans({0, 3 * kSecond, 6 * kSecond});
  for (int i = 0; i <= 60; ++i) dataset.odometry.push_back({i * kSecond / 10, {0.01 * i, 0.0, 0.0}});
  const sensors::Acquisition driving = Acquisitions(dataset).read(1);
  EXPECT_NEAR(driving.path.pose_at(driving.time + kSecond / 2).x, 0.35, 1e-12);
}

TEST(Acquisitions, TurnOnTheSpotAndBackCounts) {
  Dataset dataset = driven_by_scans({0, kSecond});
  for (int i = 0; i <= 10; ++i)
    dataset.odometry.push_back({i * kSecond / 10, {0.0, 0.0, i <= 5 ? 0.2 * i : 0.2 * (10 - i)}});
  const auto motion = *Acquisitions(dataset).read(1).motion;
  EXPECT_NEAR(motion.pose.theta, 0.0, 1e-12);
  EXPECT_GT(std::sqrt(motion.covariance(2, 2)), 0.03 * std::sqrt(1.9));  // two radians were turned
}

TEST(Acquisitions, NoRowAtAllIsNoAcquisition) {
  const Dataset dataset = driven_by_scans({});
  const Acquisitions acquisitions(dataset);
  EXPECT_EQ(acquisitions.size(), 0U);
  EXPECT_TRUE(acquisitions.begin() == acquisitions.end());
  EXPECT_TRUE(acquisitions.trailing().scans.empty());
}

}  // namespace
}  // namespace credo::datasets
