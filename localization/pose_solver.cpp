// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_solver.hpp"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Gain = Eigen::Matrix<double, PoseState::kSize, 2>;
using ScanColumns = Eigen::Matrix<double, PoseState::kSize, 3>;

geometry::Pose2 pose_of(const PoseState::Vector& x) {
  return {x(PoseState::kX), x(PoseState::kY), x(PoseState::kTheta)};
}

PoseState::Vector difference(const PoseState::Vector& a, const PoseState::Vector& b) {
  PoseState::Vector step = a - b;
  step(PoseState::kTheta) = geometry::wrap_angle(step(PoseState::kTheta));
  return step;
}

/// U, upper triangular, with U^T U = information, so that |U e|^2 = e^T information e. Cholesky's decomposition in
/// plain numbers: Eigen's takes seconds to compile for each size.
template <int kRows>
Eigen::Matrix<double, kRows, kRows> whitener(const Eigen::Matrix<double, kRows, kRows>& information) {
  Eigen::Matrix<double, kRows, kRows> U = Eigen::Matrix<double, kRows, kRows>::Zero();
  for (int i = 0; i < kRows; ++i) {
    for (int j = i; j < kRows; ++j) {
      double rest = information(i, j);
      for (int k = 0; k < i; ++k) rest -= U(k, i) * U(k, j);
      U(i, j) = i == j ? std::sqrt(rest) : rest / U(i, i);
    }
  }
  return U;
}

/// Inverse of a positive definite matrix. One decomposition and one right-hand side at a time, as TinySolver does it:
/// Eigen's general inverse takes long to compile. Scaled to a unit diagonal beforehand, for metres stand beside
/// milliradians.
PoseState::Matrix inverse(const PoseState::Matrix& positive) {
  const PoseState::Vector scale = positive.diagonal().cwiseSqrt().cwiseInverse();
  const PoseState::Matrix scaled = scale.asDiagonal() * positive * scale.asDiagonal();
  const Eigen::LDLT<PoseState::Matrix> decomposed(scaled);
  PoseState::Matrix inverted;
  for (int i = 0; i < PoseState::kSize; ++i) {
    const PoseState::Vector unit = PoseState::Vector::Unit(i);
    inverted.col(i) = decomposed.solve(unit);
  }
  const PoseState::Matrix unscaled = scale.asDiagonal() * inverted * scale.asDiagonal();
  return 0.5 * (unscaled + unscaled.transpose());
}

/// What is known before an acquisition. The motion that the scan was carried over adds an error to it that is fresh in
/// each acquisition, and gone in the next.
struct Prior {
  const CalibratedPose* pose = nullptr;
  PoseState::Vector state;
  Matrix3d carry;
};

/// An observation linearised at a state.
struct Linearised {
  PoseState::Jacobian by_state;
  PoseState::Jacobian by_step;  ///< by the step from the prior: through the plan's errors that it tells of
  ResidualCovariance covariance;
  Matrix2d known;       ///< covariance of the part of the residual that by_step tells
  double weight = 1.0;  ///< of the robust loss

  /// Of the residual beside by_step * step.
  [[nodiscard]] Matrix2d rest() const { return (covariance.whole() - known) / weight; }
};

/// Squared residual per degree of freedom in standard deviations.
double normalised_square(const Observation& o, const ResidualCovariance& covariance, const Vector2d& residual) {
  return residual.dot(covariance.whole().inverse() * residual) / o.dimension();
}

/// Squared Mahalanobis distance of a state's pose from the prior.
double step_squared(const Prior& prior, const PoseState::Vector& x) {
  const Vector3d step = difference(x, prior.state).head<3>();
  return step.dot(prior.pose->covariance().inverse() * step);
}

/// Whitened residuals of the prior on the state (9 rows) and of all observations (2 rows each), for ceres::TinySolver.
struct WhitenedResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = PoseState::kSize };

  PoseState::Vector prior = PoseState::Vector::Zero();
  PoseState::Matrix prior_whitener;
  const std::vector<Observation>* observations = nullptr;
  std::vector<Vector2d> directions;  ///< fixed_direction of each
  std::vector<Matrix2d> whiteners;   ///< square root of the robust weight included
  std::vector<PoseState::Jacobian> by_step;

  [[nodiscard]] int NumResiduals() const { return PoseState::kSize + 2 * static_cast<int>(observations->size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const PoseState::Vector x = Eigen::Map<const PoseState::Vector>(parameters);
    Eigen::Map<Eigen::VectorXd> e(residuals, NumResiduals());
    const PoseState::Vector step = difference(x, prior);
    e.head<PoseState::kSize>() = prior_whitener * step;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, PoseState::kSize>> J(jacobian, jacobian ? NumResiduals() : 0,
                                                                          PoseState::kSize);
    if (jacobian) J.topRows<PoseState::kSize>() = prior_whitener;
    const StateFrame frame(x);
    for (std::size_t k = 0; k < observations->size(); ++k) {
      Vector2d raw;
      PoseState::Jacobian by_state;
      evaluate((*observations)[k], directions[k], frame, x, raw, jacobian ? &by_state : nullptr);
      const auto row = static_cast<Eigen::Index>(PoseState::kSize + 2 * k);
      e.segment<2>(row) = whiteners[k] * (raw + by_step[k] * step);
      if (jacobian) J.middleRows<2>(row) = whiteners[k] * (by_state + by_step[k]);
    }
    return true;
  }
};

/// Quantile of chi-square with 1 or 2 degrees of freedom at 1 - p: exact for 2, within 1 % for 1 and p in 1e-6 .. 1e-2.
double chi_square_gate(int dimension, double p) {
  const double two = -2.0 * std::log(p);
  if (dimension == 2) return two;
  // Tail of the normal distribution: p = 2 Q(z), Q(z) ~ exp(-z^2 / 2) / (z sqrt(2 pi)); z by fixed-point iteration.
  double squared = two;
  for (int i = 0; i < 20; ++i) squared = two - std::log(squared * 0.5 * std::numbers::pi * (1.0 + 2.0 / squared));
  return squared;
}

}  // namespace

struct PoseSolver::State {
  PoseSolverParams params;
  std::array<double, 2> gates{};  ///< of a squared residual with 1 and with 2 dimensions
  ceres::TinySolver<WhitenedResiduals> solver;
  Prior prior;
  WhitenedResiduals residuals;
  std::vector<Linearised> linearised;
  std::vector<Gain> gains;
  PoseState::Columns by_plan;  ///< gains times the derivatives by the plan's errors
  PoseSolution solution;

  /// Where the iterations start from.
  enum class Start {
    kAll,    ///< the observations, all of them
    kPrior,  ///< the prior: what contradicts it has to be borne out by more than it contradicts
  };

  void take(const CalibratedPose& pose, const Matrix3d& carry, const std::vector<Observation>& observations);
  [[nodiscard]] PoseState::Vector settle(Start start);
  [[nodiscard]] bool doubtful(const PoseState::Vector& x) const;
  [[nodiscard]] double bounded_cost(const PoseState::Vector& x) const;
  void minimise(PoseState::Vector& x);
  void reweight(const PoseState::Vector& x, Start start);
  void linearise_plan(std::size_t k, const StateFrame& frame);
  void judge(const PoseState::Vector& x);
  void carry_over(const PoseState::Vector& x);
};

void PoseSolver::State::take(const CalibratedPose& pose, const Matrix3d& carry,
                             const std::vector<Observation>& observations) {
  prior.pose = &pose;
  prior.state = pose.state();
  prior.carry = carry;
  PoseState::Matrix covariance = pose.joint;
  covariance.block<3, 3>(PoseState::kRangeX, PoseState::kRangeX) += carry;
  solution.prior_information = inverse(covariance);
  solution.prior_by_plan = solution.prior_information.lazyProduct(pose.with_plan);  // without a workspace
  residuals.prior = prior.state;
  residuals.prior_whitener = whitener(solution.prior_information);
  residuals.observations = &observations;
  residuals.whiteners.resize(observations.size());
  residuals.by_step.resize(observations.size());
  residuals.directions.clear();
  for (const Observation& o : observations) residuals.directions.push_back(fixed_direction(o));
  linearised.resize(observations.size());
}

void PoseSolver::State::minimise(PoseState::Vector& x) {
  for (std::size_t k = 0; k < linearised.size(); ++k) {
    residuals.whiteners[k] = whitener<2>(linearised[k].rest().inverse());
    residuals.by_step[k] = linearised[k].by_step;
  }
  solver.Solve(residuals, &x);
  x(PoseState::kTheta) = geometry::wrap_angle(x(PoseState::kTheta));
}

/// What the step from the prior tells of the plan's errors p: -(with_plan)^T P^-1 step, for a pose that the plan has
/// drawn aside is likely to be drawn aside again.
void PoseSolver::State::linearise_plan(std::size_t k, const StateFrame& frame) {
  const Observation& o = (*residuals.observations)[k];
  Linearised& l = linearised[k];
  l.by_step.setZero();
  Gain with_residual = Gain::Zero();  // covariance of the state with the residual's plan part
  for (std::size_t i = 0; i < plan_count(o); ++i) {
    const auto [column, J] = localization::by_plan(o, i, residuals.directions[k], frame);
    assert(column + 2 <= solution.prior_by_plan.cols());
    l.by_step += J * solution.prior_by_plan.middleCols<2>(column).transpose();
    with_residual += prior.pose->with_plan.middleCols<2>(column) * J.transpose();
  }
  l.known = l.by_step * with_residual;
}

/// Linearises; robust weights: Cauchy's 1 / (1 + s / c^2), and its square from the prior (Geman and McClure), under
/// which an observation that is far off pulls no more.
void PoseSolver::State::reweight(const PoseState::Vector& x, Start start) {
  const std::vector<Observation>& observations = *residuals.observations;
  const double scale = params.robust_scale * params.robust_scale;
  const StateFrame frame(x);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    Linearised& l = linearised[k];
    Vector2d residual;
    evaluate(observations[k], residuals.directions[k], frame, x, residual, &l.by_state);
    l.covariance = residual_covariance(observations[k], frame);
    linearise_plan(k, frame);
    const double cauchy = 1.0 / (1.0 + normalised_square(observations[k], l.covariance, residual) / scale);
    l.weight = start == Start::kPrior ? cauchy * cauchy : cauchy;
  }
}

PoseState::Vector PoseSolver::State::settle(Start start) {
  PoseState::Vector x = prior.state;
  reweight(x, start);
  if (start == Start::kAll)
    for (Linearised& l : linearised) l.weight = 1.0;  // far from the solution, residuals say nothing of outliers
  for (int i = 0; i < params.reweightings; ++i) {
    minimise(x);
    reweight(x, start);
  }
  return x;
}

/// Many outliers, or a step that the prior does not explain: another minimum may be better.
bool PoseSolver::State::doubtful(const PoseState::Vector& x) const {
  const auto pulled =
      std::count_if(linearised.begin(), linearised.end(), [](const Linearised& l) { return l.weight < 0.5; });
  return step_squared(prior, x) > params.doubtful_step ||
         static_cast<double>(pulled) > params.doubtful_share * static_cast<double>(linearised.size());
}

/// What the prior and the observations have against a state, an observation's share bounded (Geman and McClure).
double PoseSolver::State::bounded_cost(const PoseState::Vector& x) const {
  const double scale = params.robust_scale * params.robust_scale;
  double cost = step_squared(prior, x);
  for (const Observation& o : *residuals.observations) {
    Vector2d residual;
    evaluate(o, x, residual, nullptr);
    const double squared = normalised_square(o, residual_covariance(o, StateFrame(x)), residual);
    cost += o.dimension() * scale * squared / (scale + squared);
  }
  return cost;
}

/// What came of each observation, and the information of the state.
void PoseSolver::State::judge(const PoseState::Vector& x) {
  const std::vector<Observation>& observations = *residuals.observations;
  const PoseState::Vector step = difference(x, prior.state);
  solution.step = step;
  solution.information = solution.prior_information;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Linearised& l = linearised[k];
    Vector2d residual;
    evaluate(observations[k], x, residual, nullptr);
    const PoseState::Jacobian by_state = l.by_state + l.by_step;
    const Matrix2d weight = l.rest().inverse();
    solution.information.noalias() += by_state.transpose() * (weight * by_state);
    solution.linearised.push_back(
        {observations[k].landmark, observations[k].kind, residual + l.by_step * step, by_state, weight});
    const double squared = observations[k].dimension() * normalised_square(observations[k], l.covariance, residual);
    solution.mahalanobis_squared.push_back(squared);
    solution.outlier.push_back(squared > gates[static_cast<std::size_t>(observations[k].dimension() - 1)]);
  }
  solution.common_errors = x.tail<6>();
  solution.prior_mahalanobis_squared = step_squared(prior, x);
}

/// What is known afterwards, without the error of the carried scan, which is nobody's any more: the smoothed state
/// before it came (Rauch, Tung and Striebel 1965), s = prior + L (x - prior) with L = P (P + carry)^-1. Its error is
/// linear in the prior's error, the carry's, the noise and the plan's: with the gains K_k of the residuals,
/// their derivatives J_k by the state and G_k by the plan, and A = 1 - L sum K_k J_k,
///   e' = A e - L sum(K_k J_k) carry - L sum K_k (noise_k + G_k plan).
void PoseSolver::State::carry_over(const PoseState::Vector& x) {
  const std::vector<Observation>& observations = *residuals.observations;
  const PoseState::Matrix covariance = inverse(solution.information);
  ScanColumns carried = ScanColumns::Zero();
  carried.middleRows<3>(PoseState::kRangeX) = prior.carry;
  const PoseState::Matrix L =
      PoseState::Matrix::Identity() - carried * solution.prior_information.middleRows<3>(PoseState::kRangeX);
  PoseState::Matrix by_state = PoseState::Matrix::Zero();
  PoseState::Matrix joint = PoseState::Matrix::Zero();
  const StateFrame frame(x);
  by_plan.setZero(PoseState::kSize, prior.pose->with_plan.cols());
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Linearised& l = linearised[k];
    const LinearisedObservation& at = solution.linearised[k];
    const Gain K = L * (covariance * (at.by_state.transpose() * at.information));
    by_state.noalias() += K * l.by_state;
    const bool anonymous = observations[k].plan_terms.empty();
    const Matrix2d fresh = anonymous ? l.covariance.whole() : l.covariance.noise;
    joint.noalias() += K * (fresh / l.weight) * K.transpose();
    for (std::size_t i = 0; i < plan_count(observations[k]); ++i) {
      const auto [column, J] = localization::by_plan(observations[k], i, residuals.directions[k], frame);
      by_plan.middleCols<2>(column) += K * J;
    }
  }
  const PoseState::Matrix A = PoseState::Matrix::Identity() - by_state;
  const ScanColumns by_carry = by_state.middleCols<3>(PoseState::kRangeX);
  const PoseState::Columns& before = prior.pose->with_plan;
  CalibratedPose& after = solution.pose;
  after.with_plan = A.lazyProduct(before);
  const PoseState::Matrix cross = after.with_plan.lazyProduct(by_plan.transpose());
  joint +=
      A * prior.pose->joint * A.transpose() + by_carry * prior.carry * by_carry.transpose() - cross - cross.transpose();
  joint += by_plan.lazyProduct(by_plan.transpose());
  after.joint = 0.5 * (joint + joint.transpose());
  after.with_plan -= by_plan;
  const PoseState::Vector smoothed = prior.state + L * difference(x, prior.state);
  after.pose = pose_of(x);
  after.common_errors = smoothed.tail<6>();
}

PoseSolver::PoseSolver(const PoseSolverParams& params) : state_(std::make_unique<State>()) {
  constexpr std::size_t kUsualObservations = 256;
  state_->residuals.directions.reserve(kUsualObservations);
  state_->residuals.whiteners.reserve(kUsualObservations);
  state_->linearised.reserve(kUsualObservations);
  state_->solution.mahalanobis_squared.reserve(kUsualObservations);
  state_->solution.outlier.reserve(kUsualObservations);
  state_->solution.linearised.reserve(kUsualObservations);
  state_->params = params;
  for (const int dimension : {1, 2})
    state_->gates[static_cast<std::size_t>(dimension - 1)] = chi_square_gate(dimension, params.outlier_probability);
}
PoseSolver::~PoseSolver() = default;
PoseSolver::PoseSolver(PoseSolver&&) noexcept = default;
PoseSolver& PoseSolver::operator=(PoseSolver&&) noexcept = default;

const PoseSolution& PoseSolver::solution() const { return state_->solution; }

const PoseSolution& PoseSolver::solve(const CalibratedPose& prior, const std::vector<Observation>& observations,
                                      const Matrix3d& carry_covariance) {
  State& s = *state_;
  s.solution.mahalanobis_squared.clear();
  s.solution.outlier.clear();
  s.solution.linearised.clear();
  s.solution.prior_mahalanobis_squared = 0.0;
  if (observations.empty()) {
    s.solution.pose = prior;
    s.solution.common_errors = prior.common_errors;
    return s.solution;
  }
  s.take(prior, carry_covariance, observations);
  auto start = State::Start::kAll;
  PoseState::Vector x = s.settle(start);
  if (s.doubtful(x)) {
    const PoseState::Vector cautious = s.settle(State::Start::kPrior);
    if (s.bounded_cost(cautious) < s.bounded_cost(x)) {
      x = cautious;
      start = State::Start::kPrior;
    }
    s.reweight(x, start);
  }
  s.judge(x);
  s.carry_over(x);
  return s.solution;
}

}  // namespace credo::localization
