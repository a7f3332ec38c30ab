// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "datasets/dataset.hpp"
#include "datasets/dataset_writer.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {

inline constexpr sensors::Timestamp kStart = 1'600'000'000'000'000'000;
inline constexpr sensors::Timestamp kMillisecond = 1'000'000;

inline DatasetHeader small_header() {
  DatasetHeader header;
  header.name = "small \"one\": #1";
  header.description = "a dataset for tests";
  header.license = "CC0";
  header.robot_radius_m = 0.3;
  header.initial_pose = geometry::PoseEstimate{{1.0, 0.5, 0.25}, Eigen::Vector3d(0.04, 0.01, 0.0025).asDiagonal()};
  header.acquisition_sensor = "camera0";
  sensors::OmniCamera camera;
  camera.T_base_camera = {0.1, -0.05, 0.2};
  camera.height_m = 1.2;
  camera.width_px = 32, camera.height_px = 24;
  camera.center_px = {15.5, 11.25};
  camera.inner_radius_px = 3.0, camera.outer_radius_px = 11.0, camera.horizon_radius_px = 6.0;
  camera.rim_radius_px = 11.5;
  camera.azimuth_zero_rad = 0.5, camera.azimuth_sign = 1;
  camera.mirror = sensors::ConicMirror{0.9, 0.06, 480.0};
  camera.exposure_s = 0.008;
  camera.mask = cv::Mat(24, 32, CV_8UC1, cv::Scalar(255));
  camera.mask.at<unsigned char>(3, 4) = 0;
  header.rig.camera = camera;
  sensors::RangeFinder finder;
  finder.T_base_sensor = {0.05, 0.0, 3.0};
  finder.angle_min_rad = -1.0, finder.angle_increment_rad = 0.5, finder.count = 5;
  finder.range_min_m = 0.2, finder.range_max_m = 6.0;
  finder.noise = {0.005, 0.0033};
  finder.scan_time_s = 0.04;
  header.rig.range_finders.push_back(finder);
  finder.count = 3, finder.scan_time_s = 0.0, finder.T_base_sensor = {0.0, 0.0, 0.0};
  header.rig.range_finders.push_back(finder);
  sensors::SonarRing ring;
  ring.T_base_transducer = {{0.1, 0.08, 1.57}, {0.1, -0.08, -1.57}};
  ring.firing_times_s = {-0.01, 0.01};
  header.rig.sonar_rings.push_back(ring);
  header.rig.odometry = sensors::OdometryNoise{0.04, 0.05, 0.06};
  header.floor_plan = geometry::FloorPlan{
      .walls = {{{0.0, 0.0}, {8.0, 0.0}}, {{8.0, 0.0}, {8.0, 3.5}}}, .verticals = {{3.2, 0.0}}, .uncertainty_m = 0.01};
  return header;
}

/// Four images at 2 Hz, range0 at 10 Hz, range1 and sonar at 5 Hz, odometry at 20 Hz, from kStart on for two seconds.
/// The robot drives along x at 0.4 m/s.
inline void write_small_dataset(const std::filesystem::path& target, const DatasetHeader& header = small_header(),
                                const WriterParams& params = {}) {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  DatasetWriter writer(target, header, params);
  for (int tick = 0; tick < 40; ++tick) {  // 50 ms
    const sensors::Timestamp time = kStart + tick * 50 * kMillisecond;
    const double way = 0.02 * tick;
    const float range = 1.0F + 0.01F * static_cast<float>(tick);
    if (tick % 10 == 5 && header.rig.camera) writer.add_image(time, cv::Mat(24, 32, CV_8UC1, cv::Scalar(tick)));
    if (tick % 2 == 0 && !header.rig.range_finders.empty())
      writer.add_scan({time + 3 * kMillisecond, 0, {range, kInf, kNan, 2.0F, 3.1234F}});
    if (tick % 4 == 0 && header.rig.range_finders.size() > 1) writer.add_scan({time, 1, {range, range, range}});
    if (tick % 4 == 1 && !header.rig.sonar_rings.empty()) writer.add_sonar({time, 0, {range, kInf}});
    if (header.rig.odometry) writer.add_odometry({time, {way, 0.0, 0.0}});
    writer.add_truth({time, {1.0 + way, 0.5, 0.25}});
  }
  writer.add_true_vertical({.time = kStart, .azimuth_rad = 0.123456789, .visible_share = 0.5, .contrast = 20.5});
  writer.add_event({.time = kStart + 7, .name = "kidnapped, twice"});
  writer.finish();
}

/// Each test has one of its own to damage.
class SmallDataset : public testing::Test {
 protected:
  SmallDataset() { write_small_dataset(folder_); }

  [[nodiscard]] std::string complaint_of_opening() const {
    return complaint([this] { (void)Dataset::open(folder_); });
  }
  /// Replaces text in a file of the dataset, opens it and returns the complaint.
  [[nodiscard]] std::string complaint_with(const std::string& file, std::string_view from, std::string_view to) const {
    replace_in(folder_ / file, from, to);
    return complaint_of_opening();
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_ / "small";
};

}  // namespace credo::datasets
