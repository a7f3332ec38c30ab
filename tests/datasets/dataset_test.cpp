// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "datasets/acquisitions.hpp"
#include "tests/datasets/small_dataset.hpp"

namespace credo::datasets {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(SmallDataset, ReadsBackWhatWasWritten) {
  const Dataset dataset = Dataset::open(folder_);
  const DatasetHeader& read = dataset.header;
  const DatasetHeader written = small_header();
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.description, written.description);
  EXPECT_EQ(read.license, written.license);
  EXPECT_EQ(read.robot_radius_m, 0.3);
  EXPECT_EQ(read.initial_pose->pose, written.initial_pose->pose);
  EXPECT_TRUE(read.initial_pose->covariance.isApprox(written.initial_pose->covariance, 1e-9));
  EXPECT_EQ(read.floor_plan, written.floor_plan);
  EXPECT_EQ(read.rig.odometry, written.rig.odometry);

  const sensors::OmniCamera& camera = *read.rig.camera;
  EXPECT_EQ(camera.T_base_camera, written.rig.camera->T_base_camera);
  EXPECT_EQ(camera.center_px, written.rig.camera->center_px);
  EXPECT_EQ(camera.mirror, written.rig.camera->mirror);
  EXPECT_EQ(camera.rim_radius_px, written.rig.camera->rim_radius_px);
  EXPECT_EQ(camera.azimuth_sign, 1);
  EXPECT_EQ(camera.exposure_s, 0.008);
  EXPECT_EQ(camera.mask.at<unsigned char>(3, 4), 0);
  EXPECT_EQ(camera.mask.at<unsigned char>(4, 3), 255);

  ASSERT_EQ(read.rig.range_finders.size(), 2U);
  EXPECT_EQ(read.rig.range_finders[0].count, 5);
  EXPECT_EQ(read.rig.range_finders[0].T_base_sensor, written.rig.range_finders[0].T_base_sensor);
  EXPECT_EQ(read.rig.range_finders[0].noise, written.rig.range_finders[0].noise);
  EXPECT_EQ(read.rig.range_finders[0].scan_time_s, 0.04);
  EXPECT_EQ(read.rig.sonar_rings[0].T_base_transducer, written.rig.sonar_rings[0].T_base_transducer);
  EXPECT_EQ(read.rig.sonar_rings[0].firing_times_s, written.rig.sonar_rings[0].firing_times_s);

  EXPECT_EQ(dataset.images.size(), 4U);
  ASSERT_EQ(dataset.scans.size(), 2U);
  ASSERT_EQ(dataset.scans[0].size(), 20U);
  EXPECT_EQ(dataset.scans[0][0].time, kStart + 3 * kMillisecond);
  EXPECT_EQ(dataset.scans[0][0].ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isinf(dataset.scans[0][0].ranges_m[1]));
  EXPECT_TRUE(std::isnan(dataset.scans[0][0].ranges_m[2]));
  EXPECT_EQ(dataset.scans[0][0].ranges_m[4], 3.1234F);
  EXPECT_EQ(dataset.scans[1][0].sensor, 1);
  EXPECT_EQ(dataset.sonar[0].size(), 10U);
  EXPECT_EQ(dataset.odometry.size(), 40U);
  EXPECT_EQ(dataset.truth.size(), 40U);
  EXPECT_EQ(dataset.truth[1], (TimedPose{kStart + 50 * kMillisecond, {1.02, 0.5, 0.25}}));
  ASSERT_EQ(dataset.true_verticals.size(), 1U);
  EXPECT_EQ(dataset.true_verticals[0],
            (TrueVertical{.time = kStart, .azimuth_rad = 0.123456789, .visible_share = 0.5, .contrast = 20.5}));
  ASSERT_EQ(dataset.events.size(), 1U);
  EXPECT_EQ(dataset.events[0], (Event{kStart + 7, "kidnapped, twice"}));
  EXPECT_TRUE(dataset.remarks.empty());
}

TEST_F(SmallDataset, MissingOptionalFilesAreNoError) {
  for (const char* name : {"floor_plan.yaml", "groundtruth0", "events.csv", "odometry0", "sonar0", "range1"})
    std::filesystem::remove_all(folder_ / name);
  const Dataset dataset = Dataset::open(folder_);
  EXPECT_FALSE(dataset.header.floor_plan);
  EXPECT_FALSE(dataset.header.rig.odometry);
  EXPECT_TRUE(dataset.truth.empty());
  EXPECT_FALSE(dataset.truth_map);
}

TEST_F(SmallDataset, AcquisitionSensorDefaultsToTheFirstThatHasRows) {
  replace_in(folder_ / "dataset.yaml", "acquisition_sensor: camera0\n", "");
  EXPECT_EQ(Dataset::open(folder_).header.acquisition_sensor, "camera0");
  std::filesystem::remove_all(folder_ / "camera0");
  EXPECT_EQ(Dataset::open(folder_).header.acquisition_sensor, "range0");
  std::filesystem::remove_all(folder_ / "range0");
  std::filesystem::remove_all(folder_ / "range1");
  EXPECT_EQ(Dataset::open(folder_).header.acquisition_sensor, "sonar0");
  std::filesystem::remove_all(folder_ / "sonar0");
  EXPECT_THAT(complaint_of_opening(), HasSubstr("expected at least one of camera0, range0 and sonar0"));
}

TEST_F(SmallDataset, AcquisitionSensorThatIsNotThereIsRefused) {
  EXPECT_THAT(complaint_with("dataset.yaml", "sensor: camera0", "sensor: lidar"),
              AllOf(HasSubstr("dataset.yaml:8"), HasSubstr("camera0, range0, range1, sonar0"), HasSubstr("'lidar'")));
}

TEST_F(SmallDataset, ReadingsOutOfLimitsAreCountedAndTakenAsNan) {
  replace_in(folder_ / "range0/data.csv", ",1.0000,inf,nan,2.0000,3.1234\n", ",0.1000,-1,6.1,,1e30\n");
  const Dataset dataset = Dataset::open(folder_);
  for (const float range : dataset.scans[0][0].ranges_m) EXPECT_TRUE(std::isnan(range));
  const SensorLog& log = dataset.log[1];
  EXPECT_EQ(log.sensor, "range0");
  EXPECT_EQ(log.below_range_min, 1U);
  EXPECT_EQ(log.negative, 1U);
  EXPECT_EQ(log.above_range_max, 2U);
  EXPECT_EQ(log.rows_without_value, 1U);
  EXPECT_EQ(log.rows, 19U);
}

TEST_F(SmallDataset, CarriageReturnsSpacesAndAByteOrderMarkDoNoHarm) {
  std::string content = read_all(folder_ / "odometry0/data.csv");
  for (std::size_t at = 0; (at = content.find('\n', at)) != std::string::npos; at += 2) content.insert(at, "\r");
  temporary_.write("small/odometry0/data.csv", "\xEF\xBB\xBF" + content + "\r\n \r\n");
  EXPECT_EQ(Dataset::open(folder_).odometry.size(), 40U);
}

TEST_F(SmallDataset, OdometryRowsOfNanAreLeftOutAndCounted) {
  replace_in(folder_ / "odometry0/data.csv", ",0.020000,0.000000,0.000000000\n", ",nan,nan,nan\n");
  const Dataset dataset = Dataset::open(folder_);
  EXPECT_EQ(dataset.odometry.size(), 39U);
  EXPECT_EQ(dataset.log.at(4).sensor, "odometry0");
  EXPECT_EQ(dataset.log.at(4).rows_without_value, 1U);
}

TEST_F(SmallDataset, ClockwiseScannerIsReadCounterClockwise) {
  replace_in(folder_ / "range0/sensor.yaml", "angle_increment: 0.5", "angle_increment: -0.5");
  const Dataset dataset = Dataset::open(folder_);
  const sensors::RangeFinder& finder = dataset.header.rig.range_finders[0];
  EXPECT_DOUBLE_EQ(finder.angle_min_rad, -3.0);
  EXPECT_DOUBLE_EQ(finder.angle_increment_rad, 0.5);
  EXPECT_DOUBLE_EQ(finder.beam_time(4), -0.016);  // what was the first beam
  EXPECT_EQ(dataset.scans[0][0].ranges_m[4], 1.0F);
  EXPECT_EQ(dataset.scans[0][0].ranges_m[0], 3.1234F);
}

TEST_F(SmallDataset, SecondCameraIsCheckedAndRemarkedOn) {
  std::filesystem::copy(folder_ / "camera0", folder_ / "camera1", std::filesystem::copy_options::recursive);
  EXPECT_THAT(Dataset::open(folder_).remarks, testing::ElementsAre(HasSubstr("camera1 is not used")));
  EXPECT_THAT(complaint_with("camera1/sensor.yaml", "conic", "comic"), HasSubstr("camera1/sensor.yaml"));
}

TEST_F(SmallDataset, MisspeltSensorFolderIsRemarkedOn) {
  std::filesystem::rename(folder_ / "range1", folder_ / "rnage1");
  EXPECT_THAT(Dataset::open(folder_).remarks, testing::ElementsAre(HasSubstr("rnage1 is not used")));
}

TEST_F(SmallDataset, TruncatedImageIsFoundAtOpening) {
  const auto image = folder_ / "camera0/data/01600000000250000000.png";
  std::filesystem::resize_file(image, std::filesystem::file_size(image) - 5);
  EXPECT_THAT(complaint_of_opening(),
              AllOf(HasSubstr("camera0/data.csv:2: "), HasSubstr(image), HasSubstr("truncated")));
  std::filesystem::resize_file(image, 0);
  EXPECT_THAT(complaint_of_opening(), HasSubstr("is empty"));
}

TEST_F(SmallDataset, ResolutionThatDoesNotFitIsRefused) {
  std::filesystem::remove(folder_ / "camera0/mask.png");
  replace_in(folder_ / "camera0/sensor.yaml", "mask: mask.png\n", "");
  EXPECT_THAT(complaint_with("camera0/sensor.yaml", "[32, 24]", "[64, 48]"),
              AllOf(HasSubstr("32 x 24"), HasSubstr("64 x 48")));
}

TEST_F(SmallDataset, DamagedImageIsAnErrorWhenItIsRead) {
  const auto image = folder_ / "camera0/data/01600000000250000000.png";
  std::string bytes = read_all(image);
  for (std::size_t i = 40; i + 20 < bytes.size(); ++i) bytes[i] = static_cast<char>(~bytes[i]);
  temporary_.write("small/camera0/data/01600000000250000000.png", bytes);
  const Dataset dataset = Dataset::open(folder_);
  const Acquisitions acquisitions(dataset);
  testing::internal::CaptureStderr();
  EXPECT_THAT(complaint([&] { (void)acquisitions.read(0); }),
              AllOf(HasSubstr("camera0/data.csv:2: "), HasSubstr(image), HasSubstr("damaged")));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(acquisitions.read(1).image);
}

TEST_F(SmallDataset, MissingFilesAreNamed) {
  EXPECT_THAT(complaint([&] { (void)Dataset::open(folder_ / "nowhere"); }), HasSubstr("no such folder"));
  EXPECT_THAT(complaint([&] { (void)Dataset::open(folder_ / "dataset.yaml"); }), HasSubstr("is a file"));
  EXPECT_THAT(complaint([&] { (void)Dataset::open(folder_ / "camera0"); }), HasSubstr("no dataset.yaml"));
  std::filesystem::remove(folder_ / "range0/data.csv");
  EXPECT_THAT(complaint_of_opening(), HasSubstr("range0/data.csv: there is no such file"));
  std::filesystem::remove(folder_ / "range0/sensor.yaml");
  EXPECT_THAT(complaint_of_opening(), HasSubstr("range0/sensor.yaml: there is no such file"));
}

TEST_F(SmallDataset, NumberOfReadingsMustFitTheSensor) {
  EXPECT_THAT(complaint_with("range0/sensor.yaml", "count: 5", "count: 6"),
              AllOf(HasSubstr("range0/data.csv:1: expected 7 columns"), HasSubstr("sensor.yaml tells of 6 readings"),
                    HasSubstr("found 6")));
}

TEST_F(SmallDataset, DeeplyNestedYamlIsRefusedNotCrashedOn) {
  temporary_.write("small/floor_plan.yaml", "walls: " + std::string(200'000, '['));
  EXPECT_THAT(complaint_of_opening(), HasSubstr("floor_plan.yaml"));
}

/// Whatever is in a file, the outcome is a dataset or a complaint that names the file or one that it names.
TEST_F(SmallDataset, SonarRangesAreThoseOfTheAirTheyWereTakenIn) {
  const std::string yaml = read_all(folder_ / "sonar0/sensor.yaml");
  temporary_.write("small/sonar0/sensor.yaml", yaml + "air_temperature: 5\nsound_speed: 340\n");
  const Dataset cold = Dataset::open(folder_);
  const double factor = 331.3 * std::sqrt(1.0 + 5.0 / 273.15) / 340.0;
  EXPECT_NEAR(cold.sonar[0][0].ranges_m[0], 1.01 * factor, 1e-6);
  EXPECT_TRUE(std::isinf(cold.sonar[0][0].ranges_m[1]));
  EXPECT_NEAR(cold.header.rig.sonar_rings[0].range_max_m, 3.0 * factor, 1e-12);
  temporary_.write("small/sonar0/sensor.yaml", yaml + "air_temperature: 20\n");
  EXPECT_NEAR(Dataset::open(folder_).sonar[0][0].ranges_m[0], 1.01, 1e-6);
  temporary_.write("small/sonar0/sensor.yaml", yaml + "sound_speed: 340\n");
  EXPECT_THAT(complaint_of_opening(), HasSubstr("has no effect without air_temperature"));
  temporary_.write("small/sonar0/sensor.yaml", yaml + "air_temperature: -300\n");
  EXPECT_THAT(complaint_of_opening(), HasSubstr("sensor.yaml:"));
}

TEST_F(SmallDataset, AnyDamageEndsInADatasetOrAComplaint) {
  std::mt19937 random(7);
  const auto below = [&random](std::size_t n) { return random() % n; };
  const std::string_view kPieces[] = {"nan", "inf", "-1", "1e999",    ",",  "\n", "[",
                                      "]",   "{",   ":",  "\xFF\xFE", "\"", "#",  "0"};
  int refused = 0, opened = 0;
  for (const char* name : {"dataset.yaml", "floor_plan.yaml", "camera0/sensor.yaml", "camera0/data.csv",
                           "range0/sensor.yaml", "range0/data.csv", "sonar0/sensor.yaml", "odometry0/sensor.yaml",
                           "odometry0/data.csv", "groundtruth0/data.csv", "groundtruth0/verticals.csv", "events.csv"}) {
    const std::string whole = read_all(folder_ / name);
    for (int i = 0; i < 40; ++i) {
      std::string damaged = whole;
      switch (i % 4) {
        case 0: damaged.resize(below(damaged.size())); break;
        case 1: damaged[below(damaged.size())] = static_cast<char>(random()); break;
        case 2: damaged.insert(below(damaged.size()), kPieces[below(std::size(kPieces))]); break;
        default: damaged.erase(below(damaged.size()), 1 + below(9)); break;
      }
      temporary_.write(std::string("small/") + name, damaged);
      try {
        (void)Dataset::open(folder_);
        ++opened;
      } catch (const FormatError& error) {
        EXPECT_THAT(error.what(), HasSubstr(folder_.string()));
        ++refused;
      }
    }
    temporary_.write(std::string("small/") + name, whole);
  }
  EXPECT_GT(refused, 150);
  EXPECT_GT(opened, 20);
}

TEST(RecordedDatasets, OpenWithoutARemark) {
  const char* data = std::getenv("CREDO_DATA");
  if (data == nullptr) GTEST_SKIP() << "CREDO_DATA is not set";
  const std::pair<const char*, std::size_t> kSets[] = {
      {"corridor-end", 21}, {"corridor-end-2", 21}, {"hall-pillars", 60}, {"office", 60}};
  for (const auto& [name, count] : kSets) {
    const Dataset dataset = Dataset::open(std::filesystem::path(data) / "synthetic" / name);
    EXPECT_EQ(dataset.header.name, name);
    EXPECT_TRUE(dataset.header.floor_plan);
    EXPECT_TRUE(dataset.header.initial_pose);
    EXPECT_TRUE(dataset.remarks.empty());
    const Acquisitions acquisitions(dataset);
    EXPECT_EQ(acquisitions.size(), count);
    for (const std::size_t index : {std::size_t{0}, count / 2, count - 1}) {
      const sensors::Acquisition acquisition = acquisitions.read(index);
      EXPECT_TRUE(acquisition.image);
      EXPECT_TRUE(acquisition.scan);
      EXPECT_EQ(acquisition.motion.has_value(), index > 0);
    }
  }
}

}  // namespace
}  // namespace credo::datasets
