// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/dataset.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "datasets/checked_yaml.hpp"
#include "datasets/csv_table.hpp"
#include "datasets/floor_plan_file.hpp"
#include "datasets/format_error.hpp"
#include "datasets/image_file.hpp"
#include "datasets/sensor_yaml.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

constexpr double kLargestAngle_rad = 1e4;
constexpr double kInitialSigma[] = {0.05, 0.05, 0.035};  // docs/dataset-format.md

/// The folders NAME0, NAME1, ... that are there, by number.
std::vector<std::string> sensor_folders(const fs::path& folder, std::string_view name) {
  std::vector<std::pair<int, std::string>> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string file_name = entry.path().filename().string();
    if (!file_name.starts_with(name) || !entry.is_directory()) continue;
    const char* const end = file_name.data() + file_name.size();
    int number = -1;
    const auto result = std::from_chars(file_name.data() + name.size(), end, number);
    if (result.ec == std::errc{} && result.ptr == end && number >= 0) found.emplace_back(number, file_name);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  names.reserve(found.size());
  for (auto& [number, file_name] : found) names.push_back(std::move(file_name));
  return names;
}

std::vector<std::string> reading_columns(int count) {
  std::vector<std::string> columns{"timestamp [ns]"};
  for (int i = 0; i < count; ++i) columns.push_back("r" + std::to_string(i) + " [m]");
  return columns;
}

const std::vector<std::string> kPoseColumns{"timestamp [ns]", "x [m]", "y [m]", "theta [rad]"};

/// A reading within the limits, inf, or nan; what is out of them is counted and taken as nan.
float checked_reading(double value, double range_min, double range_max, SensorLog& log) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  if (std::isnan(value)) return kNone;
  if (value < 0.0) return ++log.negative, kNone;
  if (value < range_min) return ++log.below_range_min, kNone;
  if (std::isinf(value)) return std::numeric_limits<float>::infinity();
  if (value > range_max) return ++log.above_range_max, kNone;
  return static_cast<float>(value);
}

/// The rows of a range finder or a sonar ring; both are a time and a list of ranges.
/// \param range_factor  by which each is multiplied before the limits are looked at
template <typename Row>
std::vector<Row> read_ranges(const fs::path& file, int sensor, int count, double range_min, double range_max,
                             SensorLog& log, double range_factor = 1.0) {
  std::vector<Row> rows;
  CsvTable table(file, reading_columns(count), "sensor.yaml tells of " + std::to_string(count) + " readings");
  while (table.next_row()) {
    Row row{.time = table.time(), .sensor = sensor, .ranges_m = std::vector<float>(static_cast<std::size_t>(count))};
    bool any = false;
    for (float& range : row.ranges_m) {
      range = checked_reading(range_factor * table.number(), range_min, range_max, log);
      any = any || !std::isnan(range);
    }
    ++(any ? log.rows : log.rows_without_value);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A pose table. A row with a nan or empty field is no measurement: it is left out and counted.
std::vector<TimedPose> read_poses(const fs::path& file, SensorLog& log) {
  std::vector<TimedPose> poses;
  CsvTable table(file, kPoseColumns);
  while (table.next_row()) {
    const Timestamp time = table.time();
    const double x = table.number(), y = table.number(), theta = table.number();
    if (std::isnan(x) || std::isnan(y) || std::isnan(theta)) {
      ++log.rows_without_value;
      continue;
    }
    if (!(std::abs(x) <= kLargestLength_m && std::abs(y) <= kLargestLength_m && std::abs(theta) <= kLargestAngle_rad))
      table.fail("expected a finite pose (within 1e6 m and 1e4 rad), found x " + std::to_string(x) + ", y " +
                 std::to_string(y) + ", theta " + std::to_string(theta));
    poses.push_back({time, {x, y, geometry::wrap_angle(theta)}});
    ++log.rows;
  }
  return poses;
}

/// \returns the line of acquisition_sensor; 0 where it is not given
int read_header(const fs::path& folder, Dataset& dataset) {
  const CheckedMap keys = load_yaml(folder / "dataset.yaml")
                              .map({"format", "name", "description", "license", "robot", "initial_pose",
                                    "initial_pose_sigma", "acquisition_sensor"});
  (void)keys.required("format").one_of({"credo-dataset/1"});
  DatasetHeader& header = dataset.header;
  header.name = fs::weakly_canonical(folder).filename().string();
  if (const auto name = keys.optional("name")) header.name = name->text();
  if (const auto description = keys.optional("description")) header.description = description->text();
  if (const auto license = keys.optional("license")) header.license = license->text();
  if (const auto robot = keys.optional("robot"))
    header.robot_radius_m = robot->map({"radius"}).required("radius").number(kPositiveLength);
  if (const auto pose = keys.optional("initial_pose")) {
    std::vector<double> sigma(std::begin(kInitialSigma), std::end(kInitialSigma));
    if (const auto given = keys.optional("initial_pose_sigma"))
      sigma = given->numbers(3, {.low = 0.0, .high = 1e3, .low_open = true});
    const Eigen::Vector3d variance(sigma[0] * sigma[0], sigma[1] * sigma[1], sigma[2] * sigma[2]);
    header.initial_pose = geometry::PoseEstimate{pose->pose(), variance.asDiagonal()};
  } else if (const auto sigma = keys.optional("initial_pose_sigma")) {
    dataset.remarks.push_back((folder / "dataset.yaml").string() + ":" + std::to_string(sigma->line()) +
                              ": initial_pose_sigma has no effect without initial_pose");
  }
  const auto sensor = keys.optional("acquisition_sensor");
  if (sensor) header.acquisition_sensor = sensor->text();
  return sensor ? sensor->line() : 0;
}

/// Only the first camera has a place in a rig; the others are read as far as they can be wrong.
void read_cameras(const fs::path& folder, Dataset& dataset) {
  for (const std::string& name : sensor_folders(folder, "camera")) {
    const sensors::OmniCamera camera = read_camera(folder / name / "sensor.yaml", dataset.remarks);
    SensorLog log{.sensor = name};
    std::vector<ImageFile> images;
    CsvTable table(folder / name / "data.csv", {"timestamp [ns]", "filename"});
    while (table.next_row()) {
      ImageFile image{.time = table.time(), .file = {}};
      const std::string_view file_name = table.text();
      if (!file_name.empty() && file_name != "nan") {
        image.file = folder / name / "data" / file_name;
        if (!fs::exists(image.file))
          table.fail("filename: expected an image of the folder data, found " + image.file.string() +
                     ", which is not there");
        image.listed_in = folder / name / "data.csv";
        image.line = table.line();
        with_row(image.listed_in, image.line, [&] { check_image_file(image.file, camera.width_px, camera.height_px); });
      }
      ++(image.file.empty() ? log.rows_without_value : log.rows);
      images.push_back(std::move(image));
    }
    dataset.log.push_back(log);
    if (dataset.header.rig.camera) {
      dataset.remarks.push_back(name + " is not used: one camera is");
      continue;
    }
    dataset.header.rig.camera = camera;
    dataset.camera_name = name;
    dataset.images = std::move(images);
  }
}

void read_range_finders(const fs::path& folder, Dataset& dataset) {
  for (const std::string& name : sensor_folders(folder, "range")) {
    const sensors::RangeFinder finder = read_range_finder(folder / name / "sensor.yaml", dataset.remarks);
    SensorLog log{.sensor = name};
    const int index = static_cast<int>(dataset.scans.size());
    dataset.scans.push_back(read_ranges<sensors::RangeScan>(folder / name / "data.csv", index, finder.count,
                                                            finder.range_min_m, finder.range_max_m, log));
    if (finder.angle_increment_rad < 0.0)
      for (sensors::RangeScan& scan : dataset.scans.back()) std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
    dataset.header.rig.range_finders.push_back(counter_clockwise(finder));
    dataset.range_finder_names.push_back(name);
    dataset.log.push_back(log);
  }
}

void read_sonar_rings(const fs::path& folder, Dataset& dataset) {
  for (const std::string& name : sensor_folders(folder, "sonar")) {
    const auto [ring, range_factor] = read_sonar_ring(folder / name / "sensor.yaml", dataset.remarks);
    SensorLog log{.sensor = name};
    const int index = static_cast<int>(dataset.sonar.size());
    dataset.sonar.push_back(read_ranges<sensors::SonarSweep>(folder / name / "data.csv", index,
                                                             static_cast<int>(ring.T_base_transducer.size()),
                                                             ring.range_min_m, ring.range_max_m, log, range_factor));
    dataset.header.rig.sonar_rings.push_back(ring);
    dataset.sonar_ring_names.push_back(name);
    dataset.log.push_back(log);
  }
}

void read_odometry(const fs::path& folder, Dataset& dataset) {
  for (const std::string& name : sensor_folders(folder, "odometry")) {
    const sensors::OdometryNoise noise = read_odometry_noise(folder / name / "sensor.yaml", dataset.remarks);
    SensorLog log{.sensor = name};
    const std::vector<TimedPose> rows = read_poses(folder / name / "data.csv", log);
    dataset.log.push_back(log);
    if (dataset.header.rig.odometry) {
      dataset.remarks.push_back(name + " is not used: one odometry is");
      continue;
    }
    dataset.header.rig.odometry = noise;
    for (const TimedPose& row : rows) dataset.odometry.push_back({row.time, row.pose});
  }
}

void read_truth(const fs::path& folder, Dataset& dataset) {
  if (const fs::path file = folder / "groundtruth0" / "data.csv"; fs::exists(file)) {
    SensorLog log{.sensor = "groundtruth0"};
    dataset.truth = read_poses(file, log);
    dataset.log.push_back(log);
  }
  if (const fs::path file = folder / "groundtruth0" / "verticals.csv"; fs::exists(file)) {
    CsvTable table(file, {"timestamp [ns]", "azimuth [rad]", "visible_share", "contrast"});
    while (table.next_row()) {
      TrueVertical vertical{.time = table.time()};
      vertical.azimuth_rad = geometry::wrap_angle(table.finite(-kLargestAngle_rad, kLargestAngle_rad));
      vertical.visible_share = table.finite(0.0, 1.0);
      vertical.contrast = table.finite(-255.0, 255.0);
      dataset.true_verticals.push_back(vertical);
    }
  }
  if (const fs::path file = folder / "events.csv"; fs::exists(file)) {
    dataset.events_recorded = true;
    CsvTable table(file, {"timestamp [ns]", "event"});
    while (table.next_row()) {
      Event event{.time = table.time(), .name = {}};
      event.name = std::string(table.rest());
      if (event.name.empty()) table.fail("event: expected what happened, found nothing");
      dataset.events.push_back(std::move(event));
    }
  }
  if (const fs::path file = folder / "truth_map.yaml"; fs::exists(file)) dataset.truth_map = file;
}

/// Folders that hold a sensor.yaml but have no name of a sensor are most likely misspelt.
void remark_on_strange_folders(const fs::path& folder, Dataset& dataset) {
  std::vector<std::string> known;
  for (const SensorLog& log : dataset.log) known.push_back(log.sensor);
  std::vector<std::string> strange;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && fs::exists(entry.path() / "sensor.yaml") &&
        std::find(known.begin(), known.end(), name) == known.end())
      strange.push_back(name);
  }
  std::sort(strange.begin(), strange.end());
  for (const std::string& name : strange)
    dataset.remarks.push_back("the folder " + name +
                              " is not used: sensors are camera0, range0, sonar0, odometry0 and so on");
}

/// The default is the first sensor with rows, cameras before range finders before sonars.
/// \param line  of acquisition_sensor in dataset.yaml
void settle_acquisition_sensor(const fs::path& folder, int line, Dataset& dataset) {
  std::vector<std::string> able;
  if (!dataset.images.empty()) able.push_back(dataset.camera_name);
  for (std::size_t i = 0; i < dataset.scans.size(); ++i)
    if (!dataset.scans[i].empty()) able.push_back(dataset.range_finder_names[i]);
  for (std::size_t i = 0; i < dataset.sonar.size(); ++i)
    if (!dataset.sonar[i].empty()) able.push_back(dataset.sonar_ring_names[i]);
  if (able.empty())
    throw FormatError(folder, 0,
                      "no camera, range finder or sonar has a row; expected at least one of camera0, range0 "
                      "and sonar0 with data");
  std::string& sensor = dataset.header.acquisition_sensor;
  if (sensor.empty()) sensor = able.front();
  if (std::find(able.begin(), able.end(), sensor) != able.end()) return;
  std::string names;
  for (const std::string& name : able) names += (names.empty() ? "" : ", ") + name;
  throw FormatError(
      folder / "dataset.yaml", line,
      "acquisition_sensor: expected a sensor that is there and has rows (" + names + "), found '" + sensor + "'");
}

}  // namespace

Eigen::Matrix3d default_initial_covariance() {
  return Eigen::Vector3d(std::begin(kInitialSigma)).cwiseAbs2().asDiagonal();
}

bool Dataset::is_dataset(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "dataset.yaml", error);
}

Dataset Dataset::open(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw FormatError(folder, 0, "there is no such folder");
  if (!fs::is_directory(folder, error)) throw FormatError(folder, 0, "is a file; expected the folder of a dataset");
  if (!is_dataset(folder)) throw FormatError(folder, 0, "holds no dataset.yaml; expected the folder of a dataset");
  Dataset dataset;
  dataset.folder = folder;
  const int line_of_acquisition_sensor = read_header(folder, dataset);
  read_cameras(folder, dataset);
  read_range_finders(folder, dataset);
  read_sonar_rings(folder, dataset);
  read_odometry(folder, dataset);
  if (const fs::path plan = folder / "floor_plan.yaml"; fs::exists(plan))
    dataset.header.floor_plan = read_floor_plan(plan);
  read_truth(folder, dataset);
  settle_acquisition_sensor(folder, line_of_acquisition_sensor, dataset);
  remark_on_strange_folders(folder, dataset);
  return dataset;
}

}  // namespace credo::datasets
