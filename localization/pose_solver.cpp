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

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using Matrix32d = Eigen::Matrix<double, 3, 2>;

/// Three of the state's unknowns each, independent beforehand: the pose, the scan's common errors, the camera's.
constexpr int kBlocks = 3;
using BlockMatrices = std::array<Matrix3d, kBlocks>;

Pose2 pose_of(const PoseState::Vector& x) { return {x(PoseState::kX), x(PoseState::kY), x(PoseState::kTheta)}; }
Vector3d vector_of(const Pose2& p) { return {p.x, p.y, p.theta}; }
Vector2d turned(const Vector2d& v) { return {-v.y(), v.x()}; }

/// A state's pose as a transform, its sine and cosine taken once for all observations.
struct Frame {
  explicit Frame(const PoseState::Vector& x) : R(pose_of(x).rotation()), t(x.head<2>()) {}
  Vector2d operator*(const Vector2d& point) const { return R * point + t; }

  Matrix2d R;
  Vector2d t;
};

/// What does not change with the state: along the map's line, or along the bearing in the base frame.
Vector2d fixed_direction(const Observation& o) {
  const double angle = o.kind == ObservationKind::kBearing ? o.base_angle : o.map_angle;
  return {std::cos(angle), std::sin(angle)};
}

/// The residual as localization::evaluate has it.
/// \param fixed  fixed_direction(o)
/// \param frame  Frame(x)
void evaluate(const Observation& o, const Vector2d& fixed, const Frame& frame, const PoseState::Vector& x,
              Vector2d& residual, PoseState::Jacobian* jacobian) {
  if (jacobian) jacobian->setZero();
  if (o.kind == ObservationKind::kBearing) {
    const Vector2d from = frame * o.base_point;
    const Vector2d way = o.map_point - from;
    const double c = fixed.x(), s = fixed.y();
    const double observed =
        o.base_angle + x(PoseState::kCameraTheta) + x(PoseState::kCameraCos) * c + x(PoseState::kCameraSin) * s;
    residual = {geometry::wrap_angle(std::atan2(way.y(), way.x()) - x(PoseState::kTheta) - observed), 0.0};
    if (!jacobian) return;
    const Vector2d aside = turned(way) / std::max(way.squaredNorm(), 1e-4);
    const Vector2d by_theta = turned(from - frame.t);
    jacobian->row(0) << -aside.x(), -aside.y(), -aside.dot(by_theta) - 1.0, 0.0, 0.0, 0.0, -1.0, -c, -s;
    return;
  }
  // The scan as a whole is off by (x, y, theta), in first order.
  const Vector2d shift = x.segment<2>(PoseState::kRangeX);
  const Vector2d in_base = o.base_point + shift + x(PoseState::kRangeTheta) * turned(o.base_point);
  const Vector2d in_map = frame * in_base;
  const Vector2d by_theta = turned(in_map - frame.t);
  const Vector2d by_scan_theta = frame.R * turned(o.base_point);
  if (o.kind == ObservationKind::kPoint) {
    residual = in_map - o.map_point;
    if (!jacobian) return;
    jacobian->leftCols<2>().setIdentity();
    jacobian->col(PoseState::kTheta) = by_theta;
    jacobian->middleCols<2>(PoseState::kRangeX) = frame.R;
    jacobian->col(PoseState::kRangeTheta) = by_scan_theta;
    return;
  }
  const Vector2d normal = turned(fixed);
  const double angle = o.base_angle + x(PoseState::kRangeTheta) + x(PoseState::kTheta);
  residual = {normal.dot(in_map - o.map_point), geometry::wrap_line_angle(angle - o.map_angle)};
  if (!jacobian) return;
  const Vector2d normal_in_base = frame.R.transpose() * normal;
  jacobian->row(0) << normal.x(), normal.y(), normal.dot(by_theta), normal_in_base.x(), normal_in_base.y(),
      normal.dot(by_scan_theta), 0.0, 0.0, 0.0;
  (*jacobian)(1, PoseState::kTheta) = 1.0;
  (*jacobian)(1, PoseState::kRangeTheta) = 1.0;
}

/// U, upper triangular, with U^T U the inverse of a covariance, so that |U e|^2 = e^T covariance^-1 e. Cholesky's
/// decomposition in plain numbers: Eigen's takes seconds to compile for each size.
template <int kRows>
Eigen::Matrix<double, kRows, kRows> whitener(const Eigen::Matrix<double, kRows, kRows>& covariance) {
  const Eigen::Matrix<double, kRows, kRows> information = covariance.inverse();
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

/// The covariances of an observation's residual at a pose; a bearing's second row is a unit, so that it inverts.
struct ResidualCovariance {
  Matrix2d noise;
  Matrix2d plan;
};

ResidualCovariance residual_covariance(const Observation& o, const Frame& frame) {
  switch (o.kind) {
    case ObservationKind::kWall: return {o.noise, o.plan};
    case ObservationKind::kPoint: return {frame.R * o.noise * frame.R.transpose(), o.plan};
    case ObservationKind::kBearing: {
      const Vector2d way = o.map_point - frame * o.base_point;
      const double squared = std::max(way.squaredNorm(), 1e-4);
      const Vector2d aside = turned(way) / squared;
      Matrix2d noise = Matrix2d::Identity(), plan = Matrix2d::Zero();
      noise(0, 0) = o.noise(0, 0);
      plan(0, 0) = aside.dot(o.plan * aside);
      return {noise, plan};
    }
  }
  return {};
}

/// An instrument that is not there has an error that is known to be nearly nothing, so that the covariance inverts.
constexpr double kNearlyNothing = 1e-10;

/// Errors that all readings of an instrument share: fresh in each acquisition (the scan was carried over a motion), or
/// always the same (mounting, the mirror's centre).
struct CommonErrors {
  struct Covariances {
    Matrix3d noise = kNearlyNothing * Matrix3d::Identity();
    Matrix3d repeated = Matrix3d::Zero();
  };
  Covariances scan;    ///< x, y, theta
  Covariances camera;  ///< yaw, first harmonic
};

CommonErrors common_errors_of(const sensors::Rig& rig) {
  CommonErrors common;
  if (!rig.range_finders.empty()) {
    const sensors::CalibrationAccuracy& a = rig.range_finders.front().accuracy;
    common.scan.repeated.diagonal() << a.x_m * a.x_m, a.y_m * a.y_m, a.theta_rad * a.theta_rad;
  }
  if (rig.camera) {
    const sensors::CalibrationAccuracy& a = rig.camera->accuracy;
    const double harmonic = rig.camera->horizon_radius_px > 0.0 ? a.center_px / rig.camera->horizon_radius_px : 0.0;
    common.camera.repeated.diagonal() << a.theta_rad * a.theta_rad, harmonic * harmonic, harmonic * harmonic;
  }
  return common;
}

/// Squared residual per degree of freedom in standard deviations.
double normalised_square(const Observation& o, const ResidualCovariance& covariance, const Vector2d& residual) {
  return residual.dot((covariance.noise + covariance.plan).inverse() * residual) / o.dimension();
}

/// Squared Mahalanobis distance of a state's pose from the prior.
double step_squared(const SplitPose& prior, const PoseState::Vector& x) {
  Vector3d step = x.head<3>() - vector_of(prior.pose);
  step(2) = geometry::wrap_angle(step(2));
  return step.dot(prior.covariance().inverse() * step);
}

/// Whitened residuals of the prior on the state (9 rows) and of all observations (2 rows each), for ceres::TinySolver.
struct WhitenedResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = PoseState::kSize };

  PoseState::Vector prior = PoseState::Vector::Zero();
  BlockMatrices prior_whiteners;
  const std::vector<Observation>* observations = nullptr;
  std::vector<Vector2d> directions;  ///< fixed_direction of each
  std::vector<Matrix2d> whiteners;   ///< square root of the robust weight included

  [[nodiscard]] int NumResiduals() const { return PoseState::kSize + 2 * static_cast<int>(observations->size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const PoseState::Vector x = Eigen::Map<const PoseState::Vector>(parameters);
    Eigen::Map<Eigen::VectorXd> e(residuals, NumResiduals());
    PoseState::Vector step = x - prior;
    step(PoseState::kTheta) = geometry::wrap_angle(step(PoseState::kTheta));
    for (int b = 0; b < kBlocks; ++b) e.segment<3>(3 * b) = prior_whiteners[b] * step.segment<3>(3 * b);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, PoseState::kSize>> J(jacobian, jacobian ? NumResiduals() : 0,
                                                                          PoseState::kSize);
    if (jacobian) {
      J.topRows<PoseState::kSize>().setZero();
      for (int b = 0; b < kBlocks; ++b) J.block<3, 3>(3 * b, 3 * b) = prior_whiteners[b];
    }
    const Frame frame(x);
    for (std::size_t k = 0; k < observations->size(); ++k) {
      Vector2d raw;
      PoseState::Jacobian by_state;
      evaluate((*observations)[k], directions[k], frame, x, raw, jacobian ? &by_state : nullptr);
      const auto row = static_cast<Eigen::Index>(PoseState::kSize + 2 * k);
      e.segment<2>(row) = whiteners[k] * raw;
      if (jacobian) J.middleRows<2>(row) = whiteners[k] * by_state;
    }
    return true;
  }
};

/// An observation linearised at the solution.
struct Linearised {
  PoseState::Jacobian by_state;
  ResidualCovariance covariance;
  double weight = 1.0;  ///< of the robust loss
};

/// What is known before an acquisition.
struct Prior {
  SplitPose pose;
  CommonErrors common;
};

/// Split covariance intersection gives the share omega to the prior's correlated part and 1 - omega to what repeats.
Matrix2d intersected(const Linearised& l, double omega) {
  return (l.covariance.noise + l.covariance.plan / (1.0 - omega)) / l.weight;
}
BlockMatrices intersected(const Prior& prior, double omega) {
  const auto& [scan, camera] = prior.common;
  return {prior.pose.independent + prior.pose.correlated / omega, scan.noise + scan.repeated / (1.0 - omega),
          camera.noise + camera.repeated / (1.0 - omega)};
}

PoseState::Matrix information(const Prior& prior, const std::vector<Linearised>& linearised, double omega) {
  PoseState::Matrix sum = PoseState::Matrix::Zero();
  const BlockMatrices blocks = intersected(prior, omega);
  for (int b = 0; b < kBlocks; ++b) sum.block<3, 3>(3 * b, 3 * b) = blocks[b].inverse();
  for (const Linearised& l : linearised) {
    const PoseState::Jacobian weighted = intersected(l, omega).inverse() * l.by_state;
    sum.noalias() += l.by_state.transpose() * weighted;
  }
  return sum;
}

/// Covariances of the pose with each block of the state: the first three rows of the information's inverse. One
/// decomposition and one right-hand side at a time, as TinySolver does it: Eigen's general inverse takes long to
/// compile.
BlockMatrices pose_covariances(const PoseState::Matrix& information) {
  const Eigen::LDLT<PoseState::Matrix> decomposed(information);
  BlockMatrices covariances;
  for (int i = 0; i < 3; ++i) {
    const PoseState::Vector unit = PoseState::Vector::Unit(i);
    const PoseState::Vector row = decomposed.solve(unit);
    for (int b = 0; b < kBlocks; ++b) covariances[b].row(i) = row.segment<3>(3 * b).transpose();
  }
  return covariances;
}

/// The share that leaves the pose the smallest covariance (by its determinant).
double best_share(const Prior& prior, const std::vector<Linearised>& linearised) {
  constexpr std::array kShares{0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98};
  double best = 0.5, smallest = std::numeric_limits<double>::infinity();
  for (const double omega : kShares) {
    const double determinant = pose_covariances(information(prior, linearised, omega))[0].determinant();
    if (determinant < smallest) {
      smallest = determinant;
      best = omega;
    }
  }
  return best;
}

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

void evaluate(const Observation& o, const PoseState::Vector& x, Vector2d& residual, PoseState::Jacobian* jacobian) {
  evaluate(o, fixed_direction(o), Frame(x), x, residual, jacobian);
}

void evaluate(const Observation& observation, const Pose2& pose, Vector2d& residual) {
  PoseState::Vector x = PoseState::Vector::Zero();
  x.head<3>() = vector_of(pose);
  evaluate(observation, x, residual, nullptr);
}

struct PoseSolver::State {
  CommonErrors common;
  PoseSolverParams params;
  std::array<double, 2> gates{};  ///< of a squared residual with 1 and with 2 dimensions
  ceres::TinySolver<WhitenedResiduals> solver;
  WhitenedResiduals residuals;
  std::vector<Linearised> linearised;
  PoseSolution solution;

  /// Where the iterations start from.
  enum class Start {
    kAll,    ///< the observations, all of them
    kPrior,  ///< the prior: what contradicts it has to be borne out by more than it contradicts
  };

  [[nodiscard]] PoseState::Vector settle(const Prior& prior, Start start);
  [[nodiscard]] bool doubtful(const Prior& prior, const PoseState::Vector& x) const;
  [[nodiscard]] double bounded_cost(const Prior& prior, const PoseState::Vector& x) const;
  void minimise(const Prior& prior, double omega, PoseState::Vector& x);
  void reweight(const PoseState::Vector& x, Start start);
  void finish(const Prior& prior, double omega, const PoseState::Vector& x);
};

void PoseSolver::State::minimise(const Prior& prior, double omega, PoseState::Vector& x) {
  const BlockMatrices blocks = intersected(prior, omega);
  for (int b = 0; b < kBlocks; ++b) residuals.prior_whiteners[b] = whitener(blocks[b]);
  for (std::size_t k = 0; k < linearised.size(); ++k)
    residuals.whiteners[k] = whitener(intersected(linearised[k], omega));
  solver.Solve(residuals, &x);
  x(PoseState::kTheta) = geometry::wrap_angle(x(PoseState::kTheta));
}

/// Linearises; robust weights: Cauchy's 1 / (1 + s / c^2), and its square from the prior (Geman and McClure), under
/// which an observation that is far off pulls no more.
void PoseSolver::State::reweight(const PoseState::Vector& x, Start start) {
  const std::vector<Observation>& observations = *residuals.observations;
  const double scale = params.robust_scale * params.robust_scale;
  const Frame frame(x);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    Linearised& l = linearised[k];
    Vector2d residual;
    evaluate(observations[k], residuals.directions[k], frame, x, residual, &l.by_state);
    l.covariance = residual_covariance(observations[k], frame);
    const double cauchy = 1.0 / (1.0 + normalised_square(observations[k], l.covariance, residual) / scale);
    l.weight = start == Start::kPrior ? cauchy * cauchy : cauchy;
  }
}

PoseState::Vector PoseSolver::State::settle(const Prior& prior, Start start) {
  PoseState::Vector x = residuals.prior;
  reweight(x, start);
  if (start == Start::kAll)
    for (Linearised& l : linearised) l.weight = 1.0;  // far from the solution, residuals say nothing of outliers
  for (int i = 0; i < params.reweightings; ++i) {
    minimise(prior, 0.5, x);
    reweight(x, start);
  }
  return x;
}

/// Many outliers, or a step that the prior does not explain: another minimum may be better.
bool PoseSolver::State::doubtful(const Prior& prior, const PoseState::Vector& x) const {
  const auto pulled =
      std::count_if(linearised.begin(), linearised.end(), [](const Linearised& l) { return l.weight < 0.5; });
  return step_squared(prior.pose, x) > params.doubtful_step ||
         static_cast<double>(pulled) > params.doubtful_share * static_cast<double>(linearised.size());
}

/// What the prior and the observations have against a state, an observation's share bounded (Geman and McClure).
double PoseSolver::State::bounded_cost(const Prior& prior, const PoseState::Vector& x) const {
  const double scale = params.robust_scale * params.robust_scale;
  double cost = step_squared(prior.pose, x);
  for (const Observation& o : *residuals.observations) {
    Vector2d residual;
    evaluate(o, x, residual, nullptr);
    const double squared = normalised_square(o, residual_covariance(o, Frame(x)), residual);
    cost += o.dimension() * scale * squared / (scale + squared);
  }
  return cost;
}

void PoseSolver::State::finish(const Prior& prior, double omega, const PoseState::Vector& x) {
  solution.information = information(prior, linearised, omega);
  const BlockMatrices of_pose = pose_covariances(solution.information);
  const BlockMatrices blocks = intersected(prior, omega);
  const BlockMatrices fresh{prior.pose.independent, prior.common.scan.noise, prior.common.camera.noise};
  Matrix3d independent = Matrix3d::Zero();
  for (int b = 0; b < kBlocks; ++b) {
    const Matrix3d gain = of_pose[b] * blocks[b].inverse();
    independent += gain * fresh[b] * gain.transpose();
  }
  const std::vector<Observation>& observations = *residuals.observations;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Linearised& l = linearised[k];
    Matrix32d by_residual = Matrix32d::Zero();
    for (int b = 0; b < kBlocks; ++b) by_residual += of_pose[b] * l.by_state.middleCols<3>(3 * b).transpose();
    const Matrix2d weight = intersected(l, omega).inverse();
    const Matrix32d gain = by_residual * weight;
    independent += gain * (l.covariance.noise / l.weight) * gain.transpose();
    Vector2d residual;
    evaluate(observations[k], x, residual, nullptr);
    const double squared = residual.dot((l.covariance.noise + l.covariance.plan).inverse() * residual);
    solution.linearised.push_back({observations[k].landmark, observations[k].kind, residual, l.by_state, weight});
    solution.mahalanobis_squared.push_back(squared);
    solution.outlier.push_back(squared > gates[static_cast<std::size_t>(observations[k].dimension() - 1)]);
  }
  const Matrix3d& covariance = of_pose[0];
  solution.pose = {pose_of(x), 0.5 * (independent + independent.transpose()), Matrix3d::Zero()};
  solution.pose.correlated = 0.5 * (covariance + covariance.transpose()) - solution.pose.independent;
  solution.common_errors = x.tail<6>();
  solution.prior_mahalanobis_squared = step_squared(prior.pose, x);
}

PoseSolver::PoseSolver(const sensors::Rig& rig, const PoseSolverParams& params) : state_(std::make_unique<State>()) {
  constexpr std::size_t kUsualObservations = 256;
  state_->residuals.directions.reserve(kUsualObservations);
  state_->residuals.whiteners.reserve(kUsualObservations);
  state_->linearised.reserve(kUsualObservations);
  state_->solution.mahalanobis_squared.reserve(kUsualObservations);
  state_->solution.outlier.reserve(kUsualObservations);
  state_->solution.linearised.reserve(kUsualObservations);
  state_->common = common_errors_of(rig);
  state_->params = params;
  for (const int dimension : {1, 2})
    state_->gates[static_cast<std::size_t>(dimension - 1)] = chi_square_gate(dimension, params.outlier_probability);
}
PoseSolver::~PoseSolver() = default;
PoseSolver::PoseSolver(PoseSolver&&) noexcept = default;
PoseSolver& PoseSolver::operator=(PoseSolver&&) noexcept = default;

const PoseSolution& PoseSolver::solution() const { return state_->solution; }

const PoseSolution& PoseSolver::solve(const SplitPose& prior_pose, const std::vector<Observation>& observations,
                                      const Matrix3d& carry_covariance) {
  State& s = *state_;
  s.solution.mahalanobis_squared.clear();
  s.solution.outlier.clear();
  s.solution.linearised.clear();
  s.solution.prior_mahalanobis_squared = 0.0;
  if (observations.empty()) {
    s.solution.pose = prior_pose;
    s.solution.common_errors.setZero();
    return s.solution;
  }
  Prior prior{prior_pose, s.common};
  prior.common.scan.noise += carry_covariance;
  PoseState::Vector x = PoseState::Vector::Zero();
  x.head<3>() = vector_of(prior_pose.pose);
  s.residuals.prior = x;
  s.residuals.observations = &observations;
  s.residuals.whiteners.resize(observations.size());
  s.residuals.directions.clear();
  for (const Observation& o : observations) s.residuals.directions.push_back(fixed_direction(o));
  s.linearised.resize(observations.size());
  auto start = State::Start::kAll;
  x = s.settle(prior, start);
  if (s.doubtful(prior, x)) {
    const PoseState::Vector cautious = s.settle(prior, State::Start::kPrior);
    if (s.bounded_cost(prior, cautious) < s.bounded_cost(prior, x)) {
      x = cautious;
      start = State::Start::kPrior;
    }
    s.reweight(x, start);
  }
  // The share hardly moves the minimum, so it is searched once, where the weights have settled.
  const double omega = best_share(prior, s.linearised);
  s.minimise(prior, omega, x);
  s.reweight(x, start);
  s.finish(prior, omega, x);
  return s.solution;
}

}  // namespace credo::localization
