// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <numbers>

#include "localization/landmark_map.hpp"
#include "sensors/odometry.hpp"
#include "tests/localization/sightings.hpp"

// Buildings, and the scans of a robot in them.
namespace credo::localization::test {

inline geometry::FloorPlan outline(const std::vector<Eigen::Vector2d>& corners) {
  geometry::FloorPlan plan;
  for (std::size_t i = 0; i < corners.size(); ++i)
    plan.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return plan;
}

/// 8 m x 5 m, with a niche and a bay, so that it looks different from everywhere.
inline geometry::FloorPlan odd_room() {
  return outline({{0, 0}, {8, 0}, {8, 5}, {5.5, 5}, {5.5, 6.2}, {3.8, 6.2}, {3.8, 5}, {1.2, 5}, {1.2, 3.9}, {0, 3.9}});
}

/// 6 m x 4 m: turned by half a turn it is the same.
inline geometry::FloorPlan plain_room() { return outline({{0, 0}, {6, 0}, {6, 4}, {0, 4}}); }

/// A range finder of 180 beams that reaches so far.
inline sensors::Rig rig_with_range(double range_max_m = 12.0) {
  sensors::RangeFinder finder;
  finder.angle_increment_rad = geometry::to_radians(2.0);
  finder.count = 180;
  finder.range_min_m = 0.1;
  finder.range_max_m = range_max_m;
  sensors::Rig rig;
  rig.range_finders.push_back(finder);
  return rig;
}

/// The scan as a scene without primitives; 1-sigma of 1 cm that is not drawn.
inline perception::Scene scanned(const LandmarkMap& map, const geometry::Pose2& pose,
                                 const sensors::Rig& rig = rig_with_range()) {
  const sensors::RangeFinder& finder = rig.range_finders.front();
  perception::Scene scene;
  scene.range_finder_seen = true;
  for (int beam = 0; beam < finder.count; ++beam) {
    const double angle = finder.beam_angle(beam);
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const double range_m = map.cast(pose.translation(), pose.rotation() * ray, finder.range_max_m);
    if (!std::isfinite(range_m)) continue;
    scene.points.push_back({.position = range_m * ray, .ray = ray, .range_m = range_m, .sigma_m = 0.01, .beam = beam});
  }
  return scene;
}

/// The same with what is seen of each wall of the map that is not hidden at its middle.
inline perception::Scene scanned_with_walls(const LandmarkMap& map, const geometry::Pose2& pose,
                                            const sensors::Rig& rig = rig_with_range()) {
  perception::Scene scene = scanned(map, pose, rig);
  for (const WallLandmark& wall : map.walls())
    if (map.shows(pose.translation(), wall.extent.centre())) scene.primitives.push_back(wall_seen(wall.extent, pose));
  for (const PointLandmark& point : map.points()) {
    const auto type = map.type_from(point, pose.translation());
    if (type && map.shows(pose.translation(), point.position))
      scene.primitives.push_back(point_seen(*type, point.position, pose));
  }
  return scene;
}

/// What odometry says of a motion.
inline geometry::PoseEstimate driven(const geometry::Pose2& T_from_to) {
  return sensors::OdometryNoise{}.with_covariance(T_from_to);
}

}  // namespace credo::localization::test
