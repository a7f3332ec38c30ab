// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "mapping/mapper.hpp"

// What is mapped by `credo map` and `credo compare maps`: readings, and the poses that they were taken from.
namespace credo::apps {

struct MapSource {
  std::string source, poses;
  std::vector<std::string> sensors{"range", "sonar"};
  std::string lines = "segments";  ///< of --poses ego: or "hough"
};

/// Readings with the poses to map them from.
struct MapPart {
  sensors::MotionPath path;
  sensors::Rig rig;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
};

struct MapParts {
  std::vector<MapPart> parts;
  std::string poses;  ///< where they are from, in words
};

/// Which sonar model, by its name, and the weights of a calibrated one.
struct SonarChoice {
  std::string model = "li2007";
  std::string weights;  ///< file; empty: the default ones
  bool printed = false;
};

/// The same of the range finders.
struct LaserChoice {
  std::string model = "li2006";
  std::string weights;  ///< file; empty: the default ones
  bool printed = false;
};

void add_sonar_weights_option(CLI::App& command, SonarChoice& choice);
void add_laser_weights_option(CLI::App& command, LaserChoice& choice);
/// \throws std::runtime_error if the file of weights cannot be read
[[nodiscard]] mapping::SonarParams sonar_params(const SonarChoice& choice, double resolution_m);
[[nodiscard]] mapping::LaserParams laser_params(const LaserChoice& choice);

void add_map_source_options(CLI::App& command, MapSource& source);

/// \throws std::runtime_error if the source is neither a dataset nor a CARMEN log, cannot be read, or has no poses
[[nodiscard]] MapParts read_map_parts(const MapSource& source);
[[noreturn]] void fail_without_readings(const MapSource& source);

}  // namespace credo::apps
