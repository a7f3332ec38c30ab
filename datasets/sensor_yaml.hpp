// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "sensors/acquisition.hpp"

/// The sensor.yaml of each kind of sensor (docs/dataset-format.md), read and written.
namespace credo::datasets {

/// What was noticed while reading, for Dataset::remarks; one line each.
using Remarks = std::vector<std::string>;

// All throw FormatError with file and line for whatever does not fit.

/// Reads the mask image, too.
[[nodiscard]] sensors::OmniCamera read_camera(const std::filesystem::path& file, Remarks& remarks);
/// As the file says; `angle_increment` may be negative (see counter_clockwise()).
[[nodiscard]] sensors::RangeFinder read_range_finder(const std::filesystem::path& file, Remarks& remarks);
/// A sonar ring, and by what its recorded ranges are to be multiplied, as the air had another temperature than the one
/// that they were computed for; the limits of the ring are multiplied already.
struct RecordedSonarRing {
  sensors::SonarRing ring;
  double range_factor = 1.0;
};
[[nodiscard]] RecordedSonarRing read_sonar_ring(const std::filesystem::path& file, Remarks& remarks);
[[nodiscard]] sensors::OdometryNoise read_odometry_noise(const std::filesystem::path& file, Remarks& remarks);

/// The same scanner with its beams counted counter-clockwise: the last beam becomes the first, and the scan runs
/// through them backwards in time. Unchanged where they are already.
[[nodiscard]] sensors::RangeFinder counter_clockwise(const sensors::RangeFinder& range_finder);

void write_sensor_yaml(std::ostream& out,
                       const sensors::OmniCamera& camera);  ///< names mask.png, where there is a mask
void write_sensor_yaml(std::ostream& out, const sensors::RangeFinder& range_finder);
void write_sensor_yaml(std::ostream& out, const sensors::SonarRing& ring);
void write_sensor_yaml(std::ostream& out, const sensors::OdometryNoise& noise);

}  // namespace credo::datasets
