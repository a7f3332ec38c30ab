// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/trajectory.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "datasets/format_error.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

constexpr Timestamp kNanoseconds = 1'000'000'000;
constexpr int kTumDecimals = 9;

/// The poses in the plane of a camera's frame (x right, y down, z forward), unless all are motions in the plane z = 0.
std::vector<TimedPose> kitti_poses(std::span<const StampedPose> spatial) {
  const bool upright = std::ranges::all_of(spatial, [](const StampedPose& pose) {
    return (pose.rotation.row(2) - Eigen::RowVector3d::UnitZ()).cwiseAbs().maxCoeff() < 1e-6 &&
           std::abs(pose.position.z()) < 1e-6;
  });
  std::vector<TimedPose> poses;
  for (const StampedPose& pose : spatial) {
    const auto& [index, R, t] = pose;
    poses.push_back({index * kNanoseconds,
                     upright ? flatten(pose) : geometry::Pose2{t.z(), -t.x(), std::atan2(-R(0, 2), R(2, 2))}});
  }
  return poses;
}

}  // namespace

Trajectory read_trajectory(const fs::path& path) {
  const SpatialTrajectory spatial = read_spatial_trajectory(path);
  Trajectory trajectory{.format = spatial.format, .has_times = spatial.has_times, .poses = {}};
  if (!spatial.has_times) {
    trajectory.poses = kitti_poses(spatial.poses);
    return trajectory;
  }
  for (std::size_t i = 0; i < spatial.poses.size(); ++i) {
    const Timestamp time = spatial.poses[i].time;
    if (i > 0 && time < trajectory.poses.back().time)
      throw FormatError(spatial.file, spatial.lines[i],
                        "the time " + to_seconds(time) + " s comes after " + to_seconds(trajectory.poses.back().time) +
                            " s: expected rows in order of time");
    trajectory.poses.push_back({time, flatten(spatial.poses[i])});
  }
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
