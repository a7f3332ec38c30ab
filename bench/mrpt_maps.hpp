// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRange.h>

#include <limits>
#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/range_finder.hpp"
#include "sensors/sonar_ring.hpp"

// MRPT's occupancy grid, one byte of log-odds per cell, on the same readings.
namespace credo::bench {

[[nodiscard]] inline mrpt::poses::CPose3D mrpt_pose(const geometry::Pose2& pose) {
  return {pose.x, pose.y, 0.0, pose.theta, 0.0, 0.0};
}

/// A grid with room for all readings from the start, so that it never grows while it is timed.
[[nodiscard]] inline mrpt::maps::COccupancyGridMap2D mrpt_grid(double width_m, double height_m, double resolution_m) {
  constexpr double kMargin_m = 4.0;
  mrpt::maps::COccupancyGridMap2D grid(static_cast<float>(-kMargin_m), static_cast<float>(width_m + kMargin_m),
                                       static_cast<float>(-kMargin_m), static_cast<float>(height_m + kMargin_m),
                                       static_cast<float>(resolution_m));
  grid.insertionOptions.maxDistanceInsertion = std::numeric_limits<float>::max();
  grid.insertionOptions.wideningBeamsWithDistance = false;  // rays: the faster of its two ways
  return grid;
}

/// Precondition: the beams are symmetric about the axis of the range finder, which stands in the robot's centre.
[[nodiscard]] inline mrpt::obs::CObservation2DRangeScan mrpt_scan(const sensors::RangeFinder& finder,
                                                                  std::span<const float> ranges_m) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(finder.angle_increment_rad * (finder.count - 1));
  scan.rightToLeft = true;
  scan.maxRange = static_cast<float>(finder.range_max_m);
  scan.resizeScan(ranges_m.size());
  for (std::size_t beam = 0; beam < ranges_m.size(); ++beam) {
    scan.setScanRange(beam, ranges_m[beam]);
    scan.setScanRangeValidity(beam, true);
  }
  return scan;
}

/// One observation for each transducer: in 2.5.8 an observation of several draws all cones from the first one's pose.
[[nodiscard]] inline std::vector<mrpt::obs::CObservationRange> mrpt_sweep(const sensors::SonarRing& ring,
                                                                          std::span<const float> ranges_m) {
  std::vector<mrpt::obs::CObservationRange> sweep(ranges_m.size());
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    sweep[i].maxSensorDistance = static_cast<float>(ring.range_max_m);
    sweep[i].sensorConeApperture = static_cast<float>(ring.beam_width_rad);
    auto& reading = sweep[i].sensedData.emplace_back();
    const geometry::Pose2& pose = ring.T_base_transducer[i];
    reading.sensorPose = {pose.x, pose.y, 0.0, pose.theta, 0.0, 0.0};
    reading.sensedDistance = ranges_m[i];
  }
  return sweep;
}

}  // namespace credo::bench
