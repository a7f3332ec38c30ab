// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/polar_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace credo::tracking {
namespace {

constexpr double kAtTheOrigin = 1e-3;  // |direction| below which a bearing means nothing any more

struct Shift {
  double azimuth = 0.0;
  double inverse_range = 0.0;
  Eigen::Matrix2d by_point;   // derivative by (azimuth, inverse range)
  Eigen::Matrix2d by_origin;  // by (x, y) of the new origin
  bool degenerate = false;
};

// With u the unit vector of the azimuth and w the inverse range, the point is u / w; from the origin t it lies in the
// direction q = u - w t at the inverse range w / |q|, which has no singularity at infinity.
Shift shift(const PolarPoint& point, const Eigen::Vector2d& t) {
  const Eigen::Vector2d u(std::cos(point.azimuth), std::sin(point.azimuth));
  const double w = point.inverse_range;
  const Eigen::Vector2d q = u - w * t;
  const double squared = q.squaredNorm(), length = std::sqrt(squared);
  Shift result;
  if (length < kAtTheOrigin) {
    result.azimuth = point.azimuth;
    result.inverse_range = w;
    result.degenerate = true;
    return result;
  }
  result.azimuth = std::atan2(q.y(), q.x());
  result.inverse_range = w / length;
  const Eigen::RowVector2d azimuth_by_q = Eigen::RowVector2d(-q.y(), q.x()) / squared;
  const Eigen::RowVector2d inverse_by_q = -w / (squared * length) * q.transpose();
  const Eigen::Vector2d q_by_azimuth(-u.y(), u.x());
  result.by_point << azimuth_by_q * q_by_azimuth, -azimuth_by_q * t, inverse_by_q * q_by_azimuth,
      1.0 / length - inverse_by_q * t;
  result.by_origin << -w * azimuth_by_q, -w * inverse_by_q;
  return result;
}

PolarPoint unknown_direction(const PolarPoint& point) {
  PolarPoint result = point;
  result.covariance << std::numbers::pi * std::numbers::pi, 0.0, 0.0, point.inverse_range * point.inverse_range;
  return result;
}

}  // namespace

PolarPoint carry(const PolarPoint& point_a, const geometry::PoseEstimate& T_a_b) {
  const Shift moved = shift(point_a, T_a_b.pose.translation());
  if (moved.degenerate) return unknown_direction(point_a);
  Eigen::Matrix<double, 2, 3> by_motion;
  by_motion.leftCols<2>() = moved.by_origin;
  by_motion.col(2) << -1.0, 0.0;
  PolarPoint point_b{.azimuth = geometry::wrap_angle(moved.azimuth - T_a_b.pose.theta),
                     .inverse_range = moved.inverse_range,
                     .covariance = moved.by_point * point_a.covariance * moved.by_point.transpose() +
                                   by_motion * T_a_b.covariance * by_motion.transpose()};
  const double limit = std::numbers::pi * std::numbers::pi;
  return point_b.covariance(0, 0) < limit ? point_b : unknown_direction(point_b);
}

PolarPoint seen_from(const PolarPoint& point, const Eigen::Vector2d& origin) {
  if (origin.isZero(0.0)) return point;
  const Shift moved = shift(point, origin);
  if (moved.degenerate) return unknown_direction(point);
  return {.azimuth = moved.azimuth,
          .inverse_range = moved.inverse_range,
          .covariance = moved.by_point * point.covariance * moved.by_point.transpose()};
}

PolarPoint with_bearing(const PolarPoint& point, const Eigen::Vector2d& origin, double azimuth, double sigma) {
  const Shift expected = shift(point, origin);
  if (expected.degenerate) return point;
  const Eigen::RowVector2d H = expected.by_point.row(0);
  const Eigen::Vector2d PHt = point.covariance * H.transpose();
  const double variance = H.dot(PHt.transpose()) + sigma * sigma;
  if (!(variance > 0.0)) return point;
  const Eigen::Vector2d gain = PHt / variance;
  const double innovation = geometry::angle_difference(azimuth, expected.azimuth);
  PolarPoint result;
  result.azimuth = geometry::wrap_angle(point.azimuth + gain.x() * innovation);
  result.inverse_range = point.inverse_range + gain.y() * innovation;
  const Eigen::Matrix2d keep = Eigen::Matrix2d::Identity() - gain * H;
  // Joseph's form: stays symmetric and positive.
  result.covariance = keep * point.covariance * keep.transpose() + sigma * sigma * gain * gain.transpose();
  return result;
}

double distance_in_sigmas(const PolarPoint& a, const PolarPoint& b, bool ranges_too) {
  const double azimuth = geometry::angle_difference(a.azimuth, b.azimuth);
  const Eigen::Matrix2d S = a.covariance + b.covariance;
  if (!ranges_too) return std::abs(azimuth) / std::sqrt(S(0, 0));
  const double inverse = a.inverse_range - b.inverse_range;
  const double squared =
      (S(1, 1) * azimuth * azimuth - 2.0 * S(0, 1) * azimuth * inverse + S(0, 0) * inverse * inverse) /
      (S(0, 0) * S(1, 1) - S(0, 1) * S(0, 1));
  return std::sqrt(std::max(0.0, squared));
}

}  // namespace credo::tracking
