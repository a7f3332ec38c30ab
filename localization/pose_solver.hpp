// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "localization/calibrated_pose.hpp"
#include "localization/pose_residuals.hpp"

namespace credo::localization {

struct PoseSolverParams {
  double robust_scale = 2.5;          ///< Cauchy loss, in standard deviations per degree of freedom
  int reweightings = 5;               ///< of the robust loss
  double doubtful_step = 11.3;        ///< squared Mahalanobis distance from the prior (chi-square, 3, 1 %), or
  double doubtful_share = 0.2;        ///< of the observations pulled to less than half their weight: a solution from
                                      ///< the prior is tried too
  double outlier_probability = 1e-4;  ///< a residual less likely than this is no match
};

/// An observation as the solution used it, linearised there; what the prior tells of the plan's error is taken out.
struct LinearisedObservation {
  tracking::LandmarkId landmark = tracking::kNoLandmark;
  ObservationKind kind = ObservationKind::kWall;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  PoseState::Jacobian by_state = PoseState::Jacobian::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< robust weight included; a bearing's second row is idle
};

/// The pose and what came of each observation.
struct PoseSolution {
  CalibratedPose pose;
  /// The common errors as they explain this acquisition best: those of `pose`, and the scan's with the error of the
  /// motion that it was carried over.
  Eigen::Matrix<double, 6, 1> common_errors = Eigen::Matrix<double, 6, 1>::Zero();
  std::vector<double> mahalanobis_squared;                        ///< of each observation's residual at the solution
  std::vector<bool> outlier;                                      ///< by PoseSolverParams::outlier_probability
  std::vector<LinearisedObservation> linearised;                  ///< one for each observation
  PoseState::Matrix information = PoseState::Matrix::Identity();  ///< of the state: prior and all of `linearised`

  PoseState::Matrix prior_information = PoseState::Matrix::Identity();  ///< of the state before
  PoseState::Vector step = PoseState::Vector::Zero();                   ///< from the state before
  PlanCovariance prior_with_plan;                                       ///< of the state before

  [[nodiscard]] geometry::PoseEstimate estimate() const { return pose.estimate(); }
};

/// Pose and calibration from everything matched: robust least squares on walls, points and bearings with a prior
/// (Ceres' TinySolver). Errors that all readings of an instrument share (its mounting, the mirror's centre) are
/// unknowns of their own. The covariance is that of the gain that was used, whatever is correlated (Joseph's form):
/// it stays honest although the plan's errors repeat from one acquisition to the next and from a wall to its corners.
class PoseSolver {
 public:
  explicit PoseSolver(const PoseSolverParams& params = {});
  ~PoseSolver();
  PoseSolver(PoseSolver&&) noexcept;
  PoseSolver& operator=(PoseSolver&&) noexcept;

  /// \param prior  its joint covariance is positive definite
  /// \param observations  their plan_terms name junctions of `prior.with_plan`
  /// \param carry_covariance  Scene::carry_covariance
  /// \returns a reference that stays valid until the next call; the prior itself where there is no observation.
  const PoseSolution& solve(const CalibratedPose& prior, const std::vector<Observation>& observations,
                            const Eigen::Matrix3d& carry_covariance = Eigen::Matrix3d::Zero());

  /// The same in two steps, for where a pose is soon replaced by a better one. First all but the covariances with the
  /// plan's errors, of which `solution` keeps those that it has.
  /// \param prior  has to live until the second step
  void solve_state(const CalibratedPose& prior, const std::vector<Observation>& observations,
                   const Eigen::Matrix3d& carry_covariance, PoseSolution& solution);
  /// The covariances with the plan's errors of the latest solution: `pose.with_plan` and `prior_with_plan`.
  void solve_plan(PoseSolution& solution) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::localization
