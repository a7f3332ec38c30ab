// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// The formats that read_trajectory tells apart.

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"
#include "datasets/trajectory.hpp"
#include "evaluation/trajectory.hpp"

namespace credo::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr double kLargest = 1e6;  // metres and radians

struct Row {
  int line = 0;
  std::vector<std::string_view> fields;
};

[[noreturn]] void fail(const fs::path& path, int line, const std::string& what) {
  throw datasets::FormatError(path, line, what);
}

/// At commas if there is one, else at white space.
std::vector<std::string_view> split(std::string_view text) {
  const bool commas = text.find(',') != std::string_view::npos;
  std::vector<std::string_view> fields;
  while (true) {
    const auto end = commas ? text.find(',') : text.find_first_of(" \t");
    fields.push_back(datasets::trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
    if (!commas) text = datasets::trimmed(text);
  }
}

double number(const fs::path& path, const Row& row, std::size_t column) {
  const std::string_view field = row.fields[column];
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !(std::abs(value) <= kLargest)) {
    fail(path, row.line, "expected a finite number (within 1e6) in column " + std::to_string(column + 1) + ", found " +
                             datasets::in_quotes(field));
  }
  return value;
}

sensors::Timestamp nanoseconds(const fs::path& path, const Row& row) {
  try {
    return datasets::parse_seconds(row.fields[0]);
  } catch (const std::invalid_argument& error) {
    fail(path, row.line, error.what());
  }
}

sensors::Timestamp integer(const fs::path& path, const Row& row) {
  const std::string_view field = row.fields[0];
  sensors::Timestamp value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || std::abs(value) > sensors::kLatestTime) {
    fail(path, row.line, "expected a time in whole nanoseconds, found " + datasets::in_quotes(field));
  }
  return value;
}

Eigen::Matrix3d rotation_of(const fs::path& path, const Row& row, double w, double x, double y, double z) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1.0) <= 0.01)) {
    fail(path, row.line, "expected a quaternion of norm 1, found norm " + std::to_string(q.norm()));
  }
  return q.normalized().toRotationMatrix();
}

StampedPose tum_row(const fs::path& path, const Row& row) {
  const auto v = [&](std::size_t column) { return number(path, row, column); };
  return {.time = nanoseconds(path, row),
          .rotation = rotation_of(path, row, v(7), v(4), v(5), v(6)),
          .position = {v(1), v(2), v(3)}};
}

StampedPose kitti_row(const fs::path& path, const Row& row, sensors::Timestamp index) {
  StampedPose pose{.time = index};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) pose.rotation(i, j) = number(path, row, 4 * i + j);
    pose.position[static_cast<Eigen::Index>(i)] = number(path, row, 4 * i + 3);
  }
  if ((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.01) {
    fail(path, row.line, "expected the first three rows of a rigid transform, found a matrix that is no rotation");
  }
  return pose;
}

StampedPose euroc_row(const fs::path& path, const Row& row) {
  const auto v = [&](std::size_t column) { return number(path, row, column); };
  return {.time = integer(path, row),
          .rotation = rotation_of(path, row, v(4), v(5), v(6), v(7)),
          .position = {v(1), v(2), v(3)}};
}

StampedPose planar_row(const fs::path& path, const Row& row) {
  return lift(integer(path, row), {number(path, row, 1), number(path, row, 2),
                                   geometry::wrap_angle(number(path, row, 3))});
}

enum class Format { kTum, kKitti, kEuroc, kPlanar };

/// A csv whose header says that its fourth column is a heading holds planar poses; without a header, four columns do.
Format format_of(const fs::path& path, const Row& row, bool commas, const std::string& header) {
  const std::size_t columns = row.fields.size();
  if (!commas && columns == 8) return Format::kTum;
  if (!commas && columns == 12) return Format::kKitti;
  if (commas) {
    const auto names = split(header);
    const bool heading = names.size() >= 4 && names[3].substr(0, 5) == "theta";
    if (columns == 4 || (columns > 4 && heading)) return Format::kPlanar;
    if (columns >= 8) return Format::kEuroc;
  }
  fail(path, row.line,
       "expected 8 columns (TUM: timestamp tx ty tz qx qy qz qw), 12 (KITTI), or a csv of poses, found " +
           std::to_string(columns));
}

fs::path file_in(const fs::path& folder) {
  for (const char* name : {"groundtruth0/data.csv", "localization.csv", "trajectory.tum", "data.csv"}) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  throw std::runtime_error(folder.string() +
                           ": no trajectory in this folder: expected groundtruth0/data.csv (a dataset with ground truth) "
                           "or localization.csv (the results of credo run)");
}

}  // namespace

Trajectory read_trajectory(const fs::path& given) {
  const fs::path path = fs::is_directory(given) ? file_in(given) : given;
  std::istringstream file(datasets::read_text_file(path));
  Trajectory trajectory{.name = given.string()};
  std::optional<Format> format;
  std::size_t columns = 0;
  std::string text, header;
  for (int line = 1; std::getline(file, text); ++line) {
    const std::string_view content = datasets::trimmed(text);
    if (content.empty()) continue;
    if (content.front() == '#') {
      if (header.empty()) header = content.substr(1);
      continue;
    }
    const Row row{line, split(content)};
    if (!format) {
      format = format_of(path, row, content.find(',') != std::string_view::npos, header);
      columns = row.fields.size();
      trajectory.timed = *format != Format::kKitti;
    }
    if (row.fields.size() != columns && (*format != Format::kPlanar || row.fields.size() < 4)) {
      fail(path, line, "expected " + std::to_string(columns) + " columns as in the rows above, found " +
                           std::to_string(row.fields.size()));
    }
    switch (*format) {
      case Format::kTum: trajectory.poses.push_back(tum_row(path, row)); break;
      case Format::kKitti:
        trajectory.poses.push_back(kitti_row(path, row, static_cast<sensors::Timestamp>(trajectory.poses.size())));
        break;
      case Format::kEuroc: trajectory.poses.push_back(euroc_row(path, row)); break;
      case Format::kPlanar: trajectory.poses.push_back(planar_row(path, row)); break;
    }
  }
  if (trajectory.poses.empty()) throw std::runtime_error(path.string() + ": no poses: the file has no rows of numbers");
  return trajectory;
}

}  // namespace credo::evaluation
