// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "grids/georeference.hpp"
#include "mapping/pose_reliability.hpp"
#include "sensors/acquisition.hpp"
#include "sensors/motion_path.hpp"

namespace credo::mapping {

/// What became of the readings.
struct MappingCounts {
  std::int64_t sweeps = 0;
  std::int64_t scans = 0;
  std::int64_t refused = 0;       ///< sweeps and scans whose pose or sensor is not to be trusted: nothing was mapped
  std::int64_t echoes = 0;        ///< readings with a range
  std::int64_t no_returns = 0;    ///< inf: weak evidence of free space
  std::int64_t missing = 0;       ///< nan: evidence of nothing
  std::int64_t out_of_range = 0;  ///< finite, but outside [range_min, range_max]: as nan

  MappingCounts& operator+=(const MappingCounts& other);
  friend bool operator==(const MappingCounts&, const MappingCounts&) = default;
};

/// A reading that says something, from where its transducer was when it fired.
struct PlacedReading {
  int transducer = 0;
  geometry::Pose2 T_map_transducer;
  double range_m = 0.0;      ///< inf: no echo
  double reliability = 1.0;  ///< of the pose, at the reading, and of the transducer
};

/// The readings of a sweep that can be mapped, in the order of their transducers; none where the pose is too unsure.
/// \param path    carries the pose to when each transducer was fired; empty: all at once
/// \param counts  what became of the readings is added to them
/// \param placed  is replaced; keeps its memory
/// \param trust   in the ring's transducers, one for each, in [0, 1]; empty: 1
/// \param share   of the sweep that is new, in (0, 1]
/// \throws std::invalid_argument if the rig has no such ring or the number of ranges is not that of its transducers, or
///         the pose is not finite; std::out_of_range if it is too far away to be addressed: nothing was placed then.
void place_sweep(const sensors::Rig& rig, const grids::Georeference& georeference, const PoseReliabilityParams& params,
                 const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
                 const sensors::MotionPath& path, MappingCounts& counts, std::vector<PlacedReading>& placed,
                 std::span<const double> trust = {}, double share = 1.0);

/// \throws std::invalid_argument if the rig has no such sensor, or another number of readings is expected of it.
void require_sensor(std::size_t sensors, int index, std::size_t readings, std::size_t expected, const char* what);

}  // namespace credo::mapping
