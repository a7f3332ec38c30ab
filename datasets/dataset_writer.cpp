// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/dataset_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

#include "datasets/floor_plan_file.hpp"
#include "datasets/format_error.hpp"
#include "datasets/number_text.hpp"
#include "datasets/sensor_yaml.hpp"
#include "datasets/staged_folder.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

constexpr int kRangeDecimals = 4;
constexpr int kPoseDecimals = 6;
constexpr int kAngleDecimals = 9;

/// A data.csv that is being written.
class Table {
 public:
  Table(const fs::path& file, const std::string& header) : file_(file), out_(file, std::ios::binary) {
    out_ << header << '\n';
    require_written();
  }

  void begin_row(Timestamp time) {
    if (has_time_ && time < last_time_)
      throw std::invalid_argument(file_.string() + ": the time " + std::to_string(time) + " ns comes after " +
                                  std::to_string(last_time_) + " ns: add rows in order of time");
    has_time_ = true;
    last_time_ = time;
    row_ = std::to_string(time);
  }
  void add(double value, int decimals) {
    row_ += ',';
    append_fixed(row_, value, decimals);
  }
  void add(std::string_view text) { (row_ += ',') += text; }
  void end_row() {
    row_ += '\n';
    out_.write(row_.data(), static_cast<std::streamsize>(row_.size()));
    require_written();
  }
  void close() {
    out_.close();
    require_written();
  }

 private:
  void require_written() const {
    if (!out_) throw std::runtime_error(file_.string() + ": cannot be written; is there space left?");
  }

  fs::path file_;
  std::ofstream out_;
  std::string row_;
  bool has_time_ = false;
  Timestamp last_time_ = 0;
};

std::string range_header(std::size_t count) {
  std::string header = "#timestamp [ns]";
  for (std::size_t i = 0; i < count; ++i) header += ",r" + std::to_string(i) + " [m]";
  return header;
}

constexpr const char* kPoseHeader = "#timestamp [ns],x [m],y [m],theta [rad]";

/// A line of text as a YAML scalar, whatever is in it.
std::string quoted_scalar(std::string_view text) {
  std::string scalar = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') scalar += '\\';
    scalar += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return scalar + '"';
}

std::string pose_list(double x, double y, double theta) {
  std::string text = "[";
  append_fixed(text, x, kPoseDecimals);
  append_fixed(text += ", ", y, kPoseDecimals);
  append_fixed(text += ", ", theta, kAngleDecimals);
  return text + "]";
}

std::string header_text(const DatasetHeader& header) {
  std::string text = "format: credo-dataset/1\nname: " + quoted_scalar(header.name) + "\n";
  if (!header.description.empty()) text += "description: " + quoted_scalar(header.description) + "\n";
  if (!header.license.empty()) text += "license: " + quoted_scalar(header.license) + "\n";
  append_shortest(text += "robot: {radius: ", header.robot_radius_m);
  text += "}\n";
  if (header.initial_pose) {
    const auto& [pose, covariance] = *header.initial_pose;
    text += "initial_pose: " + pose_list(pose.x, pose.y, pose.theta) + "\n";
    text += "initial_pose_sigma: " +
            pose_list(std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)), std::sqrt(covariance(2, 2))) + "\n";
  }
  if (!header.acquisition_sensor.empty()) text += "acquisition_sensor: " + header.acquisition_sensor + "\n";
  return text;
}

bool finite(const geometry::Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

/// Only a dataset is replaced, and only if that is allowed.
StagedFolder::RequireReplaceable replaceable(bool overwrite) {
  return [overwrite](const fs::path& there) {
    if (!overwrite)
      throw std::runtime_error(there.string() +
                               ": is there already: choose another folder, or replace it with --force");
    if (!Dataset::is_dataset(there))
      throw std::runtime_error(there.string() +
                               ": is there and is no dataset: it is not replaced; choose another folder");
  };
}

}  // namespace

struct DatasetWriter::State {
  StagedFolder staged;
  fs::path working;
  DatasetHeader header;
  WriterParams params;
  std::optional<Table> images, odometry, truth, verticals, events;
  std::vector<Table> scans, sonar;
  std::string last_image_name;
  int same_name = 0;

  State(const fs::path& target, const DatasetHeader& about, const WriterParams& given)
      : staged(target, replaceable(given.overwrite)), working(staged.path()), header(about), params(given) {
    write_head();
  }

  template <typename Sensor>
  fs::path make_sensor(const std::string& name, const Sensor& sensor) {
    const fs::path folder = working / name;
    fs::create_directory(folder);
    std::ofstream out(folder / "sensor.yaml", std::ios::binary);
    write_sensor_yaml(out, sensor);
    out.close();
    if (!out) throw std::runtime_error((folder / "sensor.yaml").string() + ": cannot be written; is there space left?");
    return folder / "data.csv";
  }

  void write_image(const fs::path& file, const cv::Mat& pixels) const {
    std::vector<unsigned char> png;
    if (!cv::imencode(".png", pixels, png, {cv::IMWRITE_PNG_COMPRESSION, params.png_compression}))
      throw std::runtime_error(file.string() + ": the image cannot be encoded");
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written; is there space left?");
  }

  /// Writes all that is known before the first row, and reads the sensors back: what a reader refuses is not written.
  void write_head() {
    const sensors::Rig& rig = header.rig;
    std::ofstream out(working / "dataset.yaml", std::ios::binary);
    out << header_text(header);
    out.close();
    if (!out) throw std::runtime_error(working.string() + ": cannot be written; is there space left?");
    if (header.floor_plan) write_floor_plan(working / "floor_plan.yaml", *header.floor_plan);
    if (rig.camera) {
      images.emplace(make_sensor("camera0", *rig.camera), "#timestamp [ns],filename");
      fs::create_directory(working / "camera0" / "data");
      if (!rig.camera->mask.empty()) write_image(working / "camera0" / "mask.png", rig.camera->mask);
    }
    for (std::size_t i = 0; i < rig.range_finders.size(); ++i)
      scans.emplace_back(make_sensor("range" + std::to_string(i), rig.range_finders[i]),
                         range_header(static_cast<std::size_t>(std::max(rig.range_finders[i].count, 0))));
    for (std::size_t i = 0; i < rig.sonar_rings.size(); ++i)
      sonar.emplace_back(make_sensor("sonar" + std::to_string(i), rig.sonar_rings[i]),
                         range_header(rig.sonar_rings[i].T_base_transducer.size()));
    if (rig.odometry) odometry.emplace(make_sensor("odometry0", *rig.odometry), kPoseHeader);
    read_back();
  }

  void read_back() const {
    Remarks ignored;
    const auto yaml = [this](const std::string& name) { return working / name / "sensor.yaml"; };
    try {
      if (header.rig.camera) (void)read_camera(yaml("camera0"), ignored);
      for (std::size_t i = 0; i < scans.size(); ++i)
        (void)read_range_finder(yaml("range" + std::to_string(i)), ignored);
      for (std::size_t i = 0; i < sonar.size(); ++i) (void)read_sonar_ring(yaml("sonar" + std::to_string(i)), ignored);
      if (header.rig.odometry) (void)read_odometry_noise(yaml("odometry0"), ignored);
      if (header.floor_plan) (void)read_floor_plan(working / "floor_plan.yaml");
    } catch (const FormatError& error) {
      throw std::invalid_argument(std::string("the dataset to be written would not be accepted: ") + error.what());
    }
  }

  void add_ranges(std::vector<Table>& tables, const char* kind, Timestamp time, int sensor, std::size_t count,
                  const std::vector<float>& ranges_m) {
    if (count != ranges_m.size())
      throw std::invalid_argument(std::string(kind) + std::to_string(sensor) + ": expected " + std::to_string(count) +
                                  " readings, found " + std::to_string(ranges_m.size()));
    Table& table = tables[static_cast<std::size_t>(sensor)];
    table.begin_row(time);
    for (const float range : ranges_m) table.add(range, kRangeDecimals);
    table.end_row();
  }

  void close() {
    for (auto* table : {&images, &odometry, &truth, &verticals, &events})
      if (*table) (*table)->close();
    for (Table& table : scans) table.close();
    for (Table& table : sonar) table.close();
  }
};

namespace {

void add_pose(Table& table, Timestamp time, const geometry::Pose2& pose) {
  if (!finite(pose)) throw std::invalid_argument("the pose at " + std::to_string(time) + " ns is not finite");
  table.begin_row(time);
  table.add(pose.x, kPoseDecimals);
  table.add(pose.y, kPoseDecimals);
  table.add(pose.theta, kAngleDecimals);
  table.end_row();
}

[[noreturn]] void fail_no_sensor(const char* kind, int sensor) {
  throw std::invalid_argument(std::string("the rig has no ") + kind + std::to_string(sensor));
}

}  // namespace

DatasetWriter::DatasetWriter(const fs::path& target, const DatasetHeader& header, const WriterParams& params)
    : state_(std::make_unique<State>(target, header, params)) {}
DatasetWriter::~DatasetWriter() = default;
DatasetWriter::DatasetWriter(DatasetWriter&&) noexcept = default;
DatasetWriter& DatasetWriter::operator=(DatasetWriter&&) noexcept = default;

const fs::path& DatasetWriter::working_folder() const { return state_->working; }

void DatasetWriter::add_image(Timestamp time, const cv::Mat& pixels) {
  if (!state_->images) fail_no_sensor("camera", 0);
  const sensors::OmniCamera& camera = *state_->header.rig.camera;
  const bool fits = (pixels.type() == CV_8UC1 || pixels.type() == CV_8UC3) && pixels.cols == camera.width_px &&
                    pixels.rows == camera.height_px;
  if (!pixels.empty() && !fits)
    throw std::invalid_argument("expected an 8-bit image of " + std::to_string(camera.width_px) + " x " +
                                std::to_string(camera.height_px) + " px, found one of " + std::to_string(pixels.cols) +
                                " x " + std::to_string(pixels.rows));
  state_->images->begin_row(time);
  std::string name;
  if (!pixels.empty()) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%020lld", static_cast<long long>(time));
    name = digits.data();
    state_->same_name = name == state_->last_image_name ? state_->same_name + 1 : 0;
    state_->last_image_name = name;
    if (state_->same_name > 0) name += "_" + std::to_string(state_->same_name);
    name += ".png";
    state_->write_image(state_->working / "camera0" / "data" / name, pixels);
  }
  state_->images->add(name);
  state_->images->end_row();
}

void DatasetWriter::add_scan(const sensors::RangeScan& scan) {
  const auto& finders = state_->header.rig.range_finders;
  if (scan.sensor < 0 || static_cast<std::size_t>(scan.sensor) >= finders.size()) fail_no_sensor("range", scan.sensor);
  const auto count = static_cast<std::size_t>(finders[static_cast<std::size_t>(scan.sensor)].count);
  state_->add_ranges(state_->scans, "range", scan.time, scan.sensor, count, scan.ranges_m);
}

void DatasetWriter::add_sonar(const sensors::SonarSweep& sweep) {
  const auto& rings = state_->header.rig.sonar_rings;
  if (sweep.sensor < 0 || static_cast<std::size_t>(sweep.sensor) >= rings.size()) fail_no_sensor("sonar", sweep.sensor);
  const std::size_t count = rings[static_cast<std::size_t>(sweep.sensor)].T_base_transducer.size();
  state_->add_ranges(state_->sonar, "sonar", sweep.time, sweep.sensor, count, sweep.ranges_m);
}

void DatasetWriter::add_odometry(const sensors::OdometryReading& reading) {
  if (!state_->odometry) fail_no_sensor("odometry", 0);
  add_pose(*state_->odometry, reading.time, reading.T_odom_base);
}

void DatasetWriter::add_truth(const TimedPose& T_map_base) {
  if (!state_->truth) {
    fs::create_directory(state_->working / "groundtruth0");
    state_->truth.emplace(state_->working / "groundtruth0" / "data.csv", kPoseHeader);
  }
  add_pose(*state_->truth, T_map_base.time, T_map_base.pose);
}

void DatasetWriter::add_true_vertical(const TrueVertical& vertical) {
  if (!std::isfinite(vertical.azimuth_rad) || !std::isfinite(vertical.visible_share) ||
      !std::isfinite(vertical.contrast))
    throw std::invalid_argument("the vertical edge at " + std::to_string(vertical.time) + " ns is not finite");
  if (vertical.visible_share < 0.0 || vertical.visible_share > 1.0)
    throw std::invalid_argument("the visible share of a vertical edge is " + std::to_string(vertical.visible_share) +
                                "; expected 0 to 1");
  if (!state_->verticals) {
    fs::create_directories(state_->working / "groundtruth0");
    state_->verticals.emplace(state_->working / "groundtruth0" / "verticals.csv",
                              "#timestamp [ns],azimuth [rad],visible_share,contrast");
  }
  state_->verticals->begin_row(vertical.time);
  state_->verticals->add(vertical.azimuth_rad, kAngleDecimals);
  state_->verticals->add(vertical.visible_share, kRangeDecimals);
  state_->verticals->add(vertical.contrast, kRangeDecimals);
  state_->verticals->end_row();
}

void DatasetWriter::add_event(const Event& event) {
  if (event.name.empty() || event.name.find('\n') != std::string::npos)
    throw std::invalid_argument("an event needs a name of one line");
  record_events();
  state_->events->begin_row(event.time);
  state_->events->add(event.name);
  state_->events->end_row();
}

void DatasetWriter::record_events() {
  if (!state_->events) state_->events.emplace(state_->working / "events.csv", "#timestamp [ns],event");
}

void DatasetWriter::finish() {
  state_->close();
  state_->staged.commit();
}

}  // namespace credo::datasets
