// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/match_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"

namespace credo::evaluation {
namespace {

/// A difference that is beyond both limits.
bool beyond(double difference, double sigma, double limit, double sigmas) {
  return std::abs(difference) > std::max(limit, sigmas * sigma);
}

bool wrong_wall(const perception::Primitive& seen, const localization::WallLandmark& wall,
                const geometry::Pose2& T_map_base, const MatchCheckParams& params) {
  const Eigen::Vector2d middle = T_map_base * seen.line.centroid;
  const double across = wall.normal().dot(middle - wall.extent.a);
  const double wall_angle = std::atan2(wall.direction.y(), wall.direction.x());
  // Lines have no sense of direction: modulo pi.
  const double turn = std::remainder(T_map_base.theta + seen.line.angle - wall_angle, std::numbers::pi);
  return beyond(across, seen.line.sigma_across, params.distance_m, params.sigmas) ||
         beyond(turn, seen.line.sigma_angle, geometry::to_radians(params.angle_deg), params.sigmas);
}

bool wrong_point(const perception::Primitive& seen, const Eigen::Vector2d& camera_origin,
                 const localization::PointLandmark& point, const geometry::Pose2& T_map_base,
                 const MatchCheckParams& params) {
  const Eigen::Vector2d expected = T_map_base.inverse() * point.position;
  const Eigen::Vector2d ray = expected - (seen.bearing_only ? camera_origin : Eigen::Vector2d::Zero());
  const double azimuth = geometry::angle_difference(seen.azimuth, std::atan2(ray.y(), ray.x()));
  if (beyond(azimuth, seen.sigma_azimuth, geometry::to_radians(params.angle_deg), params.sigmas)) return true;
  return !seen.bearing_only && beyond(seen.range_m - ray.norm(), seen.sigma_range_m, params.distance_m, params.sigmas);
}

}  // namespace

bool is_wrong_match(const perception::Primitive& seen, const Eigen::Vector2d& camera_origin,
                    const localization::LandmarkMap& map, tracking::LandmarkId landmark,
                    const geometry::Pose2& T_map_base, const MatchCheckParams& params) {
  return map.is_wall(landmark) ? wrong_wall(seen, map.wall(landmark), T_map_base, params)
                               : wrong_point(seen, camera_origin, map.point(landmark), T_map_base, params);
}

MatchCounts check_matches(const perception::Scene& scene, std::span<const tracking::Track> tracks,
                          const localization::LandmarkMap& map, const geometry::Pose2& T_map_base,
                          const MatchCheckParams& params) {
  MatchCounts counts;
  for (const tracking::Track& track : tracks) {
    if (track.state != tracking::TrackState::kTracked || track.landmark == tracking::kNoLandmark) continue;
    ++counts.matches;
    counts.wrong +=
        is_wrong_match(track.last_seen, scene.camera_origin, map, track.landmark, T_map_base, params) ? 1 : 0;
  }
  return counts;
}

}  // namespace credo::evaluation
