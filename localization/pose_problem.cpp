// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_problem.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "localization/positive_definite.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Squared residual per degree of freedom in standard deviations.
double normalised_square(const Observation& o, const ResidualCovariance& covariance, const Vector2d& residual) {
  const Matrix2d whole = covariance.whole();
  if (o.dimension() == 1) return residual.x() * residual.x() / whole(0, 0);
  return residual.dot(whole.inverse() * residual) / o.dimension();
}

/// U, upper triangular, with U^T U = covariance^-1; of one dimension, the first row alone.
Matrix2d whitener(const Matrix2d& covariance, int dimension) {
  Matrix2d U = Matrix2d::Zero();
  if (dimension == 1) {
    U(0, 0) = 1.0 / std::sqrt(covariance(0, 0));
    return U;
  }
  const double sigma = std::sqrt(covariance(1, 1)), area = std::sqrt(covariance.determinant());
  U << covariance(1, 1), -covariance(0, 1), 0.0, area;
  return U / (sigma * area);
}

/// What a step from the prior tells of the landmark's errors p: -(with_landmark)^T P^-1 step, for a pose that the plan
/// has drawn aside is likely to be drawn aside again.
ObservationTerm term_of(const Observation& o, const PosePrior& prior) {
  ObservationTerm term;
  term.fixed = fixed_direction(o);
  for (std::size_t i = 0; i < plan_count(o); ++i) {
    const auto [column, derivative] = landmark_by_plan(o, i, term.fixed);
    term.with_landmark += prior.pose->with_plan[column] * derivative.transpose();
  }
  term.landmark_by_step = term.with_landmark.transpose() * prior.information;
  term.told = term.landmark_by_step * term.with_landmark;
  return term;
}

}  // namespace

PoseState::Vector difference(const PoseState::Vector& a, const PoseState::Vector& b) {
  PoseState::Vector step = a - b;
  step(PoseState::kTheta) = geometry::wrap_angle(step(PoseState::kTheta));
  return step;
}

double PosePrior::step_squared(const PoseState::Vector& x) const {
  const Vector3d step = difference(x, state).head<3>();
  return step.dot(pose->covariance().inverse() * step);
}

PoseProblem::PoseProblem() {
  constexpr std::size_t kUsualObservations = 256;
  terms_.reserve(kUsualObservations);
  rows_.resize(2 * kUsualObservations, Eigen::NoChange);
}

void PoseProblem::take(const CalibratedPose& prior, const Matrix3d& carry, std::span<const Observation> observations) {
  prior_.pose = &prior;
  prior_.state = prior.state();
  prior_.carry = carry;
  PoseState::Matrix covariance = prior.joint;
  covariance.block<3, 3>(PoseState::kRangeX, PoseState::kRangeX) += carry;
  prior_.information = inverse(covariance);
  observations_ = observations;
  terms_.clear();
  for (const Observation& o : observations) terms_.push_back(term_of(o, prior_));
  linearised_at_.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void PoseProblem::linearise(const PoseState::Vector& x) {
  if (x == linearised_at_) return;
  linearised_at_ = x;
  const StateFrame frame(x);
  for (std::size_t k = 0; k < terms_.size(); ++k)
    evaluate(observations_[k], terms_[k].fixed, frame, x, terms_[k].residual, &terms_[k].by_state);
}

void PoseProblem::reweight(const PoseState::Vector& x, double scale, bool bounded) {
  linearise(x);
  const StateFrame frame(x);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Observation& o = observations_[k];
    ObservationTerm& term = terms_[k];
    term.by_landmark = residual_by_landmark(o, frame);
    term.covariance = residual_covariance(o, frame, term.by_landmark);
    term.by_step = term.by_landmark * term.landmark_by_step;
    const double cauchy = 1.0 / (1.0 + normalised_square(o, term.covariance, term.residual) / scale);
    term.weight = bounded ? cauchy * cauchy : cauchy;
    term.whitener = whitener(term.rest(), o.dimension());
  }
}

void PoseProblem::trust_all() {
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    ObservationTerm& term = terms_[k];
    term.weight = 1.0;
    term.whitener = whitener(term.rest(), observations_[k].dimension());
  }
}

double PoseProblem::squared_sum(const PoseState::Vector& x) {
  linearise(x);
  const PoseState::Vector step = difference(x, prior_.state);
  double sum = step.dot(prior_.information * step);
  for (const ObservationTerm& term : terms_)
    sum += (term.whitener * (term.residual + term.by_step * step)).squaredNorm();
  return sum;
}

PoseProblem::Moments PoseProblem::moments_root(const PoseState::Vector& x) {
  linearise(x);
  const PoseState::Vector step = difference(x, prior_.state);
  const PoseState::Vector gradient = prior_.information * step;
  Moments moments;
  moments << prior_.information, gradient, gradient.transpose(), step.dot(gradient);
  const auto most = static_cast<Eigen::Index>(2 * terms_.size());
  if (rows_.rows() < most) rows_.resize(most, Eigen::NoChange);
  Eigen::Index count = 0;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const ObservationTerm& term = terms_[k];
    Eigen::Matrix<double, 2, PoseState::kSize + 1> raw;
    raw << term.by_state + term.by_step, term.residual + term.by_step * step;
    if (observations_[k].dimension() == 1) {  // the second row is idle
      rows_.row(count++) = term.whitener(0, 0) * raw.row(0);
      continue;
    }
    rows_.middleRows<2>(count) = term.whitener * raw;
    count += 2;
  }
  const auto rows = rows_.topRows(count);
  moments.triangularView<Eigen::Upper>() += rows.transpose().lazyProduct(rows);
  return root<PoseState::kSize + 1>(moments);
}

double PoseProblem::bounded_cost(const PoseState::Vector& x, double scale) const {
  const StateFrame frame(x);
  double cost = prior_.step_squared(x);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const Observation& o = observations_[k];
    Vector2d residual;
    evaluate(o, terms_[k].fixed, frame, x, residual, nullptr);
    const double squared = normalised_square(o, residual_covariance(o, frame), residual);
    cost += o.dimension() * scale * squared / (scale + squared);
  }
  return cost;
}

}  // namespace credo::localization
