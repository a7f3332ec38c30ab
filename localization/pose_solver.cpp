// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_solver.hpp"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using Jacobian = Eigen::Matrix<double, 2, 3>;

/// Mounting errors of the camera and of the range finder: yaw, x, y of each.
constexpr int kCalibrationParameters = 6;
using CalibrationJacobian = Eigen::Matrix<double, 2, kCalibrationParameters>;

Pose2 pose_of(const Vector3d& x) { return {x(0), x(1), x(2)}; }
Vector3d vector_of(const Pose2& p) { return {p.x, p.y, p.theta}; }
Vector2d turned(const Vector2d& v) { return {-v.y(), v.x()}; }

/// A 2x2 symmetric matrix' lower Cholesky factor of its inverse W = L L^T, so that |L^T e|^2 = e^T W e.
Matrix2d whitener(const Matrix2d& covariance) {
  const Matrix2d information = covariance.inverse();
  return information.llt().matrixL();
}

/// The covariances of an observation's residual at a pose; a bearing's second row is a unit, so that it inverts.
struct ResidualCovariance {
  Matrix2d noise;
  Matrix2d plan;
};

ResidualCovariance residual_covariance(const Observation& o, const Pose2& pose) {
  switch (o.kind) {
    case ObservationKind::kWall:
      return {o.noise, o.plan};
    case ObservationKind::kPoint: {
      const Matrix2d R = pose.rotation();
      return {R * o.noise * R.transpose(), o.plan};
    }
    case ObservationKind::kBearing: {
      const Vector2d way = o.map_point - pose * o.base_point;
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

/// Derivative of the residual by the mounting errors.
CalibrationJacobian by_calibration(const Observation& o, const Pose2& pose, const sensors::Rig& rig) {
  CalibrationJacobian J = CalibrationJacobian::Zero();
  if (o.kind == ObservationKind::kBearing) {
    const Vector2d way = o.map_point - pose * o.base_point;
    const Vector2d aside = turned(way) / std::max(way.squaredNorm(), 1e-4);
    J(0, 0) = -1.0;
    J.block<1, 2>(0, 1) = -aside.transpose() * pose.rotation();
    return J;
  }
  if (rig.range_finders.empty()) return J;
  const Matrix2d R = pose.rotation();
  const Vector2d by_yaw = R * turned(o.base_point - rig.range_finders.front().T_base_sensor.translation());
  if (o.kind == ObservationKind::kPoint) {
    J.col(3) = by_yaw;
    J.block<2, 2>(0, 4) = R;
  } else {
    const Vector2d normal(-std::sin(o.map_angle), std::cos(o.map_angle));
    J(0, 3) = normal.dot(by_yaw);
    J(1, 3) = 1.0;
    J.block<1, 2>(0, 4) = normal.transpose() * R;
  }
  return J;
}

Eigen::Matrix<double, kCalibrationParameters, 1> calibration_variance(const sensors::Rig& rig) {
  Eigen::Matrix<double, kCalibrationParameters, 1> v = Eigen::Matrix<double, kCalibrationParameters, 1>::Zero();
  const auto put = [&v](int at, const sensors::CalibrationAccuracy& a) {
    v.segment<3>(at) << a.theta_rad * a.theta_rad, a.x_m * a.x_m, a.y_m * a.y_m;
  };
  if (rig.camera) put(0, rig.camera->accuracy);
  if (!rig.range_finders.empty()) put(3, rig.range_finders.front().accuracy);
  return v;
}

/// Whitened residuals of the prior (3 rows) and of all observations (2 rows each), for ceres::TinySolver.
struct WhitenedResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  Vector3d prior = Vector3d::Zero();
  Matrix3d prior_whitener = Matrix3d::Identity();  ///< L^T with L L^T the information
  const std::vector<Observation>* observations = nullptr;
  std::vector<Matrix2d> whiteners;  ///< L^T, square root of the robust weight included

  [[nodiscard]] int NumResiduals() const { return 3 + 2 * static_cast<int>(observations->size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Vector3d x(parameters[0], parameters[1], parameters[2]);
    Eigen::Map<Eigen::VectorXd> e(residuals, NumResiduals());
    Vector3d step = x - prior;
    step(2) = geometry::wrap_angle(step(2));
    e.head<3>() = prior_whitener * step;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3>> J(jacobian, jacobian ? NumResiduals() : 0, 3);
    if (jacobian) J.topRows<3>() = prior_whitener;
    const Pose2 pose = pose_of(x);
    for (std::size_t k = 0; k < observations->size(); ++k) {
      Vector2d raw;
      Jacobian by_pose;
      evaluate((*observations)[k], pose, raw, jacobian ? &by_pose : nullptr);
      const auto row = static_cast<Eigen::Index>(3 + 2 * k);
      e.segment<2>(row) = whiteners[k] * raw;
      if (jacobian) J.middleRows<2>(row) = whiteners[k] * by_pose;
    }
    return true;
  }
};

/// An observation linearised at the solution.
struct Linearised {
  Jacobian by_pose;
  ResidualCovariance covariance;
  double weight = 1.0;  ///< of the robust loss
};

/// Split covariance intersection gives the share omega to the prior's correlated part and 1 - omega to the plan's.
Matrix2d intersected(const Linearised& l, double omega) {
  return (l.covariance.noise + l.covariance.plan / (1.0 - omega)) / l.weight;
}

Matrix3d prior_covariance(const SplitPose& prior, double omega) {
  return prior.independent + prior.correlated / omega;
}

Matrix3d information(const SplitPose& prior, const std::vector<Linearised>& linearised, double omega) {
  Matrix3d sum = prior_covariance(prior, omega).inverse();
  for (const Linearised& l : linearised)
    sum += l.by_pose.transpose() * intersected(l, omega).inverse() * l.by_pose;
  return sum;
}

/// The share that leaves the smallest covariance (largest determinant of the information).
double best_share(const SplitPose& prior, const std::vector<Linearised>& linearised) {
  constexpr std::array kShares{0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98};
  double best = 0.5, best_determinant = -1.0;
  for (const double omega : kShares) {
    const double determinant = information(prior, linearised, omega).determinant();
    if (determinant > best_determinant) {
      best_determinant = determinant;
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
  for (int i = 0; i < 20; ++i) squared = two - std::log(squared * 1.5707963267948966 * (1.0 + 2.0 / squared));
  return squared;
}

}  // namespace

void evaluate(const Observation& o, const Pose2& pose, Vector2d& residual, Jacobian* jacobian) {
  const Vector2d in_map = pose * o.base_point;
  const Vector2d by_theta = turned(in_map - pose.translation());
  switch (o.kind) {
    case ObservationKind::kWall: {
      const Vector2d normal(-std::sin(o.map_angle), std::cos(o.map_angle));
      residual = {normal.dot(in_map - o.map_point), geometry::wrap_line_angle(o.base_angle + pose.theta - o.map_angle)};
      if (jacobian) *jacobian << normal.x(), normal.y(), normal.dot(by_theta), 0.0, 0.0, 1.0;
      return;
    }
    case ObservationKind::kPoint:
      residual = in_map - o.map_point;
      if (jacobian) *jacobian << 1.0, 0.0, by_theta.x(), 0.0, 1.0, by_theta.y();
      return;
    case ObservationKind::kBearing: {
      const Vector2d way = o.map_point - in_map;
      residual = {geometry::wrap_angle(std::atan2(way.y(), way.x()) - pose.theta - o.base_angle), 0.0};
      if (!jacobian) return;
      const Vector2d aside = turned(way) / std::max(way.squaredNorm(), 1e-4);
      *jacobian << -aside.x(), -aside.y(), -aside.dot(by_theta) - 1.0, 0.0, 0.0, 0.0;
      return;
    }
  }
}

struct PoseSolver::State {
  sensors::Rig rig;
  PoseSolverParams params;
  ceres::TinySolver<WhitenedResiduals> solver;
  WhitenedResiduals residuals;
  std::vector<Linearised> linearised;
  PoseSolution solution;

  void linearise(const Pose2& pose);
  void minimise(const SplitPose& prior, double omega, Vector3d& x);
  void reweight(const Pose2& pose);
  void finish(const SplitPose& prior, double omega, const Vector3d& x);
};

void PoseSolver::State::linearise(const Pose2& pose) {
  const std::vector<Observation>& observations = *residuals.observations;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    Vector2d residual;
    evaluate(observations[k], pose, residual, &linearised[k].by_pose);
    linearised[k].covariance = residual_covariance(observations[k], pose);
  }
}

void PoseSolver::State::minimise(const SplitPose& prior, double omega, Vector3d& x) {
  residuals.prior_whitener = prior_covariance(prior, omega).inverse().llt().matrixU();
  for (std::size_t k = 0; k < linearised.size(); ++k)
    residuals.whiteners[k] = whitener(intersected(linearised[k], omega)).transpose();
  solver.Solve(residuals, &x);
  x(2) = geometry::wrap_angle(x(2));
}

/// Cauchy loss: weight 1 / (1 + s / c^2), s the squared residual per degree of freedom in standard deviations.
void PoseSolver::State::reweight(const Pose2& pose) {
  const std::vector<Observation>& observations = *residuals.observations;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    Linearised& l = linearised[k];
    Vector2d residual;
    evaluate(observations[k], pose, residual, &l.by_pose);
    l.covariance = residual_covariance(observations[k], pose);
    const double squared =
        residual.dot((l.covariance.noise + l.covariance.plan).inverse() * residual) / observations[k].dimension();
    l.weight = 1.0 / (1.0 + squared / (params.robust_scale * params.robust_scale));
  }
}

void PoseSolver::State::finish(const SplitPose& prior, double omega, const Vector3d& x) {
  const Matrix3d prior_information = prior_covariance(prior, omega).inverse();
  const Matrix3d covariance = information(prior, linearised, omega).inverse();
  const Matrix3d keep = covariance * prior_information;
  Matrix3d independent = keep * prior.independent * keep.transpose();
  Eigen::Matrix<double, 3, kCalibrationParameters> by_mounting =
      Eigen::Matrix<double, 3, kCalibrationParameters>::Zero();
  const std::vector<Observation>& observations = *residuals.observations;
  const Pose2 pose = pose_of(x);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Linearised& l = linearised[k];
    const Eigen::Matrix<double, 3, 2> gain = covariance * l.by_pose.transpose() * intersected(l, omega).inverse();
    independent += gain * (l.covariance.noise / l.weight) * gain.transpose();
    by_mounting += gain * by_calibration(observations[k], pose, rig);
    Vector2d residual;
    evaluate(observations[k], pose, residual, nullptr);
    const double squared = residual.dot((l.covariance.noise + l.covariance.plan).inverse() * residual);
    solution.mahalanobis_squared.push_back(squared);
    solution.outlier.push_back(squared >
                               chi_square_gate(observations[k].dimension(), params.outlier_probability));
  }
  solution.pose = {pose, 0.5 * (independent + independent.transpose()), Matrix3d::Zero()};
  solution.pose.correlated = 0.5 * (covariance + covariance.transpose()) - solution.pose.independent;
  solution.calibration = by_mounting * calibration_variance(rig).asDiagonal() * by_mounting.transpose();
  Vector3d step = x - vector_of(prior.pose);
  step(2) = geometry::wrap_angle(step(2));
  solution.prior_mahalanobis_squared = step.dot(prior.covariance().inverse() * step);
}

PoseSolver::PoseSolver(const sensors::Rig& rig, const PoseSolverParams& params) : state_(std::make_unique<State>()) {
  state_->rig = rig;
  state_->params = params;
}
PoseSolver::~PoseSolver() = default;
PoseSolver::PoseSolver(PoseSolver&&) noexcept = default;
PoseSolver& PoseSolver::operator=(PoseSolver&&) noexcept = default;

const PoseSolution& PoseSolver::solve(const SplitPose& prior, const std::vector<Observation>& observations) {
  State& s = *state_;
  s.solution.mahalanobis_squared.clear();
  s.solution.outlier.clear();
  s.solution.prior_mahalanobis_squared = 0.0;
  if (observations.empty()) {
    s.solution.pose = prior;
    s.solution.calibration.setZero();
    return s.solution;
  }
  s.residuals.prior = vector_of(prior.pose);
  s.residuals.observations = &observations;
  s.residuals.whiteners.resize(observations.size());
  s.linearised.assign(observations.size(), {});
  Vector3d x = vector_of(prior.pose);
  s.linearise(prior.pose);
  double omega = 0.5;
  for (int i = 0; i <= s.params.reweightings; ++i) {
    omega = best_share(prior, s.linearised);
    s.minimise(prior, omega, x);
    s.reweight(pose_of(x));
  }
  s.finish(prior, omega, x);
  return s.solution;
}

}  // namespace credo::localization
