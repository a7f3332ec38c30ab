// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <span>

#include "localization/calibrated_pose.hpp"
#include "localization/landmark_map.hpp"

namespace credo::localization {

/// What of a landmark was measured, and which residual follows from it.
enum class ObservationKind {
  kWall,     ///< a line: (offset across the map's line at the observed centroid, angle modulo pi)
  kPoint,    ///< a position: (x, y) in the map frame
  kBearing,  ///< an azimuth from the camera: (angle, unused)
};

/// One matched feature. The covariances of its residual are kept apart: `noise` is fresh in every acquisition, `plan`
/// is the map's own error, which comes again whenever the landmark is seen again.
struct Observation {
  ObservationKind kind = ObservationKind::kWall;
  tracking::LandmarkId landmark = tracking::kNoLandmark;
  int primitive = -1;                                    ///< index into Scene::primitives
  int track = -1;                                        ///< index into Tracker::tracks(), -1 before it has one
  Eigen::Vector2d map_point = Eigen::Vector2d::Zero();   ///< a point of the map's line, or the map's point
  double map_angle = 0.0;                                ///< of the map's line [rad]
  Eigen::Vector2d base_point = Eigen::Vector2d::Zero();  ///< centroid, position, or origin of the bearing; base frame
  double base_angle = 0.0;                               ///< of the observed line, or the bearing [rad]
  Eigen::Matrix2d noise =
      Eigen::Matrix2d::Zero();  ///< of (across, angle), of the position in the base frame, or (0, 0) of the bearing
  Eigen::Matrix2d plan = Eigen::Matrix2d::Zero();  ///< of (across, angle), of the position in the map frame, or of the
                                                   ///< position for a bearing
  /// Which errors of the plan make `plan`: those of its junctions, as WallLandmark and PointLandmark have it, a view of
  /// the map; and the landmark's own. Empty: nobody knows with what it goes, and it counts as noise.
  std::span<const PlanTerm> plan_terms;
  double plan_along_m = 0.0;   ///< where on the wall it was taken
  double plan_sigma_m = 0.0;   ///< of each coordinate of a junction
  int own_column = 0;          ///< of CalibratedPose::with_plan
  double own_sigma_m = 0.0;    ///< across a wall, of each coordinate of a point
  double own_sigma_rad = 0.0;  ///< of a wall's angle

  [[nodiscard]] int dimension() const { return kind == ObservationKind::kBearing ? 1 : 2; }
};

/// A state's pose as a transform, its sine and cosine taken once for all observations.
struct StateFrame {
  explicit StateFrame(const PoseState::Vector& state);
  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& point) const { return R * point + t; }

  Eigen::Matrix2d R;
  Eigen::Vector2d t;
};

/// What does not change with the state: the unit vector along the map's line, or along the bearing in the base frame.
[[nodiscard]] Eigen::Vector2d fixed_direction(const Observation& observation);

/// The residual of an observation at a state, and its Jacobian. The second row of a bearing is 0.
/// \param fixed  fixed_direction(observation)
/// \param frame  StateFrame(state)
void evaluate(const Observation& observation, const Eigen::Vector2d& fixed, const StateFrame& frame,
              const PoseState::Vector& state, Eigen::Vector2d& residual, PoseState::Jacobian* jacobian);
void evaluate(const Observation& observation, const PoseState::Vector& state, Eigen::Vector2d& residual,
              PoseState::Jacobian* jacobian);
/// The same where nothing is off in common.
void evaluate(const Observation& observation, const geometry::Pose2& pose, Eigen::Vector2d& residual);

/// The covariances of an observation's residual at a pose; a bearing's second row is a unit, so that it inverts.
struct ResidualCovariance {
  Eigen::Matrix2d noise;
  Eigen::Matrix2d plan;

  [[nodiscard]] Eigen::Matrix2d whole() const { return noise + plan; }
};
/// \param by_landmark  residual_by_landmark(observation, frame)
[[nodiscard]] ResidualCovariance residual_covariance(const Observation& observation, const StateFrame& frame,
                                                     const Eigen::Matrix2d& by_landmark);
[[nodiscard]] ResidualCovariance residual_covariance(const Observation& observation, const StateFrame& frame);

/// Derivative of the residual by what the landmark is off: (across, angle) of a wall's line where it was observed, (x,
/// y) of a point. Observation::plan is the covariance of that.
[[nodiscard]] Eigen::Matrix2d residual_by_landmark(const Observation& observation, const StateFrame& frame);

/// By how much a landmark is off with two of the plan's errors, which have a column each in CalibratedPose::with_plan.
struct LandmarkByPlan {
  int column = 0;  ///< the first of two
  Eigen::Matrix2d derivative = Eigen::Matrix2d::Zero();
};
/// \param index  0 .. plan_terms.size() - 1: the junctions; plan_terms.size(): the landmark's own
/// \param fixed  fixed_direction(observation)
[[nodiscard]] LandmarkByPlan landmark_by_plan(const Observation& observation, std::size_t index,
                                              const Eigen::Vector2d& fixed);
/// How many of them there are.
[[nodiscard]] inline std::size_t plan_count(const Observation& observation) {
  return observation.plan_terms.empty() ? 0 : observation.plan_terms.size() + 1;
}

}  // namespace credo::localization
