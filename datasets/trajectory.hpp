// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "datasets/dataset.hpp"
#include "datasets/spatial_trajectory.hpp"

namespace credo::datasets {

struct Trajectory {
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool has_times = true;         ///< false: KITTI, where row i stands at i seconds
  std::vector<TimedPose> poses;  ///< by time, projected to the plane z = 0; theta is the heading of the x axis
};

/// read_spatial_trajectory() projected to the plane. KITTI rows are in the camera's frame (x right, y down, z forward),
/// of which the plane is (z, -x), unless each of them is a motion in the plane z = 0, which is then kept.
/// \throws FormatError as read_spatial_trajectory(), and for a time that decreases
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
