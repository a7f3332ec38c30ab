// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

#include "geometry/pose.hpp"

namespace credo::tracking {

/// A point as azimuth and inverse range from the origin of a frame. One form for all that can be known of a landmark: a
/// measured position, a bearing whose range is anything from near to infinity (inverse range 0), and all between once
/// motion parallax has told something. Errors in it stay close to Gaussian where those of a position do not.
struct PolarPoint {
  double azimuth = 0.0;                                  ///< [rad]
  double inverse_range = 0.0;                            ///< [1/m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (azimuth, inverse range)

  [[nodiscard]] double sigma_azimuth() const { return std::sqrt(covariance(0, 0)); }
  /// Position where there is a range: inverse_range > 0. [m]
  [[nodiscard]] Eigen::Vector2d position() const {
    return Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)) / inverse_range;
  }
};

/// The point of frame `a` in frame `b`, with first-order covariance. A point within reach of the new origin keeps a
/// finite result with an azimuth known to nobody (sigma pi).
[[nodiscard]] PolarPoint carry(const PolarPoint& point_a, const geometry::PoseEstimate& T_a_b);

/// The same from a place that is known exactly, in the same directions.
[[nodiscard]] PolarPoint seen_from(const PolarPoint& point, const Eigen::Vector2d& origin);

/// `point` after one more bearing of it, taken from `origin` (in the frame of `point`, same directions): an extended
/// Kalman update. The parallax between origin, motion and bearing sharpens the range.
/// \param azimuth, sigma  the bearing [rad]
[[nodiscard]] PolarPoint with_bearing(const PolarPoint& point, const Eigen::Vector2d& origin, double azimuth,
                                      double sigma);

/// Mahalanobis distance between two independent estimates of a point, azimuth difference the short way round.
/// \param ranges_too  false: by azimuth alone
[[nodiscard]] double distance_in_sigmas(const PolarPoint& a, const PolarPoint& b, bool ranges_too);

}  // namespace credo::tracking
