// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/dataset.hpp"

namespace credo::datasets {

struct CarmenParams {
  /// A reading at or above this is "nothing came back" (inf) where the log does not say how far the laser reaches. The
  /// SICK lasers of the published logs write 81.8 to 81.91 m, others 50 or 51.2 m: a reading that equals one of these
  /// is taken as no return, too.
  double no_return_from_m = 80.0;
  double sigma_0_m = 0.01;             ///< range noise of a laser of which the log says nothing
  double sonar_no_echo_share = 0.999;  ///< of the largest reading of a ring; at or above it: no echo
};

/// A CARMEN log: the scans with the poses that the log gives them. In a "corrected" log (one that a SLAM system went
/// over) `scan_poses` are the corrected poses, and so is `odometry`: never take it for raw odometry.
struct CarmenLog {
  sensors::Rig
      rig;  ///< one range finder for each laser (FLASER and RLASER, ROBOTLASERk, RAWLASERk), in order of number
  std::vector<std::string> laser_names;                ///< "FLASER", "ROBOTLASER1", ...; as rig.range_finders
  std::vector<std::vector<sensors::RangeScan>> scans;  ///< [range finder][row]
  /// T_map_laser of each scan; empty for a laser whose messages carry no pose (RAWLASERk).
  std::vector<std::vector<TimedPose>> laser_poses;
  /// T_odom_base of each scan, as the message gives it; empty likewise.
  std::vector<std::vector<TimedPose>> base_poses;
  std::vector<std::vector<sensors::SonarSweep>> sonar;
  std::vector<sensors::OdometryReading> odometry;  ///< ODOM rows; where there are none, the base poses of the scans
  bool times_usable = true;  ///< false: the log has no times that grow; row k of the log stands at k/10 seconds
  std::vector<std::string> remarks;
};

/// Whether the file is a CARMEN log, plain or gzipped: one of its first lines starts with a known message name.
[[nodiscard]] bool is_carmen(const std::filesystem::path& file);

/// Reads a CARMEN log, plain or gzipped. Messages that hold no measurement are skipped.
/// \throws FormatError with file and line: a truncated message, a number that is none, a log without any scan.
[[nodiscard]] CarmenLog read_carmen(const std::filesystem::path& file, const CarmenParams& params = {});

/// The log as a dataset in memory: acquisitions by the first laser (by the sonar where there is none), its poses as
/// truth. What is done with datasets can then be done with logs.
[[nodiscard]] Dataset to_dataset(CarmenLog log, std::string name);

}  // namespace credo::datasets
