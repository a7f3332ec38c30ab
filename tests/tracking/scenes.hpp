// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <vector>

#include "geometry/pose.hpp"
#include "perception/scene.hpp"
#include "tracking/tracker.hpp"

// Hand-made scenes: what a robot at a known pose sees of a few landmarks, without noise.
namespace credo::tracking::test {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

inline constexpr auto kCorner = PrimitiveType::kCorner;
inline constexpr auto kEdge = PrimitiveType::kEdge;
inline constexpr auto kOther = PrimitiveType::kOther;

inline Primitive point(PrimitiveType type, const Eigen::Vector2d& position) {
  Primitive p;
  p.type = type;
  p.position = position;
  p.azimuth = std::atan2(position.y(), position.x());
  p.range_m = position.norm();
  p.sigma_azimuth = 0.2 * kDegree;
  p.sigma_range_m = 0.02;
  p.existence = {.yes = 0.7, .no = 0.05, .unknown = 0.25};
  return p;
}

inline Primitive at(PrimitiveType type, double azimuth_deg, double range_m = 3.0) {
  return point(type, range_m * Eigen::Vector2d(std::cos(azimuth_deg * kDegree), std::sin(azimuth_deg * kDegree)));
}

inline Primitive bearing(double azimuth_deg) {
  Primitive p;
  p.type = PrimitiveType::kOther;
  p.bearing_only = true;
  p.azimuth = azimuth_deg * kDegree;
  p.sigma_azimuth = 0.1 * kDegree;
  p.existence = {.yes = 0.5, .no = 0.0, .unknown = 0.5};
  return p;
}

inline geometry::LineEstimate line_through(const geometry::Segment& extent) {
  return {.centroid = extent.centre(),
          .angle = std::atan2((extent.b - extent.a).y(), (extent.b - extent.a).x()),
          .sigma_across = 0.005,
          .sigma_angle = 0.3 * kDegree};
}

inline Primitive wall(const geometry::Segment& extent) {
  Primitive p = point(PrimitiveType::kWall, extent.centre());
  p.extent = extent;
  p.line = line_through(extent);
  p.existence = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  return p;
}

inline Primitive wall(double ax, double ay, double bx, double by) {
  return wall(geometry::Segment{{ax, ay}, {bx, by}});
}

inline perception::FusedSegment face(const geometry::Segment& extent) {
  perception::FusedSegment segment;
  segment.extent = extent;
  segment.line = line_through(extent);
  return segment;
}

inline Scene scene(std::vector<Primitive> primitives) {
  Scene result;
  result.primitives = std::move(primitives);
  result.range_finder_seen = true;
  result.camera_seen = true;
  return result;
}

/// A measured motion, good to 1 cm and 0.5 degrees.
inline geometry::PoseEstimate motion(double x, double y, double theta_deg) {
  geometry::PoseEstimate result{{x, y, theta_deg * kDegree}, Eigen::Matrix3d::Zero()};
  result.covariance.diagonal() << 1e-4, 1e-4, 0.25 * kDegree * kDegree;
  return result;
}

/// One whole step of a tracker that no map knows: every primitive that has appeared starts a track.
inline const std::vector<Match>& follow(Tracker& tracker, const Scene& scene,
                                        const std::optional<geometry::PoseEstimate>& motion = std::nullopt,
                                        double match_yes = 0.5) {
  tracker.predict(motion);
  const std::vector<Match>& matches = tracker.associate(scene);
  for (const int primitive : std::vector<int>(tracker.appeared())) {
    tracker.start(scene, primitive, match_yes, kNoLandmark);
  }
  tracker.update(scene);
  return matches;
}

inline TrackerParams paper() {
  TrackerParams params;
  params.method = perception::Method::kPaper;
  return params;
}

}  // namespace credo::tracking::test
