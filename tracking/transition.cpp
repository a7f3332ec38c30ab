// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/transition.hpp"

#include <algorithm>
#include <cmath>

namespace credo::tracking {
namespace {

bool same_line(const WallLine& face, const WallLine& wall, double max_distance, double max_angle) {
  const WallDifference apart = difference(aligned_with(face, wall), wall);
  return std::abs(apart.angle) <= max_angle && std::abs(apart.across) <= max_distance && apart.overlap >= -max_distance;
}

}  // namespace

std::optional<double> distance_from_end(const WallLine& wall, const Junction& junction, double slack_m,
                                        const TransitionParams& params) {
  const double max_distance = params.max_distance_m + slack_m;
  if (std::abs(wall.normal().dot(junction.position) - wall.distance) > max_distance) return std::nullopt;
  const double along = wall.direction().dot(junction.position);
  const double from_begin = std::abs(along - wall.begin), from_end = std::abs(along - wall.end);
  const double from_nearer = std::min(from_begin, from_end);
  const bool amid = along > wall.begin && along < wall.end && from_nearer > max_distance;
  if (amid) return std::nullopt;
  for (int i = 0; i < junction.known_faces; ++i) {
    if (same_line(junction.faces[i], wall, max_distance, params.max_angle_rad)) return from_nearer;
  }
  if (junction.known_faces > 0 || from_nearer > max_distance) return std::nullopt;
  return from_nearer;
}

Junction seen_junction(const perception::Primitive& primitive, const perception::Scene& scene) {
  Junction junction;
  junction.position = primitive.range_m * Eigen::Vector2d(std::cos(primitive.azimuth), std::sin(primitive.azimuth));
  junction.known_faces = known_faces(primitive, scene, junction.faces);
  return junction;
}

}  // namespace credo::tracking
