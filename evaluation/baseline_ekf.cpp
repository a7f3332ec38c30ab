// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_ekf.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "evaluation/consistency.hpp"

namespace credo::evaluation {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using geometry::Pose2;
using geometry::PoseEstimate;
using localization::Observation;
using localization::ObservationKind;
using localization::PoseState;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

/// An instrument that is not there is known to be off by nearly nothing, so that the covariance inverts.
constexpr double kNearlyNothing = 1e-10;

/// What all readings of an instrument share, from the accuracy of its calibration.
Eigen::Matrix<double, 6, 6> common_errors_of(const sensors::Rig& rig) {
  Eigen::Matrix<double, 6, 1> variances = Eigen::Matrix<double, 6, 1>::Constant(kNearlyNothing);
  if (!rig.range_finders.empty()) {
    const sensors::CalibrationAccuracy& a = rig.range_finders.front().accuracy;
    variances.head<3>() += Eigen::Vector3d(a.x_m * a.x_m, a.y_m * a.y_m, a.theta_rad * a.theta_rad);
  }
  if (rig.camera) {
    const sensors::CalibrationAccuracy& a = rig.camera->accuracy;
    const double harmonic = rig.camera->horizon_radius_px > 0.0 ? a.center_px / rig.camera->horizon_radius_px : 0.0;
    variances.tail<3>() += Eigen::Vector3d(a.theta_rad * a.theta_rad, harmonic * harmonic, harmonic * harmonic);
  }
  return variances.asDiagonal();
}

/// Of an observation's residual at a pose, plan included; a bearing's second row is a unit, so that it inverts.
Matrix2d residual_noise(const Observation& o, const Pose2& pose) {
  const Matrix2d R = pose.rotation();
  switch (o.kind) {
    case ObservationKind::kWall: return o.noise + o.plan;
    case ObservationKind::kPoint: return R * o.noise * R.transpose() + o.plan;
    case ObservationKind::kBearing: {
      const Vector2d way = o.map_point - pose * o.base_point;
      const Vector2d aside = Vector2d(-way.y(), way.x()) / std::max(way.squaredNorm(), 1e-4);
      return Vector2d(o.noise(0, 0) + aside.dot(o.plan * aside), 1.0).asDiagonal();
    }
  }
  return Matrix2d::Identity();
}

/// P(|e| < limit) of a normal e.
double probability_within(double limit, double variance) {
  return std::erf(limit / std::sqrt(2.0 * std::max(variance, 1e-18)));
}

}  // namespace

EkfLocalizer::EkfLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const PoseEstimate& initial,
                           const EkfParams& params)
    : params_(params),
      map_(plan, params.map),
      common_errors_(common_errors_of(rig)),
      motion_(initial),
      joint_(params.joint) {
  for (const int degrees : {1, 2}) gates_[degrees] = chi_square_quantile(params.gate_probability, degrees);
}

localization::Localization EkfLocalizer::update(const Scene& scene, const std::optional<PoseEstimate>& motion) {
  const PoseEstimate predicted = motion_.predict(motion, scene.time);
  State::Matrix covariance = State::Matrix::Zero();
  covariance.topLeftCorner<3, 3>() = predicted.covariance;
  covariance.bottomRightCorner<6, 6>() = common_errors_;
  covariance.block<3, 3>(State::kRangeX, State::kRangeX) += scene.carry_covariance;

  const Pairings candidates = pairings(scene, predicted.pose, covariance);
  const std::vector<int> chosen = params_.association == EkfAssociation::kJointCompatibility
                                      ? joint_.associate(candidates, covariance)
                                      : nearest_neighbours(candidates);
  const std::vector<Observation> seen = observations(scene, candidates, chosen, predicted.pose);
  const PoseEstimate estimate = corrected(predicted.pose, covariance, seen);
  motion_.correct(estimate, scene.time);

  const double matched = static_cast<double>(seen.size()) / std::max(1.0, static_cast<double>(scene.primitives.size()));
  const double heading = probability_within(geometry::to_radians(params_.lost_above_deg), estimate.covariance(2, 2));
  const double position = probability_within(params_.lost_above_m, estimate.covariance(0, 0)) *
                          probability_within(params_.lost_above_m, estimate.covariance(1, 1));
  localization::Localization fix = baseline_fix(scene.time, estimate, matched * position * heading);
  fix.detected = static_cast<int>(scene.primitives.size());
  fix.matched = static_cast<int>(seen.size());
  return fix;
}

Pairings EkfLocalizer::pairings(const Scene& scene, const Pose2& pose, const State::Matrix& covariance) const {
  Pairings result(scene.primitives.size());
  const Vector2d viewpoint = pose.translation();
  std::vector<tracking::LandmarkId> points;
  for (std::size_t k = 0; k < map_.points().size(); ++k)
    if (map_.shows(viewpoint, map_.points()[k].position)) points.push_back(map_.point_id(k));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Primitive& seen = scene.primitives[i];
    if (seen.type == PrimitiveType::kWall) {
      for (std::size_t w = 0; w < map_.walls().size(); ++w)
        pair(scene, seen, map_.wall_id(w), pose, covariance, result[i]);
    } else {
      for (const tracking::LandmarkId point : points) pair(scene, seen, point, pose, covariance, result[i]);
    }
    std::ranges::stable_sort(result[i], {}, &Pairing::distance_squared);
  }
  return result;
}

/// Adds the pairing to `found` where it is compatible on its own.
void EkfLocalizer::pair(const Scene& scene, const Primitive& seen, tracking::LandmarkId landmark, const Pose2& pose,
                        const State::Matrix& covariance, std::vector<Pairing>& found) const {
  if (!may_be(seen, landmark, pose)) return;
  const bool wall = map_.is_wall(landmark);
  const std::vector<bool> no_wall_in_use(scene.segments.size(), false);
  const Observation o =
      wall ? localization::observe_wall(seen, map_.wall(landmark), pose, map_.uncertainty_m(), params_.observations)
           : localization::observe_point(scene, seen, map_.point(landmark), no_wall_in_use, map_.uncertainty_m(),
                                         params_.observations);
  State::Vector x = State::Vector::Zero();
  x.head<3>() << pose.x, pose.y, pose.theta;
  Pairing p{.landmark = landmark, .exclusive = !wall, .rows = o.dimension(), .noise = residual_noise(o, pose)};
  localization::evaluate(o, x, p.residual, &p.by_state);
  const Matrix2d S = p.by_state * covariance * p.by_state.transpose() + p.noise;
  p.distance_squared = p.residual.dot(S.inverse() * p.residual);
  if (p.distance_squared <= gates_[p.rows]) found.push_back(p);
}

/// By its type, and for a wall by where it lies and whether the map's wall can be seen there.
bool EkfLocalizer::may_be(const Primitive& seen, tracking::LandmarkId landmark, const Pose2& pose) const {
  const Vector2d viewpoint = pose.translation();
  if (!map_.is_wall(landmark)) {
    if (seen.type == PrimitiveType::kOther) return true;
    return map_.type_from(map_.point(landmark), viewpoint) == seen.type;
  }
  const localization::WallLandmark& wall = map_.wall(landmark);
  const double along = wall.direction.dot(pose * seen.line.centroid - wall.extent.a);
  if (along < -params_.beyond_wall_m || along > wall.length_m + params_.beyond_wall_m) return false;
  return map_.shows(viewpoint, wall.extent.a + std::clamp(along, 0.0, wall.length_m) * wall.direction);
}

/// What is matched, for the update: walls first, so that points say only what their walls do not.
std::vector<Observation> EkfLocalizer::observations(const Scene& scene, const Pairings& pairings,
                                                    const std::vector<int>& chosen, const Pose2& pose) const {
  std::vector<Observation> result;
  std::vector<bool> wall_in_use(scene.segments.size(), false);
  for (const bool walls : {true, false}) {
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i] < 0) continue;
      const Primitive& seen = scene.primitives[i];
      const tracking::LandmarkId landmark = pairings[i][static_cast<std::size_t>(chosen[i])].landmark;
      if (map_.is_wall(landmark) != walls) continue;
      result.push_back(walls ? localization::observe_wall(seen, map_.wall(landmark), pose, map_.uncertainty_m(),
                                                          params_.observations)
                             : localization::observe_point(scene, seen, map_.point(landmark), wall_in_use,
                                                           map_.uncertainty_m(), params_.observations));
      if (!walls) continue;
      for (int s = seen.first_segment; s >= 0 && s <= seen.last_segment; ++s)
        wall_in_use[static_cast<std::size_t>(s)] = true;
    }
  }
  return result;
}

/// The update with all observations at once, in information form; of the state only the pose is kept.
PoseEstimate EkfLocalizer::corrected(const Pose2& predicted, const State::Matrix& covariance,
                                     const std::vector<Observation>& seen) const {
  const State::Matrix prior = covariance.inverse();
  State::Vector start = State::Vector::Zero();
  start.head<3>() << predicted.x, predicted.y, predicted.theta;
  State::Vector x = start;
  State::Matrix information = prior;
  for (int iteration = 0; iteration < params_.iterations; ++iteration) {
    information = prior;
    State::Vector gradient = prior * (start - x);
    for (const Observation& o : seen) {
      Vector2d residual;
      State::Jacobian J;
      localization::evaluate(o, x, residual, &J);
      const Eigen::Matrix<double, State::kSize, 2> weighted =
          J.transpose() * residual_noise(o, {x(0), x(1), x(2)}).inverse();
      information += weighted * J;
      gradient -= weighted * residual;
    }
    x += information.ldlt().solve(gradient);
  }
  const State::Matrix posterior = information.ldlt().solve(State::Matrix::Identity());
  return {{x(0), x(1), geometry::wrap_angle(x(2))}, posterior.topLeftCorner<3, 3>()};
}

}  // namespace credo::evaluation
