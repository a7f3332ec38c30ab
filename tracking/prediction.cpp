// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace credo::tracking {
namespace {

constexpr double kNearestRange_m = 1e-2;  // a range of zero has no inverse

// Largest second difference of an azimuth passed at constant speed: atan's second derivative, 2 u / (1 + u^2)^2, at
// u = 1 / sqrt(3).
constexpr double kLargestCurvature = 0.6495;

// What the line through the last azimuths does not know, 1-sigma.
double unmodelled_azimuth(const PolarPoint& point, int observations, int steps, const PredictionParams& params) {
  const double inverse_range = std::sqrt(point.inverse_range * point.inverse_range + point.covariance(1, 1));
  const double by_step = std::min(1.0, params.expected_step_m * inverse_range);
  if (observations < 2) return steps * std::hypot(params.expected_turn_rad, by_step);
  return 0.5 * steps * (steps + 1) * std::hypot(params.expected_turn_change_rad, kLargestCurvature * by_step * by_step);
}

void extrapolate_point(Memory& memory, int step, perception::Method method, const PredictionParams& params) {
  const bool paper = method == perception::Method::kPaper;
  const Extrapolated azimuth =
      memory.azimuths.extrapolate(paper ? params.observations_paper : params.observations, step);
  PolarPoint& point = memory.now.point;
  const int steps = step - memory.azimuths.last_step();
  const double unmodelled = paper ? 0.0 : unmodelled_azimuth(point, azimuth.from, steps, params);
  const double by_step = params.expected_step_m * (point.inverse_range * point.inverse_range + point.covariance(1, 1));
  point.azimuth = geometry::wrap_angle(azimuth.value);
  point.covariance(0, 0) = azimuth.variance + unmodelled * unmodelled;
  point.covariance(0, 1) = point.covariance(1, 0) = 0.0;
  point.covariance(1, 1) += by_step * by_step;
}

void extrapolate_wall(Memory& memory, int step, const PredictionParams& params) {
  const Extrapolated angle = memory.wall_angles.extrapolate(params.observations, step);
  const Extrapolated distance = memory.wall_distances.extrapolate(params.observations, step);
  const int steps = step - memory.wall_angles.last_step();
  const double turn = angle.from < 2 ? params.expected_turn_rad : params.expected_turn_change_rad;
  // The distance changes by the share of the step that goes across, which is as constant as the heading.
  const double across = distance.from < 2 ? params.expected_step_m : params.expected_step_m * 0.5;
  WallLine& wall = memory.now.wall;
  wall.angle = geometry::wrap_angle(angle.value);
  wall.distance = distance.value;
  wall.covariance << angle.variance + turn * turn * steps * steps, 0.0, 0.0,
      distance.variance + across * across * steps * steps;
  wall.variance_along = params.expected_step_m * params.expected_step_m * steps * steps;
}

void remember_wall(Memory& memory, const WallLine& seen, int step) {
  // The history keeps one sense of direction: an angle that had to be turned by pi changes the sign of the distance.
  memory.wall_angles.add_angle(step, seen.angle, std::sqrt(seen.covariance(0, 0)), std::numbers::pi);
  const bool turned =
      std::abs(geometry::angle_difference(memory.wall_angles.last(), seen.angle)) > 0.5 * std::numbers::pi;
  const double sigma = std::sqrt(seen.covariance(1, 1));
  memory.wall_distances.add(step, turned ? -seen.distance : seen.distance, sigma);
  WallLine reference;
  reference.angle = memory.wall_angles.last();
  memory.now.wall = aligned_with(seen, reference);
}

}  // namespace

int known_faces(const perception::Primitive& primitive, const perception::Scene& scene,
                std::array<WallLine, 2>& faces) {
  const int first = primitive.first_segment, last = primitive.last_segment;
  const int segments = static_cast<int>(scene.segments.size());
  int known = 0;
  for (const int index : {first, last}) {
    if (index < 0 || index >= segments || (known == 1 && first == last)) continue;
    faces[known++] = wall_line(scene.segments[index].line, scene.segments[index].extent);
  }
  return known;
}

PolarPoint seen_point(const perception::Primitive& primitive, const Eigen::Vector2d& camera_origin,
                      const PredictionParams& params) {
  PolarPoint point;
  point.azimuth = geometry::wrap_angle(primitive.azimuth);
  point.covariance(0, 0) = primitive.sigma_azimuth * primitive.sigma_azimuth;
  if (primitive.bearing_only) {
    // Mean and sigma of the inverse range: infinity at one sigma below, the nearest at three sigma above.
    point.inverse_range = 0.25 / params.nearest_m;
    point.covariance(1, 1) = point.inverse_range * point.inverse_range;
    return seen_from(point, -camera_origin);
  }
  const double inverse = 1.0 / std::max(primitive.range_m, kNearestRange_m);
  const double sigma = primitive.sigma_range_m * inverse * inverse;
  point.inverse_range = inverse;
  point.covariance(1, 1) = sigma * sigma;
  return point;
}

void predict(Memory& memory, const perception::Primitive& last_seen,
             const std::optional<geometry::PoseEstimate>& motion, int step, perception::Method method,
             const PredictionParams& params) {
  Prediction& now = memory.now;
  const bool is_wall = last_seen.type == perception::PrimitiveType::kWall;
  if (motion && method == perception::Method::kDefault) {
    now.point = carry(now.point, *motion);
    if (is_wall) now.wall = carry(now.wall, *motion);
    for (int i = 0; i < now.known_faces; ++i) now.faces[i] = carry(now.faces[i], *motion);
    return;
  }
  extrapolate_point(memory, step, method, params);
  if (is_wall && method == perception::Method::kDefault) extrapolate_wall(memory, step, params);
  now.unmoved = true;
}

void observe(Memory& memory, const perception::Primitive& primitive, const perception::Scene& scene, int step,
             bool first, const PredictionParams& params) {
  Prediction& now = memory.now;
  if (primitive.bearing_only && !first) {
    now.point = with_bearing(now.point, scene.camera_origin, primitive.azimuth, primitive.sigma_azimuth);
  } else {
    now.point = seen_point(primitive, scene.camera_origin, params);
  }
  memory.azimuths.add_angle(step, primitive.azimuth, primitive.sigma_azimuth, 2.0 * std::numbers::pi);
  if (primitive.type == perception::PrimitiveType::kWall) {
    remember_wall(memory, wall_line(primitive.line, primitive.extent), step);
    now.known_faces = 0;
  } else if (!primitive.bearing_only) {
    now.known_faces = known_faces(primitive, scene, now.faces);
  }
  now.unmoved = false;
}

}  // namespace credo::tracking
