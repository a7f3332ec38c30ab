// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/trajectory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "datasets/checked_yaml.hpp"
#include "datasets/format_error.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

constexpr Timestamp kNanoseconds = 1'000'000'000;
constexpr int kTumDecimals = 9;

/// A row of a text file that holds values.
struct Row {
  int line = 0;
  std::vector<std::string_view> fields;
};

/// The rows of a file, without comments and empty lines; fields between commas where there is one, else between spaces.
std::vector<Row> rows_of(std::string_view content) {
  std::vector<Row> rows;
  int line = 0;
  while (!content.empty()) {
    const std::size_t end = std::min(content.find('\n'), content.size());
    std::string_view text = trimmed(content.substr(0, end));
    content.remove_prefix(std::min(end + 1, content.size()));
    ++line;
    if (text.empty() || text.front() == '#') continue;
    const std::string_view separators = text.find(',') != std::string_view::npos ? "," : " \t";
    Row row{line, {}};
    while (!text.empty()) {
      const std::size_t stop = std::min(text.find_first_of(separators), text.size());
      row.fields.push_back(trimmed(text.substr(0, stop)));
      text = trimmed(text.substr(std::min(stop + 1, text.size())));
    }
    rows.push_back(std::move(row));
  }
  return rows;
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
  if (error != std::errc{} || end != text.data() + text.size() || std::abs(time) > sensors::kLatestTime)
    throw FormatError(file, row.line, "expected a time in whole nanoseconds, found " + in_quotes(text));
  return time;
}

/// The heading of the x axis in the plane z = 0.
double heading(const fs::path& file, const Row& row, double w, double x, double y, double z) {
  const double norm = w * w + x * x + y * y + z * z;
  if (norm < 1e-6) throw FormatError(file, row.line, "the quaternion has no length; expected one of length 1");
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

TimedPose tum_pose(const fs::path& file, const Row& row) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = number(file, row, i + 1);
  Timestamp time = 0;
  try {
    time = parse_seconds(row.fields.front());
  } catch (const std::invalid_argument& error) {
    throw FormatError(file, row.line, error.what());
  }
  return {time, {v[0], v[1], heading(file, row, v[6], v[3], v[4], v[5])}};
}

TimedPose euroc_pose(const fs::path& file, const Row& row) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = number(file, row, i + 1);
  return {nanoseconds(file, row), {v[0], v[1], heading(file, row, v[3], v[4], v[5], v[6])}};
}

TimedPose table_pose(const fs::path& file, const Row& row) {
  return {nanoseconds(file, row),
          {number(file, row, 1), number(file, row, 2), geometry::wrap_angle(number(file, row, 3))}};
}

/// Row-major [R | t]; see read_trajectory() for the plane.
std::vector<TimedPose> kitti_poses(const fs::path& file, const std::vector<Row>& rows) {
  std::vector<std::array<double, 12>> transforms;
  bool upright = true;
  for (const Row& row : rows) {
    std::array<double, 12>& m = transforms.emplace_back();
    for (std::size_t i = 0; i < m.size(); ++i) m[i] = number(file, row, i);
    upright = upright && std::abs(m[8]) < 1e-6 && std::abs(m[9]) < 1e-6 && std::abs(m[10] - 1.0) < 1e-6 &&
              std::abs(m[11]) < 1e-6;
  }
  std::vector<TimedPose> poses;
  for (const std::array<double, 12>& m : transforms) {
    const Timestamp time = static_cast<Timestamp>(poses.size()) * kNanoseconds;
    if (upright)
      poses.push_back({time, {m[3], m[7], std::atan2(m[4], m[0])}});
    else
      poses.push_back({time, {m[11], -m[3], std::atan2(-m[2], m[10])}});
  }
  return poses;
}

/// \param header  the first line of the file
TrajectoryFormat format_of(const fs::path& file, const Row& row, std::string_view header) {
  const std::size_t columns = row.fields.size();
  const bool nanoseconds_named = header.find("[ns]") != std::string_view::npos;
  if (header.starts_with("#timestamp [ns],x [m],y [m],theta [rad]")) return TrajectoryFormat::kPoseTable;
  if (columns == 12) return TrajectoryFormat::kKitti;
  const bool whole = row.fields.front().find_first_of(".eE") == std::string_view::npos;
  if ((columns == 8 || columns == 17) && whole && (nanoseconds_named || columns == 17)) return TrajectoryFormat::kEuroc;
  if (columns == 8) return TrajectoryFormat::kTum;
  throw FormatError(
      file, row.line,
      "no known trajectory: expected 8 columns (TUM: timestamp tx ty tz qx qy qz qw), 12 (KITTI), 8 or 17 "
      "behind a header in nanoseconds (EuRoC), or the header '#timestamp [ns],x [m],y [m],theta [rad]'; "
      "found " +
          std::to_string(columns) + " columns");
}

void check_columns(const fs::path& file, const Row& first, const Row& row) {
  if (row.fields.size() != first.fields.size())
    throw FormatError(file, row.line,
                      "expected " + std::to_string(first.fields.size()) + " columns, as in line " +
                          std::to_string(first.line) + ", found " + std::to_string(row.fields.size()));
}

Trajectory read_file(const fs::path& file) {
  const std::string content = read_text_file(file);
  const std::vector<Row> rows = rows_of(content);
  if (rows.empty()) throw FormatError(file, 0, "holds no pose; expected a trajectory");
  const std::string_view header = trimmed(std::string_view(content).substr(0, content.find('\n')));
  Trajectory trajectory;
  trajectory.format = format_of(file, rows.front(), header);
  for (const Row& row : rows) check_columns(file, rows.front(), row);
  if (trajectory.format == TrajectoryFormat::kKitti) {
    trajectory.has_times = false;
    trajectory.poses = kitti_poses(file, rows);
    return trajectory;
  }
  for (const Row& row : rows) {
    const TimedPose pose = trajectory.format == TrajectoryFormat::kTum     ? tum_pose(file, row)
                           : trajectory.format == TrajectoryFormat::kEuroc ? euroc_pose(file, row)
                                                                           : table_pose(file, row);
    if (!trajectory.poses.empty() && pose.time < trajectory.poses.back().time)
      throw FormatError(file, row.line,
                        "the time " + to_seconds(pose.time) + " s comes after " +
                            to_seconds(trajectory.poses.back().time) + " s: expected rows in order of time");
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

}  // namespace

const char* to_string(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::kTum: return "TUM trajectory";
    case TrajectoryFormat::kKitti: return "KITTI poses";
    case TrajectoryFormat::kEuroc: return "EuRoC csv";
    case TrajectoryFormat::kPoseTable: return "pose table";
    case TrajectoryFormat::kDataset: return "dataset";
    case TrajectoryFormat::kResults: return "results";
  }
  return "?";
}

Trajectory read_trajectory(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return read_file(path);
  const bool is_dataset = Dataset::is_dataset(path);
  const fs::path file = is_dataset ? path / "groundtruth0" / "data.csv" : path / "trajectory.tum";
  if (!fs::exists(file, error))
    throw FormatError(path, 0,
                      is_dataset ? "this dataset holds no groundtruth0/data.csv; there is no truth to read"
                                 : "holds neither a dataset.yaml nor a trajectory.tum; expected a trajectory");
  Trajectory trajectory = read_file(file);
  trajectory.format = is_dataset ? TrajectoryFormat::kDataset : TrajectoryFormat::kResults;
  return trajectory;
}

std::string to_seconds(Timestamp time) {
  const std::uint64_t magnitude = time < 0 ? ~static_cast<std::uint64_t>(time) + 1 : static_cast<std::uint64_t>(time);
  const std::string fraction = std::to_string(magnitude % kNanoseconds);
  return (time < 0 ? "-" : "") + std::to_string(magnitude / kNanoseconds) + "." +
         std::string(9 - fraction.size(), '0') + fraction;
}

Timestamp parse_seconds(std::string_view text) {
  const auto fail = [text] { return std::invalid_argument("expected a time in seconds, found " + in_quotes(text)); };
  const bool negative = text.starts_with('-');
  std::string_view digits = text.substr(negative || text.starts_with('+') ? 1 : 0);
  if (digits.find_first_of("eE") != std::string_view::npos) {
    double seconds = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
    if (error != std::errc{} || end != digits.data() + digits.size() || !(seconds <= 4e9)) throw fail();
    return sensors::from_seconds(negative ? -seconds : seconds);
  }
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::string_view whole = digits.substr(0, point);
  const std::string_view fraction = digits.substr(std::min(point + 1, digits.size()));
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (whole.size() + fraction.size() == 0 || whole.size() > 10 || !std::all_of(whole.begin(), whole.end(), is_digit) ||
      !std::all_of(fraction.begin(), fraction.end(), is_digit))
    throw fail();
  Timestamp time = 0;
  for (const char c : whole) time = 10 * time + (c - '0');
  if (time > sensors::kLatestTime / kNanoseconds - 1) throw fail();
  for (std::size_t i = 0; i < 9; ++i) time = 10 * time + (i < fraction.size() ? fraction[i] - '0' : 0);
  if (fraction.size() > 9 && fraction[9] >= '5') ++time;
  return negative ? -time : time;
}

void write_tum(std::ostream& out, std::span<const TimedPose> poses) {
  std::string text;
  for (const TimedPose& row : poses) {
    text = to_seconds(row.time);
    const double half = 0.5 * geometry::wrap_angle(row.pose.theta);
    for (const double value : {row.pose.x, row.pose.y, 0.0, 0.0, 0.0, std::sin(half), std::cos(half)}) {
      text += ' ';
      append_fixed(text, value, kTumDecimals);
    }
    text += '\n';
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
}

void write_tum(const fs::path& file, std::span<const TimedPose> poses) {
  std::ostringstream out;
  write_tum(out, poses);
  write_file_whole(file, out.view());
}

}  // namespace credo::datasets
