// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/spatial_trajectory.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "datasets/checked_yaml.hpp"
#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"
#include "datasets/trajectory.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

/// A row of a text file that holds values.
struct Row {
  int line = 0;
  std::vector<std::string_view> fields;
};

/// A text file without its comments and empty lines.
struct PoseRows {
  std::string_view header;  ///< the first comment, without its '#'
  bool commas = false;      ///< in the first row
  std::vector<Row> rows;
};

/// Between commas where there is one, else between spaces.
std::vector<std::string_view> fields_of(std::string_view text) {
  const std::string_view separators = text.find(',') != std::string_view::npos ? "," : " \t";
  std::vector<std::string_view> fields;
  while (!text.empty()) {
    const std::size_t stop = std::min(text.find_first_of(separators), text.size());
    fields.push_back(trimmed(text.substr(0, stop)));
    text = trimmed(text.substr(std::min(stop + 1, text.size())));
  }
  return fields;
}

PoseRows pose_rows_of(std::string_view content) {
  PoseRows table;
  for (int line = 1; !content.empty(); ++line) {
    const std::size_t end = std::min(content.find('\n'), content.size());
    const std::string_view text = trimmed(content.substr(0, end));
    content.remove_prefix(std::min(end + 1, content.size()));
    if (text.empty()) continue;
    if (text.front() == '#') {
      if (table.header.empty()) table.header = trimmed(text.substr(1));
      continue;
    }
    if (table.rows.empty()) table.commas = text.find(',') != std::string_view::npos;
    table.rows.push_back({line, fields_of(text)});
  }
  return table;
}

double number(const fs::path& file, const Row& row, std::size_t column) {
  std::string_view text = row.fields[column];
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= kLargestLength_m))
    throw FormatError(file, row.line,
                      "column " + std::to_string(column + 1) + ": expected a finite number (within 1e6), found " +
                          in_quotes(row.fields[column]));
  return value;
}

Timestamp nanoseconds(const fs::path& file, const Row& row) {
  const std::string_view text = row.fields.front();
  Timestamp time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || end != text.data() + text.size() || !sensors::is_usable(time))
    throw FormatError(file, row.line, "expected a time in whole nanoseconds, found " + in_quotes(text));
  return time;
}

Timestamp seconds(const fs::path& file, const Row& row) {
  try {
    return parse_seconds(row.fields.front());
  } catch (const std::invalid_argument& error) {
    throw FormatError(file, row.line, error.what());
  }
}

Eigen::Matrix3d rotation_of(const fs::path& file, const Row& row, double w, double x, double y, double z) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1.0) <= 0.01))
    throw FormatError(file, row.line, "expected a quaternion of norm 1, found norm " + std::to_string(q.norm()));
  return q.normalized().toRotationMatrix();
}

StampedPose tum_pose(const fs::path& file, const Row& row) {
  const auto v = [&](std::size_t column) { return number(file, row, column); };
  return {.time = seconds(file, row),
          .rotation = rotation_of(file, row, v(7), v(4), v(5), v(6)),
          .position = {v(1), v(2), v(3)}};
}

StampedPose euroc_pose(const fs::path& file, const Row& row) {
  const auto v = [&](std::size_t column) { return number(file, row, column); };
  return {.time = nanoseconds(file, row),
          .rotation = rotation_of(file, row, v(4), v(5), v(6), v(7)),
          .position = {v(1), v(2), v(3)}};
}

/// Row-major [R | t].
StampedPose kitti_pose(const fs::path& file, const Row& row, Timestamp index) {
  StampedPose pose{.time = index};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto first = static_cast<std::size_t>(4 * i);
    for (Eigen::Index j = 0; j < 3; ++j) pose.rotation(i, j) = number(file, row, first + static_cast<std::size_t>(j));
    pose.position[i] = number(file, row, first + 3);
  }
  if ((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.01)
    throw FormatError(file, row.line,
                      "expected the first three rows of a rigid transform, found a matrix that is no rotation");
  return pose;
}

StampedPose table_pose(const fs::path& file, const Row& row) {
  return lift(nanoseconds(file, row),
              {number(file, row, 1), number(file, row, 2), geometry::wrap_angle(number(file, row, 3))});
}

StampedPose pose_of(const fs::path& file, const Row& row, TrajectoryFormat format, std::size_t index) {
  switch (format) {
    case TrajectoryFormat::kTum: return tum_pose(file, row);
    case TrajectoryFormat::kKitti: return kitti_pose(file, row, static_cast<Timestamp>(index));
    case TrajectoryFormat::kEuroc: return euroc_pose(file, row);
    case TrajectoryFormat::kPoseTable: break;
  }
  return table_pose(file, row);
}

/// A csv whose header says that its fourth column is a heading holds planar poses; without a header, four columns do.
TrajectoryFormat format_of(const fs::path& file, const PoseRows& table) {
  const Row& row = table.rows.front();
  const std::size_t columns = row.fields.size();
  if (table.commas) {
    const std::vector<std::string_view> names = fields_of(table.header);
    const bool heading = names.size() >= 4 && names[3].starts_with("theta");
    if (columns == 4 || (columns > 4 && heading)) return TrajectoryFormat::kPoseTable;
    const bool whole = row.fields.front().find_first_of(".eE") == std::string_view::npos;
    if (columns >= 8 && whole) return TrajectoryFormat::kEuroc;
  }
  if (columns == 8) return TrajectoryFormat::kTum;
  if (columns == 12) return TrajectoryFormat::kKitti;
  throw FormatError(file, row.line,
                    "no known trajectory: expected 8 columns (TUM: timestamp tx ty tz qx qy qz qw), 12 (KITTI), or a "
                    "csv of times in nanoseconds and poses (EuRoC, or x, y, theta); found " +
                        std::to_string(columns) + " columns");
}

/// The last columns of a pose table are not read, and may be empty.
void check_columns(const fs::path& file, const Row& first, const Row& row, TrajectoryFormat format) {
  if (row.fields.size() == first.fields.size()) return;
  if (format == TrajectoryFormat::kPoseTable && row.fields.size() >= 4) return;
  throw FormatError(file, row.line,
                    "expected " + std::to_string(first.fields.size()) + " columns, as in line " +
                        std::to_string(first.line) + ", found " + std::to_string(row.fields.size()));
}

fs::path file_in(const fs::path& folder) {
  if (Dataset::is_dataset(folder) && !fs::is_regular_file(folder / "groundtruth0/data.csv"))
    throw FormatError(folder, 0, "this dataset holds no groundtruth0/data.csv; there is no truth to read");
  for (const char* name : {"groundtruth0/data.csv", "localization.csv", "trajectory.tum", "data.csv"})
    if (fs::is_regular_file(folder / name)) return folder / name;
  throw FormatError(folder, 0,
                    "holds no trajectory: expected groundtruth0/data.csv (a dataset with ground truth) or "
                    "localization.csv (the results of credo run)");
}

}  // namespace

StampedPose lift(Timestamp time, const geometry::Pose2& pose) {
  StampedPose lifted{.time = time};
  lifted.rotation.topLeftCorner<2, 2>() = pose.rotation();
  lifted.position.head<2>() = pose.translation();
  return lifted;
}

geometry::Pose2 flatten(const StampedPose& pose) {
  return {pose.position.x(), pose.position.y(), std::atan2(pose.rotation(1, 0), pose.rotation(0, 0))};
}

SpatialTrajectory read_spatial_trajectory(const fs::path& path) {
  SpatialTrajectory trajectory;
  trajectory.file = fs::is_directory(path) ? file_in(path) : path;
  const fs::path& file = trajectory.file;
  const std::string content = read_text_file(file);
  const PoseRows table = pose_rows_of(content);
  if (table.rows.empty()) throw FormatError(file, 0, "holds no pose; expected a trajectory");
  trajectory.format = format_of(file, table);
  trajectory.has_times = trajectory.format != TrajectoryFormat::kKitti;
  for (const Row& row : table.rows) {
    check_columns(file, table.rows.front(), row, trajectory.format);
    trajectory.poses.push_back(pose_of(file, row, trajectory.format, trajectory.poses.size()));
    trajectory.lines.push_back(row.line);
  }
  return trajectory;
}

}  // namespace credo::datasets
