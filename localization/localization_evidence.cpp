// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localization_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

/// Where something lies that is no landmark.
enum class PlanAgreement {
  kOnPlan,  ///< on a wall of the plan
  kBefore,  ///< where the plan has free space
  kBehind   ///< behind a wall of the plan: it cannot be seen there
};

/// Whether an observation that satisfies the predicate agrees with the pose.
template <class Predicate>
bool any_agreeing(std::span<const Observation> observations, const PoseSolution& solution, Predicate&& predicate) {
  for (std::size_t k = 0; k < observations.size(); ++k)
    if (!solution.outlier[k] && predicate(observations[k])) return true;
  return false;
}

PlanAgreement agreement_of(const Primitive& primitive, const LandmarkMap& map, const geometry::PoseEstimate& estimate,
                           const LocalizationEvidenceParams& params) {
  const Vector2d viewpoint = estimate.pose.translation();
  const Vector2d seen = estimate.pose * primitive.position;
  const Matrix3d& P = estimate.covariance;
  const double sigma =
      std::sqrt(P(0, 0) + P(1, 1) + P(2, 2) * primitive.range_m * primitive.range_m +
                primitive.sigma_range_m * primitive.sigma_range_m + map.uncertainty_m() * map.uncertainty_m());
  const double tolerance =
      std::clamp(params.on_plan_sigmas * sigma, params.on_plan_m, std::max(params.on_plan_m, params.on_plan_at_most_m));
  if (map.on_surface(seen, tolerance)) return PlanAgreement::kOnPlan;
  return map.sees(viewpoint, seen, tolerance) ? PlanAgreement::kBefore : PlanAgreement::kBehind;
}

/// Adds a primitive that no landmark explains, under the default method.
void add_unexplained(const Primitive& primitive, PlanAgreement agreement, const LocalizationEvidenceParams& params,
                     LocalizationEvidence& evidence) {
  const double believed = primitive.existence.pignistic();
  if (agreement != PlanAgreement::kOnPlan) {
    evidence.detected += believed * (agreement == PlanAgreement::kBefore ? params.unmapped_weight : 1.0);
    return;
  }
  if (primitive.type == PrimitiveType::kOther) return;
  // A junction that the plan does not have where it has a wall is a contradiction; a wall may be a curve's face.
  evidence.detected += params.on_plan_weight * believed;
  if (primitive.type == PrimitiveType::kWall) evidence.explained += params.on_plan_weight * believed;
}

/// Whether a place may be hidden by something that the plan does not have: the next beams on either side end nearer, or
/// none passes near enough to tell. Without a scan nothing is known to hide anything.
/// \param place  in the base frame
bool hidden_by_clutter(const Scene& scene, const Vector2d& place, const LocalizationEvidenceParams& params) {
  if (scene.points.empty()) return false;
  const double distance = place.norm();
  const Vector2d direction = place / std::max(distance, 1e-9);
  double left = params.beside_rad, right = params.beside_rad;  // how far beside the next beams pass
  bool free_left = false, free_right = false;
  for (const sensors::ScanPoint& point : scene.points) {
    const double along = point.position.dot(direction);
    if (!(along > 0.0)) continue;
    const double beside = (direction.x() * point.position.y() - direction.y() * point.position.x()) / along;
    const bool free = along >= distance - params.clutter_m;
    if (beside >= 0.0 && beside < left) {
      left = beside;
      free_left = free;
    }
    if (beside < 0.0 && -beside < right) {
      right = -beside;
      free_right = free;
    }
  }
  return !free_left && !free_right;
}

/// Points of the plan that should be seen from the pose, and those that are. Marks without relief are the camera's
/// alone.
void count_points_in_sight(const Scene& scene, const LandmarkMap& map, std::span<const Observation> observations,
                           const PoseSolution& solution, const LocalizationEvidenceParams& params,
                           LocalizationEvidence& evidence) {
  const Vector2d viewpoint = solution.pose.pose.translation();
  const geometry::Pose2 T_base_map = solution.pose.pose.inverse();
  for (std::size_t k = 0; k < map.points().size(); ++k) {
    const PointLandmark& point = map.points()[k];
    const bool hidden = (point.position - viewpoint).norm() > params.sight_m ||
                        !(point.vertical ? scene.camera_seen : scene.camera_seen || scene.range_finder_seen) ||
                        !map.type_from(point, viewpoint) || !map.shows(viewpoint, point.position);
    if (hidden) continue;
    const auto is_it = [id = map.point_id(k)](const Observation& o) { return o.landmark == id; };
    const bool recognised = any_agreeing(observations, solution, is_it);
    if (!recognised && hidden_by_clutter(scene, T_base_map * point.position, params)) continue;
    ++evidence.in_sight;
    evidence.recognised += recognised ? 1 : 0;
  }
}

}  // namespace

LocalizationEvidence gather_evidence(const Scene& scene, const LandmarkMap& map,
                                     std::span<const Observation> observations, const PoseSolution& solution,
                                     const LocalizationEvidenceParams& params) {
  LocalizationEvidence evidence;
  evidence.camera_seen = scene.camera_seen;
  evidence.range_finder_seen = scene.range_finder_seen;
  count_points_in_sight(scene, map, observations, solution, params, evidence);
  const geometry::PoseEstimate estimate = solution.estimate();
  for (std::size_t p = 0; p < scene.primitives.size(); ++p) {
    const Primitive& primitive = scene.primitives[p];
    const auto is_it = [p](const Observation& o) { return o.primitive == static_cast<int>(p); };
    const bool explained = any_agreeing(observations, solution, is_it);
    evidence.matched += explained ? 1 : 0;
    if (params.method == perception::Method::kPaper) {
      evidence.detected += 1.0;
      evidence.explained += explained ? 1.0 : 0.0;
    } else if (!primitive.bearing_only && explained) {
      evidence.detected += primitive.existence.pignistic();
      evidence.explained += primitive.existence.pignistic();
    } else if (!primitive.bearing_only) {
      add_unexplained(primitive, agreement_of(primitive, map, estimate, params), params, evidence);
    }
  }
  return evidence;
}

}  // namespace credo::localization
