// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "localization/calibrated_pose.hpp"
#include "localization/pose_residuals.hpp"

namespace credo::localization {

/// a - b, the heading wrapped.
[[nodiscard]] PoseState::Vector difference(const PoseState::Vector& a, const PoseState::Vector& b);

/// What is known before an acquisition. The motion that the scan was carried over adds an error to it that is fresh in
/// each acquisition, and gone in the next.
struct PosePrior {
  const CalibratedPose* pose = nullptr;
  PoseState::Vector state = PoseState::Vector::Zero();
  Eigen::Matrix3d carry = Eigen::Matrix3d::Zero();
  PoseState::Matrix information = PoseState::Matrix::Zero();  ///< the carry's error included

  /// Squared Mahalanobis distance of a state's pose.
  [[nodiscard]] double step_squared(const PoseState::Vector& x) const;
};

/// An observation in the least squares.
struct ObservationTerm {
  // Whatever the state.
  Eigen::Vector2d fixed = Eigen::Vector2d::Zero();          ///< fixed_direction()
  PoseState::Pair with_landmark = PoseState::Pair::Zero();  ///< covariance of the state with what the landmark is off
  PoseState::Jacobian landmark_by_step = PoseState::Jacobian::Zero();  ///< what a step from the prior tells of that
  Eigen::Matrix2d told = Eigen::Matrix2d::Zero();                      ///< covariance of what it tells

  // At the state of the latest linearisation.
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  PoseState::Jacobian by_state = PoseState::Jacobian::Zero();

  // At the state where the weights were found.
  Eigen::Matrix2d by_landmark = Eigen::Matrix2d::Zero();      ///< residual_by_landmark()
  PoseState::Jacobian by_step = PoseState::Jacobian::Zero();  ///< of the residual, through what the step tells
  ResidualCovariance covariance;
  double weight = 1.0;                                 ///< of the robust loss
  Eigen::Matrix2d whitener = Eigen::Matrix2d::Zero();  ///< U^T U = rest()^-1; of a bearing, the first row

  /// Covariance of the residual beside by_step * step.
  [[nodiscard]] Eigen::Matrix2d rest() const {
    return (covariance.whole() - by_landmark * told * by_landmark.transpose()) / weight;
  }
};

/// Robust least squares on the state: a prior and observations, whose landmarks share the plan's errors with it. Keeps
/// its memory.
class PoseProblem {
 public:
  PoseProblem();

  /// \param prior, observations  have to outlive the problem; plan_terms name junctions of `prior.with_plan`
  /// \param carry  Scene::carry_covariance
  void take(const CalibratedPose& prior, const Eigen::Matrix3d& carry, std::span<const Observation> observations);

  /// Residuals and their derivatives at a state.
  void linearise(const PoseState::Vector& x);

  /// Linearises, and finds the robust weights: Cauchy's 1 / (1 + s / c^2), or its square (Geman and McClure), under
  /// which an observation that is far off pulls no more.
  /// \param scale  c^2, of a squared residual per degree of freedom in standard deviations
  void reweight(const PoseState::Vector& x, double scale, bool bounded);
  /// The weights become 1.
  void trust_all();

  /// Sum of all squared residuals, whitened and weighted. Linearises.
  [[nodiscard]] double squared_sum(const PoseState::Vector& x);
  /// Upper triangular, with the moments U^T U = [J e]^T [J e] of all whitened and weighted residuals e and their
  /// derivatives J: ten rows that stand for all in the least squares. Linearises.
  using Moments = Eigen::Matrix<double, PoseState::kSize + 1, PoseState::kSize + 1>;
  [[nodiscard]] Moments moments_root(const PoseState::Vector& x);

  /// What the prior and the observations have against a state, an observation's share bounded (Geman and McClure).
  [[nodiscard]] double bounded_cost(const PoseState::Vector& x, double scale) const;

  [[nodiscard]] const PosePrior& prior() const { return prior_; }
  [[nodiscard]] std::span<const Observation> observations() const { return observations_; }
  [[nodiscard]] const std::vector<ObservationTerm>& terms() const { return terms_; }

 private:
  PosePrior prior_;
  std::span<const Observation> observations_;
  std::vector<ObservationTerm> terms_;
  Eigen::Matrix<double, Eigen::Dynamic, PoseState::kSize + 1> rows_;  ///< [J e] of the observations, a workspace
  PoseState::Vector linearised_at_;
};

}  // namespace credo::localization
