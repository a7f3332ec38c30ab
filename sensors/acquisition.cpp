// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/acquisition.hpp"

#include <cmath>

namespace credo::sensors {

void carry_scan(const RangeScan& scan, const RangeFinder& range_finder, const MotionPath& path, Timestamp time,
                std::vector<ScanPoint>& points) {
  points.clear();
  const geometry::Pose2 T_base_path = path.pose_at(time).inverse();
  const int count = static_cast<int>(scan.ranges_m.size());
  for (int beam = 0; beam < count; ++beam) {
    const double range = scan.ranges_m[static_cast<std::size_t>(beam)];
    if (!(range >= range_finder.range_min_m && range <= range_finder.range_max_m)) continue;
    const Timestamp taken = scan.time + from_seconds(range_finder.beam_time(beam));
    const geometry::Pose2 T_base_sensor = T_base_path * path.pose_at(taken) * range_finder.T_base_sensor;
    const double angle = T_base_sensor.theta + range_finder.beam_angle(beam);
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    points.push_back({.position = T_base_sensor.translation() + range * ray,
                      .ray = ray,
                      .range_m = range,
                      .sigma_m = range_finder.noise.sigma(range),
                      .beam = beam});
  }
}

}  // namespace credo::sensors
