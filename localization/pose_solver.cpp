// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_solver.hpp"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "localization/pose_problem.hpp"
#include "localization/positive_definite.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
constexpr double kSettled = 1e-6;  ///< change of the cost, half a sum of squared standard deviations
using ScanColumns = Eigen::Matrix<double, PoseState::kSize, 3>;

geometry::Pose2 pose_of(const PoseState::Vector& x) {
  return {x(PoseState::kX), x(PoseState::kY), x(PoseState::kTheta)};
}

/// The least squares for ceres::TinySolver: the ten rows that stand for all. It first asks for the residuals alone, of
/// which it takes the squared sum.
struct TenRows {
  using Scalar = double;
  enum { NUM_RESIDUALS = PoseState::kSize + 1, NUM_PARAMETERS = PoseState::kSize };
  PoseProblem* problem = nullptr;

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const PoseState::Vector x = Eigen::Map<const PoseState::Vector>(parameters);
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, 1>> e(residuals);
    if (!jacobian) {
      e.setZero();
      e(PoseState::kSize) = std::sqrt(problem->squared_sum(x));
      return true;
    }
    const PoseProblem::Moments rows = problem->moments_root(x);
    e = rows.col(PoseState::kSize);
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, PoseState::kSize>>{jacobian} = rows.leftCols<PoseState::kSize>();
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
  ceres::TinySolver<TenRows> solver;
  PoseProblem problem;

  // Of the latest solution's error, for solve_plan():
  const CalibratedPose* from = nullptr;  ///< its prior
  PlanPart plan_part;
  PoseState::Matrix by_prior = PoseState::Matrix::Identity();  ///< its derivative by the prior's error
  PoseSolution solution;                                       ///< of solve()

  /// Where the iterations start from.
  enum class Start {
    kAll,    ///< the observations, all of them
    kPrior,  ///< the prior: what contradicts it has to be borne out by more than it contradicts
  };

  [[nodiscard]] double scale() const { return params.robust_scale * params.robust_scale; }
  [[nodiscard]] PoseState::Vector settle(Start start);
  [[nodiscard]] bool doubtful(const PoseState::Vector& x) const;
  [[nodiscard]] PoseState::Vector best_state();
  void minimise(PoseState::Vector& x);
  void judge(const PoseState::Vector& x, PoseSolution& of) const;
  struct Gains;
  [[nodiscard]] Gains sum_gains(const PoseState::Matrix& by_gradient, const PoseSolution& of);
  void carry_over(const PoseState::Vector& x, PoseSolution& of);
};

void PoseSolver::State::minimise(PoseState::Vector& x) {
  solver.Solve(TenRows{&problem}, &x);
  x(PoseState::kTheta) = geometry::wrap_angle(x(PoseState::kTheta));
}

PoseState::Vector PoseSolver::State::settle(Start start) {
  const bool bounded = start == Start::kPrior;
  PoseState::Vector x = problem.prior().state;
  problem.reweight(x, scale(), bounded);
  if (start == Start::kAll) problem.trust_all();  // far from the solution, residuals say nothing of outliers
  for (int i = 0; i < params.reweightings; ++i) {
    // Near the solution a step is enough, as the weights change after it.
    solver.options.function_tolerance = i == 0 ? kSettled : std::numeric_limits<double>::infinity();
    minimise(x);
    problem.reweight(x, scale(), bounded);
  }
  return x;
}

/// Many outliers, or a step that the prior does not explain: another minimum may be better.
bool PoseSolver::State::doubtful(const PoseState::Vector& x) const {
  const std::vector<ObservationTerm>& terms = problem.terms();
  const auto pulled =
      std::count_if(terms.begin(), terms.end(), [](const ObservationTerm& term) { return term.weight < 0.5; });
  return problem.prior().step_squared(x) > params.doubtful_step ||
         static_cast<double>(pulled) > params.doubtful_share * static_cast<double>(terms.size());
}

/// The solution's state; the problem is weighted there.
PoseState::Vector PoseSolver::State::best_state() {
  const PoseState::Vector x = settle(Start::kAll);
  if (!doubtful(x)) return x;
  const PoseState::Vector cautious = settle(Start::kPrior);
  if (problem.bounded_cost(cautious, scale()) < problem.bounded_cost(x, scale())) return cautious;
  problem.reweight(x, scale(), false);
  return x;
}

/// What came of each observation, and the information of the state.
void PoseSolver::State::judge(const PoseState::Vector& x, PoseSolution& of) const {
  const std::span<const Observation> observations = problem.observations();
  const PoseState::Vector step = difference(x, problem.prior().state);
  of.step = step;
  of.information = of.prior_information = problem.prior().information;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Observation& o = observations[k];
    const ObservationTerm& term = problem.terms()[k];
    const PoseState::Jacobian by_state = term.by_state + term.by_step;
    const Matrix2d weight = term.rest().inverse();
    of.information.noalias() += by_state.transpose() * (weight * by_state);
    of.linearised.push_back({o.landmark, o.kind, term.residual + term.by_step * step, by_state, weight});
    const double squared = term.residual.dot(term.covariance.whole().inverse() * term.residual);
    of.mahalanobis_squared.push_back(squared);
    of.outlier.push_back(squared > gates[static_cast<std::size_t>(o.dimension() - 1)]);
  }
  of.common_errors = x.tail<6>();
}

/// The sums over all observations that the error of a solution is made of, with the gains K_k of the residuals and
/// their derivatives J_k by the state.
struct PoseSolver::State::Gains {
  PoseState::Matrix by_state = PoseState::Matrix::Zero();   ///< of K_k J_k
  PoseState::Matrix noise = PoseState::Matrix::Zero();      ///< covariance of K_k noise_k
  PoseState::Matrix with_plan = PoseState::Matrix::Zero();  ///< covariance of the prior's error with that of plan_part
};

/// \param by_gradient  the gains are this times J_k^T W_k
PoseSolver::State::Gains PoseSolver::State::sum_gains(const PoseState::Matrix& by_gradient, const PoseSolution& of) {
  Gains sum;
  plan_part.clear(problem.prior().pose->with_plan.errors());
  for (std::size_t k = 0; k < problem.terms().size(); ++k) {
    const Observation& o = problem.observations()[k];
    const ObservationTerm& term = problem.terms()[k];
    const LinearisedObservation& at = of.linearised[k];
    const PoseState::Pair K = by_gradient * (at.by_state.transpose() * at.information);
    const PoseState::Pair by_landmark = K * term.by_landmark;
    const Matrix2d fresh = o.plan_terms.empty() ? term.covariance.whole() : term.covariance.noise;
    sum.by_state.noalias() += K * term.by_state;
    sum.noise.noalias() += K * (fresh / term.weight) * K.transpose();
    sum.with_plan.noalias() += term.with_landmark * by_landmark.transpose();
    for (std::size_t i = 0; i < plan_count(o); ++i) {
      const auto [column, derivative] = landmark_by_plan(o, i, term.fixed);
      plan_part.add(column, by_landmark * derivative);
    }
  }
  return sum;
}

/// What is known afterwards, without the error of the carried scan, which is nobody's any more: the smoothed state
/// before it came (Rauch, Tung and Striebel 1965), s = prior + L (x - prior) with L = P (P + carry)^-1. Its error is
/// linear in the prior's error, the carry's, the noise and the plan's: with the gains K_k of the residuals,
/// their derivatives J_k by the state and G_k by the plan, and A = 1 - L sum K_k J_k,
///   e' = A e - L sum(K_k J_k) carry - L sum K_k (noise_k + G_k plan).
void PoseSolver::State::carry_over(const PoseState::Vector& x, PoseSolution& of) {
  const PosePrior& prior = problem.prior();
  ScanColumns carried = ScanColumns::Zero();
  carried.middleRows<3>(PoseState::kRangeX) = prior.carry;
  const PoseState::Matrix L =
      PoseState::Matrix::Identity() - carried * prior.information.middleRows<3>(PoseState::kRangeX);
  const Gains gains = sum_gains(L * inverse(of.information), of);
  const PoseState::Matrix A = PoseState::Matrix::Identity() - gains.by_state;
  const ScanColumns by_carry = gains.by_state.middleCols<3>(PoseState::kRangeX);
  const PoseState::Matrix cross = A * gains.with_plan;
  const PoseState::Matrix joint = A * prior.pose->joint * A.transpose() +
                                  by_carry * prior.carry * by_carry.transpose() + gains.noise + plan_part.covariance() -
                                  cross - cross.transpose();
  by_prior = A;
  CalibratedPose& after = of.pose;
  after.joint = 0.5 * (joint + joint.transpose());
  const PoseState::Vector smoothed = prior.state + L * difference(x, prior.state);
  after.pose = pose_of(x);
  after.common_errors = smoothed.tail<6>();
}

PoseSolver::PoseSolver(const PoseSolverParams& params) : state_(std::make_unique<State>()) {
  constexpr std::size_t kUsualObservations = 256;
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

void PoseSolver::solve_state(const CalibratedPose& prior, const std::vector<Observation>& observations,
                             const Matrix3d& carry_covariance, PoseSolution& solution) {
  State& s = *state_;
  s.from = &prior;
  solution.mahalanobis_squared.clear();
  solution.outlier.clear();
  solution.linearised.clear();
  if (observations.empty()) {
    s.by_prior.setIdentity();
    s.plan_part.clear(prior.with_plan.errors());
    set_state(prior, solution.pose);
    solution.common_errors = prior.common_errors;
    return;
  }
  s.problem.take(prior, carry_covariance, observations);
  const PoseState::Vector x = s.best_state();
  s.judge(x, solution);
  s.carry_over(x, solution);
}

void PoseSolver::solve_plan(PoseSolution& solution) const {
  const State& s = *state_;
  solution.pose.with_plan = solution.prior_with_plan = s.from->with_plan;
  solution.pose.with_plan.transform(s.by_prior);
  solution.pose.with_plan -= s.plan_part;
}

const PoseSolution& PoseSolver::solve(const CalibratedPose& prior, const std::vector<Observation>& observations,
                                      const Matrix3d& carry_covariance) {
  solve_state(prior, observations, carry_covariance, state_->solution);
  solve_plan(state_->solution);
  return state_->solution;
}

}  // namespace credo::localization
