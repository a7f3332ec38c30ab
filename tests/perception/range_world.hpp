// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "perception/segmentation.hpp"
#include "sensors/acquisition.hpp"

namespace credo::perception {

/// Walls and a range finder that looks at them: what the tests of the range side are made of.
struct RangeWorld {
  std::vector<geometry::Segment> walls;

  void add(double x1, double y1, double x2, double y2) { walls.push_back({{x1, y1}, {x2, y2}}); }
  void add_room(double x1, double y1, double x2, double y2) {
    add(x1, y1, x2, y1);
    add(x2, y1, x2, y2);
    add(x2, y2, x1, y2);
    add(x1, y2, x1, y1);
  }

  /// Distance to the first wall; infinite where there is none.
  [[nodiscard]] double cast(const Eigen::Vector2d& origin, double angle) const {
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::Segment& wall : walls) {
      const Eigen::Vector2d along = wall.b - wall.a, to = wall.a - origin;
      const double det = along.x() * ray.y() - along.y() * ray.x();
      if (std::abs(det) < 1e-12) continue;
      const double range = (along.x() * to.y() - along.y() * to.x()) / det;
      const double share = (ray.x() * to.y() - ray.y() * to.x()) / det;
      if (range > 0.0 && share >= 0.0 && share <= 1.0 && range < nearest) nearest = range;
    }
    return nearest;
  }
};

[[nodiscard]] inline sensors::RangeFinder full_turn(int count, sensors::RangeNoise noise = {0.005, 0.0},
                                                    double range_max = 12.0) {
  sensors::RangeFinder finder;
  finder.count = count;
  finder.angle_min_rad = -std::numbers::pi;
  finder.angle_increment_rad = 2.0 * std::numbers::pi / count;
  finder.range_min_m = 0.1;
  finder.range_max_m = range_max;
  finder.noise = noise;
  return finder;
}

/// A scan from the pose T_world_base; `seed` 0: without noise.
[[nodiscard]] inline sensors::RangeScan scan_of(const RangeWorld& world, const sensors::RangeFinder& finder,
                                                const geometry::Pose2& T_world_base = {}, std::uint32_t seed = 0,
                                                double outlier_share = 0.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const geometry::Pose2 T_world_sensor = T_world_base * finder.T_base_sensor;
  sensors::RangeScan scan;
  for (int beam = 0; beam < finder.count; ++beam) {
    double range = world.cast(T_world_sensor.translation(), T_world_sensor.theta + finder.beam_angle(beam));
    if (seed != 0 && std::isfinite(range)) range += finder.noise.sigma(range) * normal(generator);
    if (seed != 0 && uniform(generator) < outlier_share) range = 0.3 + 3.0 * uniform(generator);
    if (range > finder.range_max_m) range = std::numeric_limits<double>::infinity();
    scan.ranges_m.push_back(static_cast<float>(range));
  }
  return scan;
}

struct Segmented {
  std::vector<sensors::ScanPoint> points;
  std::vector<RangeSegment> segments;
};

[[nodiscard]] inline Segmented segment_scan(const sensors::RangeScan& scan, const sensors::RangeFinder& finder,
                                            const SegmentationParams& params = {}) {
  Segmented result;
  sensors::carry_scan(scan, finder, {}, 0, result.points);
  Segmenter(finder, params, {}).segment(scan.ranges_m, result.points, result.segments);
  return result;
}

}  // namespace credo::perception
