// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_residuals.hpp"

#include <algorithm>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Vector2d quarter_turned(const Vector2d& v) { return {-v.y(), v.x()}; }

/// By how much a bearing's direction changes with the map's point. [rad/m]
Vector2d bearing_by_place(const Observation& o, const StateFrame& frame) {
  constexpr double kNearest_m2 = 1e-4;
  const Vector2d way = o.map_point - frame * o.base_point;
  return quarter_turned(way) / std::max(way.squaredNorm(), kNearest_m2);
}

void evaluate_bearing(const Observation& o, const Vector2d& fixed, const StateFrame& frame, const PoseState::Vector& x,
                      Vector2d& residual, PoseState::Jacobian* jacobian) {
  const Vector2d from = frame * o.base_point;
  const Vector2d way = o.map_point - from;
  const double c = fixed.x(), s = fixed.y();
  const double observed =
      o.base_angle + x(PoseState::kCameraTheta) + x(PoseState::kCameraCos) * c + x(PoseState::kCameraSin) * s;
  residual = {geometry::wrap_angle(std::atan2(way.y(), way.x()) - x(PoseState::kTheta) - observed), 0.0};
  if (!jacobian) return;
  const Vector2d aside = bearing_by_place(o, frame);
  const Vector2d by_theta = quarter_turned(from - frame.t);
  jacobian->row(0) << -aside.x(), -aside.y(), -aside.dot(by_theta) - 1.0, 0.0, 0.0, 0.0, -1.0, -c, -s;
}

}  // namespace

StateFrame::StateFrame(const PoseState::Vector& x)
    : R(geometry::Pose2{0.0, 0.0, x(PoseState::kTheta)}.rotation()), t(x.head<2>()) {}

Vector2d fixed_direction(const Observation& o) {
  const double angle = o.kind == ObservationKind::kBearing ? o.base_angle : o.map_angle;
  return {std::cos(angle), std::sin(angle)};
}

void evaluate(const Observation& o, const Vector2d& fixed, const StateFrame& frame, const PoseState::Vector& x,
              Vector2d& residual, PoseState::Jacobian* jacobian) {
  if (jacobian) jacobian->setZero();
  if (o.kind == ObservationKind::kBearing) return evaluate_bearing(o, fixed, frame, x, residual, jacobian);
  // The scan as a whole is off by (x, y, theta), in first order.
  const Vector2d shift = x.segment<2>(PoseState::kRangeX);
  const Vector2d in_base = o.base_point + shift + x(PoseState::kRangeTheta) * quarter_turned(o.base_point);
  const Vector2d in_map = frame * in_base;
  const Vector2d by_theta = quarter_turned(in_map - frame.t);
  const Vector2d by_scan_theta = frame.R * quarter_turned(o.base_point);
  if (o.kind == ObservationKind::kPoint) {
    residual = in_map - o.map_point;
    if (!jacobian) return;
    jacobian->leftCols<2>().setIdentity();
    jacobian->col(PoseState::kTheta) = by_theta;
    jacobian->middleCols<2>(PoseState::kRangeX) = frame.R;
    jacobian->col(PoseState::kRangeTheta) = by_scan_theta;
    return;
  }
  const Vector2d normal = quarter_turned(fixed);
  const double angle = o.base_angle + x(PoseState::kRangeTheta) + x(PoseState::kTheta);
  residual = {normal.dot(in_map - o.map_point), geometry::wrap_line_angle(angle - o.map_angle)};
  if (!jacobian) return;
  const Vector2d normal_in_base = frame.R.transpose() * normal;
  jacobian->row(0) << normal.x(), normal.y(), normal.dot(by_theta), normal_in_base.x(), normal_in_base.y(),
      normal.dot(by_scan_theta), 0.0, 0.0, 0.0;
  (*jacobian)(1, PoseState::kTheta) = 1.0;
  (*jacobian)(1, PoseState::kRangeTheta) = 1.0;
}

void evaluate(const Observation& o, const PoseState::Vector& x, Vector2d& residual, PoseState::Jacobian* jacobian) {
  evaluate(o, fixed_direction(o), StateFrame(x), x, residual, jacobian);
}

void evaluate(const Observation& o, const geometry::Pose2& pose, Vector2d& residual) {
  PoseState::Vector x = PoseState::Vector::Zero();
  x.head<3>() << pose.x, pose.y, pose.theta;
  evaluate(o, x, residual, nullptr);
}

Matrix2d residual_by_landmark(const Observation& o, const StateFrame& frame) {
  if (o.kind != ObservationKind::kBearing) return -Matrix2d::Identity();
  Matrix2d J = Matrix2d::Zero();
  J.row(0) = bearing_by_place(o, frame).transpose();
  return J;
}

ResidualCovariance residual_covariance(const Observation& o, const StateFrame& frame, const Matrix2d& by_landmark) {
  switch (o.kind) {
    case ObservationKind::kWall: return {o.noise, o.plan};
    case ObservationKind::kPoint: return {frame.R * o.noise * frame.R.transpose(), o.plan};
    case ObservationKind::kBearing: {
      Matrix2d noise = Matrix2d::Identity();
      noise(0, 0) = o.noise(0, 0);
      return {noise, by_landmark * o.plan * by_landmark.transpose()};
    }
  }
  return {};
}

ResidualCovariance residual_covariance(const Observation& o, const StateFrame& frame) {
  return residual_covariance(o, frame, residual_by_landmark(o, frame));
}

LandmarkByPlan landmark_by_plan(const Observation& o, std::size_t index, const Vector2d& fixed) {
  const bool own = index == o.plan_terms.size();
  if (o.kind != ObservationKind::kWall) {
    const int column = own ? o.own_column : 2 * o.plan_terms[index].junction;
    return {column, (own ? o.own_sigma_m : o.plan_sigma_m) * Matrix2d::Identity()};
  }
  if (own) return {o.own_column, Vector2d(o.own_sigma_m, o.own_sigma_rad).asDiagonal()};
  const PlanTerm& term = o.plan_terms[index];
  const Vector2d normal = quarter_turned(fixed);
  return {2 * term.junction,
          o.plan_sigma_m * Vector2d(term.offset + term.slope * o.plan_along_m, term.slope) * normal.transpose()};
}

}  // namespace credo::localization
