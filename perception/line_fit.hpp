// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "geometry/segment.hpp"
#include "sensors/acquisition.hpp"

namespace credo::perception {

struct LineFitParams {
  double beam_sigma_rad = 0.001;   ///< 1-sigma of a beam's direction (Pfister et al., ICRA 2003)
  double flatness_m = 0.002;       ///< 1-sigma of a wall about its line: plaster, paint, skirting
  double full_weight_until = 2.5;  ///< |residual| in expected standard deviations
  double no_weight_from = 4.5;     ///< linear between
  int iterations = 6;
};

/// How far a range reading is to be trusted: the noise law of its sensor and the parameters above.
struct PointNoise {
  sensors::RangeNoise range;
  LineFitParams params;

  /// Variance of a reading across a line with the given unit normal, if the true range is `range_m`. [m^2]
  [[nodiscard]] double variance_across(const Eigen::Vector2d& ray, double range_m,
                                       const Eigen::Vector2d& normal) const {
    return variance_across(normal.dot(ray), range_m);
  }
  /// The same by what the ray has along the normal.
  [[nodiscard]] double variance_across(double along, double range_m) const {
    const double kr2 = range.k_per_m * range_m * range_m;
    const double beam = params.beam_sigma_rad * range_m;
    return along * along * (range.sigma_0_m * range.sigma_0_m + kr2 * kr2) + (1.0 - along * along) * beam * beam +
           params.flatness_m * params.flatness_m;
  }
};

/// A line whose sine and cosine are taken once, for many points that are held against it.
struct DirectedLine {
  DirectedLine(const geometry::LineEstimate& line)  // NOLINT: a line is one
      : estimate(line), direction(line.direction()), normal(-direction.y(), direction.x()) {}

  geometry::LineEstimate estimate;
  Eigen::Vector2d direction, normal;
};

/// A line through range points and how well it explains them.
struct LineFit {
  geometry::LineEstimate line;
  double chi2 = 0.0;  ///< sum of the squared residuals in expected standard deviations, each at most no_weight_from^2
  int support = 0;    ///< points with full or part weight
  double mean_residual_sigmas = 0.0;  ///< mean |residual| of the support, in expected standard deviations
  double mean_residual_m = 0.0;
};

/// Weighted total least squares with robust weights: each point counts with the inverse of its variance across the
/// line, taken at the range that the line predicts for its beam (at the measured range, short readings would weigh more
/// and pull the line towards the sensor). The covariance is that of Pfister et al., ICRA 2003; it grows with the
/// residuals where they are larger than the sensor's noise law can explain. One point, or points that coincide, give a
/// line across the ray with a sigma_angle of pi/2; none gives support 0.
[[nodiscard]] LineFit fit_line(std::span<const sensors::ScanPoint> points, const PointNoise& noise);

/// The residuals of points about a given line, as fit_line reports them.
[[nodiscard]] LineFit judge_line(std::span<const sensors::ScanPoint> points, const DirectedLine& line,
                                 const PointNoise& noise);

/// Residual of one point across a line, in expected standard deviations; signed along the line's normal.
[[nodiscard]] double residual_sigmas(const sensors::ScanPoint& point, const DirectedLine& line,
                                     const PointNoise& noise);

/// Range at which the point's beam meets the line; the measured one if it meets it grazing or not within half and twice
/// that.
[[nodiscard]] double predicted_range(const sensors::ScanPoint& point, const DirectedLine& line);

/// Variance across the line of the line's own position beside a point. [m^2]
[[nodiscard]] double variance_at(const DirectedLine& line, const Eigen::Vector2d& point);

/// A point with the covariance of its error. [m, m^2]
struct PointEstimate {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// Where two lines with independent errors meet.
/// \returns nothing where they are closer to parallel than `min_sine`.
[[nodiscard]] std::optional<PointEstimate> intersect(const geometry::LineEstimate& first,
                                                     const geometry::LineEstimate& second, double min_sine = 0.05);

/// Where a bearing from `origin` meets a line, with both their errors.
/// \returns nothing where the ray is closer to parallel than `min_sine`, or meets the line behind the origin.
[[nodiscard]] std::optional<PointEstimate> intersect_ray(const geometry::LineEstimate& line,
                                                         const Eigen::Vector2d& origin, double azimuth,
                                                         double sigma_azimuth, double min_sine = 0.05);

/// A point estimate sharpened by an independent bearing of it from `origin` (one step of an extended Kalman filter).
[[nodiscard]] PointEstimate with_bearing(const PointEstimate& point, const Eigen::Vector2d& origin, double azimuth,
                                         double sigma_azimuth);

}  // namespace credo::perception
