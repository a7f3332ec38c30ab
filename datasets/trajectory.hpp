// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "datasets/dataset.hpp"

namespace credo::datasets {

/// How a trajectory was written.
enum class TrajectoryFormat {
  kTum,        ///< timestamp tx ty tz qx qy qz qw; seconds
  kKitti,      ///< 12 numbers, the first three rows of a transform; no time
  kEuroc,      ///< csv: ns, position, quaternion with w first
  kPoseTable,  ///< csv: ns, x, y, theta and perhaps more (groundtruth0/data.csv, localization.csv)
  kDataset,    ///< a dataset folder: its groundtruth0
  kResults,    ///< a folder of results: its trajectory.tum
};

struct Trajectory {
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool has_times = true;         ///< false: KITTI, where row i stands at i seconds
  std::vector<TimedPose> poses;  ///< by time, projected to the plane z = 0; theta is the heading of the x axis
};

[[nodiscard]] const char* to_string(TrajectoryFormat format);

/// Reads a trajectory; the format is told by the content. KITTI rows are in the camera's frame (x right, y down, z
/// forward), of which the plane is (z, -x), unless each of them is a motion in the plane z = 0, which is then kept.
/// \throws FormatError, with file and line: an unknown format, a bad row, a time that decreases, a value that is not
/// finite, a quaternion of no length, or no pose at all.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path);

/// Writes poses as TUM rows: seconds with 9 decimals from the integer nanoseconds, nothing lost; qx = qy = 0.
void write_tum(std::ostream& out, std::span<const TimedPose> poses);
/// The same into a file, by way of a temporary one beside it. \throws std::runtime_error if it cannot be written.
void write_tum(const std::filesystem::path& file, std::span<const TimedPose> poses);

/// Seconds with 9 decimals, e.g. 1600000000.012345678. Exact.
[[nodiscard]] std::string to_seconds(sensors::Timestamp time);
/// The exact reverse; more than 9 decimals are rounded, an exponent is understood.
/// \throws std::invalid_argument if `text` is not a number of seconds.
[[nodiscard]] sensors::Timestamp parse_seconds(std::string_view text);

}  // namespace credo::datasets
