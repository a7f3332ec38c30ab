// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <random>

#include "geometry/pose.hpp"
#include "geometry/segment.hpp"
#include "perception/scene.hpp"

// What a robot at a known pose sees of places in the map, without noise; and such poses and places.
namespace credo::localization::test {

using perception::Primitive;
using perception::PrimitiveType;

/// Where the robot is, unless a test says otherwise.
inline const geometry::Pose2 kPose{2.0, 1.5, 0.4};

inline Primitive point_seen(PrimitiveType type, const Eigen::Vector2d& in_map, const geometry::Pose2& from) {
  Primitive p;
  p.type = type;
  p.position = from.inverse() * in_map;
  p.azimuth = std::atan2(p.position.y(), p.position.x());
  p.range_m = p.position.norm();
  p.sigma_azimuth = 0.002;
  p.sigma_range_m = 0.01;
  p.position_covariance = 1e-4 * Eigen::Matrix2d::Identity();
  p.existence = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  return p;
}

inline Primitive wall_seen(const geometry::Segment& in_map, const geometry::Pose2& from) {
  Primitive p = point_seen(PrimitiveType::kWall, in_map.centre(), from);
  p.extent = from.inverse() * in_map;
  const Eigen::Vector2d along = p.extent.direction();
  p.line = {.centroid = p.extent.centre(),
            .angle = std::atan2(along.y(), along.x()),
            .sigma_across = 0.005,
            .sigma_angle = 0.005};
  return p;
}

/// The bearing of a radial line without a segment, taken from the camera.
/// \param camera_origin  in the base frame
/// \param radial_line    index into Scene::radial_lines
inline Primitive bearing_seen(const Eigen::Vector2d& in_map, const geometry::Pose2& from,
                              const Eigen::Vector2d& camera_origin, int radial_line) {
  const Eigen::Vector2d way = from.inverse() * in_map - camera_origin;
  Primitive p;
  p.type = PrimitiveType::kOther;
  p.bearing_only = true;
  p.azimuth = std::atan2(way.y(), way.x());
  p.sigma_azimuth = 0.002;
  p.radial_line = radial_line;
  p.existence = {.yes = 0.5, .no = 0.0, .unknown = 0.5};
  return p;
}

/// Places within 5 m of the origin.
struct Random {
  explicit Random(unsigned seed) : generator(seed) {}
  double operator()(double from, double to) { return std::uniform_real_distribution(from, to)(generator); }
  Eigen::Vector2d place() { return {(*this)(-5.0, 5.0), (*this)(-5.0, 5.0)}; }
  geometry::Pose2 pose() { return {(*this)(-5.0, 5.0), (*this)(-5.0, 5.0), (*this)(-3.14, 3.14)}; }
  geometry::Segment segment() {
    const double angle = (*this)(-3.14, 3.14);
    const Eigen::Vector2d a = place();
    return {a, a + (*this)(0.5, 5.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle))};
  }
  std::mt19937 generator;
};

}  // namespace credo::localization::test
