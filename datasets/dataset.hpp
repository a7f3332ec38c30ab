// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "geometry/pose.hpp"
#include "sensors/acquisition.hpp"

namespace credo::datasets {

/// A pose of the robot base at a time.
struct TimedPose {
  sensors::Timestamp time = 0;
  geometry::Pose2 pose;

  friend bool operator==(const TimedPose&, const TimedPose&) = default;
};

/// A vertical edge that truly is in the image of the same time; for evaluation only.
struct TrueVertical {
  sensors::Timestamp time = 0;
  double azimuth_rad = 0.0;    ///< in the camera frame
  double visible_share = 0.0;  ///< share of the usable rows that show it
  double contrast = 0.0;       ///< grey levels

  friend bool operator==(const TrueVertical&, const TrueVertical&) = default;
};

/// Something that happened to the robot (kidnapped, obstacle_added, ...); for evaluation only.
struct Event {
  sensors::Timestamp time = 0;
  std::string name;

  friend bool operator==(const Event&, const Event&) = default;
};

/// An image that is on disk; decoded when it is asked for.
struct ImageFile {
  sensors::Timestamp time = 0;
  std::filesystem::path file;  ///< empty: no measurement
  std::filesystem::path listed_in = {};
  int line = 0;  ///< of `listed_in`
};

/// What a dataset says of itself and of the robot: all but the rows.
struct DatasetHeader {
  std::string name;
  std::string description;
  std::string license;
  double robot_radius_m = 0.25;
  std::optional<geometry::PoseEstimate> initial_pose;  ///< T_map_base at the start; absent = localize globally
  /// The sensor whose times define the acquisitions (camera0, range0, range1, sonar0, ...). Never empty once read.
  std::string acquisition_sensor;
  sensors::Rig rig;
  std::optional<geometry::FloorPlan> floor_plan;
};

/// Of an initial pose of which nothing else is said: 5 cm, 5 cm and 2 degrees, 1-sigma.
[[nodiscard]] Eigen::Matrix3d default_initial_covariance();

/// What was read with a remark: nothing is wrong enough to refuse the dataset, and nothing of it is hidden.
struct SensorLog {
  std::string sensor;               ///< folder, e.g. "range0"
  std::size_t rows = 0;             ///< usable
  std::size_t below_range_min = 0;  ///< readings taken as nan
  std::size_t above_range_max = 0;
  std::size_t negative = 0;
  std::size_t rows_without_value = 0;  ///< rows that are nan or empty throughout: the sensor is missing there
};

/// One drive of one robot, as recorded or simulated (docs/dataset-format.md). Plain values; only images stay on disk.
struct Dataset {
  std::filesystem::path folder;
  DatasetHeader header;
  // Rows by time; times never decrease.
  std::vector<ImageFile> images;                        ///< of camera0; empty without a camera
  std::vector<std::vector<sensors::RangeScan>> scans;   ///< [range finder][row]
  std::vector<std::vector<sensors::SonarSweep>> sonar;  ///< [sonar ring][row]
  std::vector<sensors::OdometryReading> odometry;
  // For evaluation only.
  std::vector<TimedPose> truth;  ///< T_map_base
  std::vector<TrueVertical> true_verticals;
  std::vector<Event> events;
  bool events_recorded = false;                    ///< there is an events.csv: what it does not tell did not happen
  std::optional<std::filesystem::path> truth_map;  ///< truth_map.yaml (map_server), where it is there
  // What a person should know about the reading of it.
  std::vector<SensorLog> log;
  std::vector<std::string> remarks;             ///< one line each, e.g. "camera1 is not used: ..."
  std::string camera_name;                      ///< folder of the camera, e.g. "camera0"; empty without a camera
  std::vector<std::string> range_finder_names;  ///< folder of each range finder, e.g. "range0"
  std::vector<std::string> sonar_ring_names;

  /// Reads and checks everything of a dataset but the pixels of its images, of which it checks that each is there,
  /// whole and of the camera's size (PNG; of other formats only that it is there). \throws FormatError for the first
  /// fault met, with file, line, what was found and what was expected.
  [[nodiscard]] static Dataset open(const std::filesystem::path& folder);

  /// Whether `folder` looks like a dataset: it has a dataset.yaml.
  [[nodiscard]] static bool is_dataset(const std::filesystem::path& folder);
};

}  // namespace credo::datasets
