// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/acquisition.hpp"
#include "tracking/track.hpp"

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

  [[nodiscard]] int dimension() const { return kind == ObservationKind::kBearing ? 1 : 2; }
};

/// A pose whose error has two parts: one that is independent of everything measured later (noise), and one that may be
/// correlated with it to any degree (the plan's errors, met again and again).
struct SplitPose {
  geometry::Pose2 pose;
  Eigen::Matrix3d independent = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d correlated = Eigen::Matrix3d::Zero();

  [[nodiscard]] Eigen::Matrix3d covariance() const { return independent + correlated; }
};

struct PoseSolverParams {
  double robust_scale = 2.5;          ///< Cauchy loss, in standard deviations per degree of freedom
  int reweightings = 4;               ///< of the robust loss
  double doubtful_step = 11.3;        ///< squared Mahalanobis distance from the prior (chi-square, 3, 1 %), or
  double doubtful_share = 0.2;        ///< of the observations pulled to less than half their weight: a solution from
                                      ///< the prior is tried too
  double outlier_probability = 1e-4;  ///< a residual less likely than this is no match
};

/// What is estimated: the pose and what all readings of an instrument have in common.
struct PoseState {
  enum Index { kX, kY, kTheta, kRangeX, kRangeY, kRangeTheta, kCameraTheta, kCameraCos, kCameraSin, kSize };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Jacobian = Eigen::Matrix<double, 2, kSize>;  ///< of a residual
};

/// An observation as the solution used it, linearised there.
struct LinearisedObservation {
  tracking::LandmarkId landmark = tracking::kNoLandmark;
  ObservationKind kind = ObservationKind::kWall;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  PoseState::Jacobian by_state = PoseState::Jacobian::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< robust weight included; a bearing's second row is idle
};

/// The pose and what came of each observation.
struct PoseSolution {
  SplitPose pose;
  /// The common errors as they explain this acquisition best: of the scan (x, y, theta in the base frame), of the
  /// camera's yaw and of its first harmonic, which a mirror off its centre makes. [m, m, rad, rad, rad, rad]
  Eigen::Matrix<double, 6, 1> common_errors = Eigen::Matrix<double, 6, 1>::Zero();
  std::vector<double> mahalanobis_squared;                        ///< of each observation's residual at the solution
  std::vector<bool> outlier;                                      ///< by PoseSolverParams::outlier_probability
  double prior_mahalanobis_squared = 0.0;                         ///< of the step from the prior
  std::vector<LinearisedObservation> linearised;                  ///< one for each observation
  PoseState::Matrix information = PoseState::Matrix::Identity();  ///< of the state: prior and all of `linearised`

  [[nodiscard]] geometry::PoseEstimate estimate() const { return {pose.pose, pose.covariance()}; }
};

/// The residual of an observation at a state, and its Jacobian. The second row of a bearing is 0.
void evaluate(const Observation& observation, const PoseState::Vector& state, Eigen::Vector2d& residual,
              PoseState::Jacobian* jacobian);
/// The same where nothing is off in common.
void evaluate(const Observation& observation, const geometry::Pose2& pose, Eigen::Vector2d& residual);

/// Pose from everything matched: robust least squares on walls, points and bearings with a prior (Ceres' TinySolver),
/// and a covariance by split covariance intersection (Julier and Uhlmann 2001), which stays honest although the plan's
/// errors repeat from one acquisition to the next. Errors that all readings of an instrument share (its mounting, the
/// mirror's centre, the motion over which a scan was carried) are unknowns of their own with a prior.
class PoseSolver {
 public:
  explicit PoseSolver(const sensors::Rig& rig, const PoseSolverParams& params = {});
  ~PoseSolver();
  PoseSolver(PoseSolver&&) noexcept;
  PoseSolver& operator=(PoseSolver&&) noexcept;

  /// \param prior  its covariance is positive definite
  /// \param carry_covariance  Scene::carry_covariance
  /// \returns a reference that stays valid until the next call; the prior itself where there is no observation.
  const PoseSolution& solve(const SplitPose& prior, const std::vector<Observation>& observations,
                            const Eigen::Matrix3d& carry_covariance = Eigen::Matrix3d::Zero());
  /// The latest one.
  [[nodiscard]] const PoseSolution& solution() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::localization
