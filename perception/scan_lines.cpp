// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/scan_lines.hpp"

#include <cmath>
#include <numbers>

namespace credo::perception {
namespace {

/// The turn from one face to the next where they are joined; nothing where they are not.
std::optional<double> turn_between(const Primitive& face, const Primitive& next) {
  if (face.end_b != SegmentEnd::kJoined || next.end_a != SegmentEnd::kJoined) return std::nullopt;
  const Eigen::Vector2d u = face.extent.direction(), v = next.extent.direction();
  return std::abs(std::atan2(geometry::cross(u, v), u.dot(v)));
}

bool is_curved(const Primitive& face, const Primitive& before, const Primitive& next, const ScanLineParams& params) {
  if (face.extent.length() > params.curved_face_m) return false;
  const auto bent = [&](std::optional<double> turn) {
    return turn && *turn > params.straight_turn_rad && *turn < params.curved_turn_rad;
  };
  return bent(turn_between(before, face)) || bent(turn_between(face, next));
}

/// Where the free end of a face stands in the world: the edge that rests on that face alone.
std::optional<double> free_end_sigma(const Scene& scene, const Primitive& wall, bool at_b) {
  const int segment = at_b ? wall.last_segment : wall.first_segment;
  const Eigen::Vector2d& end = at_b ? wall.extent.b : wall.extent.a;
  for (const Primitive& edge : scene.primitives) {
    if (edge.type != PrimitiveType::kEdge || edge.first_segment != segment || edge.last_segment != segment) continue;
    const Eigen::Vector2d along = wall.extent.direction();
    // A face of one segment has an edge at either end.
    if ((edge.position - end).squaredNorm() > 0.25 * wall.extent.length() * wall.extent.length()) continue;
    return std::sqrt(along.dot(edge.position_covariance * along));
  }
  return std::nullopt;
}

}  // namespace

geometry::LineEstimate directed_along(geometry::LineEstimate line, const geometry::Segment& extent) {
  if (line.direction().dot(extent.b - extent.a) < 0.0) line.angle = geometry::wrap_angle(line.angle + std::numbers::pi);
  return line;
}

void scan_lines(const Scene& scene, const ScanLineParams& params, std::vector<ScanLine>& lines) {
  lines.clear();
  std::size_t walls = 0;  // they come first, counter-clockwise
  while (walls < scene.primitives.size() && scene.primitives[walls].type == PrimitiveType::kWall) ++walls;
  for (std::size_t i = 0; i < walls; ++i) {
    const Primitive& wall = scene.primitives[i];
    if (wall.support < params.min_support || wall.line.sigma_angle > params.max_sigma_rad ||
        wall.existence.pignistic() < params.least_pignistic ||
        is_curved(wall, scene.primitives[(i + walls - 1) % walls], scene.primitives[(i + 1) % walls], params))
      continue;
    lines.push_back({.line = directed_along(wall.line, wall.extent),
                     .extent = wall.extent,
                     .end_sigma_m = {free_end_sigma(scene, wall, false), free_end_sigma(scene, wall, true)},
                     .support = wall.support});
  }
}

}  // namespace credo::perception
