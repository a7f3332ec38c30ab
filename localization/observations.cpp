// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/observations.hpp"

#include <algorithm>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using perception::Primitive;

/// Variance that takes a direction out of the reckoning. [m^2]
constexpr double kNoInformation_m2 = 100.0;

Matrix2d line_noise(const geometry::LineEstimate& line, const ObservationParams& params) {
  const double across = std::hypot(line.sigma_across, params.min_wall_sigma_m);
  const double angle = std::hypot(line.sigma_angle, params.min_wall_sigma_rad);
  return Vector2d(across * across, angle * angle).asDiagonal();
}

}  // namespace

Observation observe_wall(const Primitive& wall, const WallLandmark& landmark, const geometry::Pose2& pose,
                         double plan_uncertainty_m, const ObservationParams& params) {
  const double at =
      std::clamp((pose * wall.line.centroid - landmark.extent.a).dot(landmark.direction), 0.0, landmark.length_m);
  Observation o;
  o.kind = ObservationKind::kWall;
  o.map_point = landmark.extent.a;
  o.map_angle = std::atan2(landmark.direction.y(), landmark.direction.x());
  o.base_point = wall.line.centroid;
  o.base_angle = wall.line.angle;
  o.noise = line_noise(wall.line, params);
  o.plan = landmark.plan_covariance(at, plan_uncertainty_m);
  o.plan_terms = landmark.plan_terms;
  o.plan_along_m = at;
  o.plan_sigma_m = plan_uncertainty_m;
  o.own_sigma_m = params.as_built_sigma_m;
  o.own_sigma_rad = params.as_built_sigma_rad;
  o.plan.diagonal() += Vector2d(o.own_sigma_m, o.own_sigma_rad).cwiseAbs2();
  return o;
}

Observation observe_point(const perception::Scene& scene, const Primitive& point, const PointLandmark& landmark,
                          const std::vector<bool>& wall_in_use, double plan_uncertainty_m,
                          const ObservationParams& params) {
  Observation o;
  o.map_point = landmark.position;
  o.plan_terms = {&landmark.plan_term, 1};
  o.plan_sigma_m = plan_uncertainty_m;
  o.own_sigma_m = params.as_built_sigma_m;
  o.plan = (o.plan_sigma_m * o.plan_sigma_m + o.own_sigma_m * o.own_sigma_m) * Matrix2d::Identity();
  bool on_used_wall = false;
  Matrix2d position_noise = point.position_covariance;
  for (const int s : {point.first_segment, point.last_segment}) {
    if (s < 0 || !wall_in_use[static_cast<std::size_t>(s)]) continue;
    on_used_wall = true;
    const Vector2d normal = scene.segments[static_cast<std::size_t>(s)].line.normal();
    position_noise += kNoInformation_m2 * normal * normal.transpose();
  }
  if (point.bearing_only || (on_used_wall && point.radial_line >= 0)) {
    const perception::RadialLine& line = scene.radial_lines[static_cast<std::size_t>(point.radial_line)];
    const double sigma = std::hypot(line.sigma, params.min_bearing_sigma_rad);
    o.kind = ObservationKind::kBearing;
    o.base_point = scene.camera_origin;
    o.base_angle = line.azimuth;
    o.noise(0, 0) = sigma * sigma;
    return o;
  }
  o.kind = ObservationKind::kPoint;
  o.base_point = point.position;
  o.noise = position_noise + params.min_wall_sigma_m * params.min_wall_sigma_m * Matrix2d::Identity();
  return o;
}

Eigen::Matrix<double, 2, 3> base_coordinates_by_pose(const geometry::Pose2& pose, const Vector2d& in_base) {
  Eigen::Matrix<double, 2, 3> J;
  J.leftCols<2>() = -pose.rotation().transpose();
  J.col(2) = Vector2d(in_base.y(), -in_base.x());
  return J;
}

}  // namespace credo::localization
