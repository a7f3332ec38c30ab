// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/acquisition.hpp"

#include <cmath>

namespace credo::sensors {

void carry_scan(const RangeScan& scan, const RangeFinder& range_finder, const MotionPath& path, Timestamp time,
                std::vector<ScanPoint>& points) {
  points.clear();
  const geometry::Pose2 T_base_path = path.pose_at(time).inverse(), T_base_sensor = range_finder.T_base_sensor;
  const Eigen::Matrix2d R_base_path = T_base_path.rotation();
  const int count = static_cast<int>(scan.ranges_m.size());
  for (int beam = 0; beam < count; ++beam) {
    const double range = scan.ranges_m[static_cast<std::size_t>(beam)];
    if (!(range >= range_finder.range_min_m && range <= range_finder.range_max_m)) continue;
    const Timestamp taken = scan.time + from_seconds(range_finder.beam_time(beam));
    // Where the base was when the beam was taken, and the beam from there.
    const geometry::Pose2 T_path_then = path.pose_at(taken);
    const Eigen::Matrix2d R_base_then = geometry::Pose2{0.0, 0.0, T_base_path.theta + T_path_then.theta}.rotation();
    const double angle = T_base_sensor.theta + range_finder.beam_angle(beam);
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d base_then = T_base_path.translation() + R_base_path * T_path_then.translation();
    points.push_back({.position = base_then + R_base_then * (T_base_sensor.translation() + range * ray),
                      .ray = R_base_then * ray,
                      .range_m = range,
                      .sigma_m = range_finder.noise.sigma(range),
                      .beam = beam});
  }
}

}  // namespace credo::sensors
