// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/match_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"

namespace credo::evaluation {
namespace {

/// A difference that is beyond both limits.
bool beyond(double difference, double sigma, double limit, double sigmas) {
  return std::abs(difference) > std::max(limit, sigmas * sigma);
}

bool wrong_wall(const perception::Primitive& seen, const localization::WallLandmark& wall, double plan_uncertainty_m,
                const geometry::Pose2& T_map_base, const MatchCheckParams& params) {
  const Eigen::Vector2d middle = T_map_base * seen.line.centroid;
  const double across = wall.normal().dot(middle - wall.extent.a);
  const double wall_angle = std::atan2(wall.direction.y(), wall.direction.x());
  // Lines have no sense of direction: modulo pi.
  const double turn = std::remainder(T_map_base.theta + seen.line.angle - wall_angle, std::numbers::pi);
  const double along = std::clamp((middle - wall.extent.a).dot(wall.direction), 0.0, wall.length_m);
  const Eigen::Matrix2d plan = wall.plan_covariance(along, plan_uncertainty_m);
  const double sigma_across = std::hypot(seen.line.sigma_across, std::sqrt(plan(0, 0)));
  const double sigma_turn = std::hypot(seen.line.sigma_angle, std::sqrt(plan(1, 1)));
  return beyond(across, sigma_across, params.distance_m, params.sigmas) ||
         beyond(turn, sigma_turn, geometry::to_radians(params.angle_deg), params.sigmas);
}

bool wrong_point(const perception::Primitive& seen, const Eigen::Vector2d& camera_origin,
                 const localization::PointLandmark& point, double plan_uncertainty_m, const geometry::Pose2& T_map_base,
                 const MatchCheckParams& params) {
  const Eigen::Vector2d expected = T_map_base.inverse() * point.position;
  const Eigen::Vector2d ray = expected - (seen.bearing_only ? camera_origin : Eigen::Vector2d::Zero());
  const double azimuth = geometry::angle_difference(seen.azimuth, std::atan2(ray.y(), ray.x()));
  const double sigma_azimuth = std::hypot(seen.sigma_azimuth, plan_uncertainty_m / std::max(ray.norm(), 1e-3));
  if (beyond(azimuth, sigma_azimuth, geometry::to_radians(params.angle_deg), params.sigmas)) return true;
  const double sigma_range = std::hypot(seen.sigma_range_m, plan_uncertainty_m);
  return !seen.bearing_only && beyond(seen.range_m - ray.norm(), sigma_range, params.distance_m, params.sigmas);
}

}  // namespace

bool is_wrong_match(const perception::Primitive& seen, const Eigen::Vector2d& camera_origin,
                    const localization::LandmarkMap& map, tracking::LandmarkId landmark,
                    const geometry::Pose2& T_map_base, const MatchCheckParams& params) {
  const double plan = map.uncertainty_m();
  return map.is_wall(landmark) ? wrong_wall(seen, map.wall(landmark), plan, T_map_base, params)
                               : wrong_point(seen, camera_origin, map.point(landmark), plan, T_map_base, params);
}

MatchCounts ClassedMatchCounts::total() const {
  MatchCounts sum;
  for (const MatchCounts& counts : classes) sum += counts;
  return sum;
}

MatchCounts ClassedMatchCounts::points() const {
  MatchCounts sum;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (i != localization::kWallFaultClass) sum += classes[i];
  return sum;
}

ClassedMatchCounts& ClassedMatchCounts::operator+=(const ClassedMatchCounts& other) {
  for (std::size_t i = 0; i < classes.size(); ++i) classes[i] += other.classes[i];
  return *this;
}

std::string fault_class_name(std::size_t fault_class, const localization::IntegrityParams& params) {
  assert(fault_class < localization::kFaultClasses);
  if (fault_class == localization::kWallFaultClass) return "walls";
  return fmt::format("points_from_{:g}", params.point_faults[fault_class].from_belief);
}

ClassedMatchCounts check_matches(const perception::Scene& scene,
                                 std::span<const localization::Observation> observations,
                                 const localization::PoseSolution& solution, std::span<const double> beliefs,
                                 const localization::LandmarkMap& map, const geometry::Pose2& T_map_base,
                                 const MatchCheckParams& params) {
  assert(beliefs.empty() || beliefs.size() == observations.size());
  ClassedMatchCounts counts;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const localization::Observation& o = observations[k];
    if (solution.outlier[k] || o.landmark == tracking::kNoLandmark) continue;
    const perception::Primitive& seen = scene.primitives[static_cast<std::size_t>(o.primitive)];
    const bool wrong = is_wrong_match(seen, scene.camera_origin, map, o.landmark, T_map_base, params);
    const double belief = beliefs.empty() ? 0.0 : beliefs[k];
    counts.classes[localization::fault_class(map.is_wall(o.landmark), belief, params.classes)] +=
        {.matches = 1, .wrong = wrong ? 1 : 0};
  }
  return counts;
}

}  // namespace credo::evaluation
