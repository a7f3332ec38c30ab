// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/line_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using geometry::LineEstimate;
using sensors::ScanPoint;

constexpr double kLargestSigmaAngle = std::numbers::pi / 2.0;
constexpr int kL1Steps = 2;
constexpr double kSettledAngle = 1e-6;

/// Weighted sums of points relative to an anchor.
struct Moments {
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double weight, const Eigen::Vector2d& p) {
    w += weight;
    x += weight * p.x();
    y += weight * p.y();
    xx += weight * p.x() * p.x();
    xy += weight * p.x() * p.y();
    yy += weight * p.y() * p.y();
  }
};

/// The total least squares line: along the largest axis of the scatter.
/// \returns false where the points coincide.
bool set_line(const Moments& m, const Eigen::Vector2d& anchor, LineEstimate& line) {
  const double cx = m.x / m.w, cy = m.y / m.w;
  const double sxx = m.xx / m.w - cx * cx, sxy = m.xy / m.w - cx * cy, syy = m.yy / m.w - cy * cy;
  line.centroid = anchor + Eigen::Vector2d(cx, cy);
  if (sxx + syy < 1e-12) return false;
  line.angle = 0.5 * std::atan2(2.0 * sxy, sxx - syy);
  return true;
}

/// What a point may say after its residual is known, by the square of it: 1, falling to 0.
double robust_weight(double squared_sigmas, const LineFitParams& params) {
  const double full = params.full_weight_until, none = params.no_weight_from;
  if (squared_sigmas <= full * full) return 1.0;
  if (squared_sigmas >= none * none) return 0.0;
  return (none - std::sqrt(squared_sigmas)) / (none - full);
}

/// The weight of the first steps, of an L1 fit, which finds the line among outliers.
double l1_weight(double squared_sigmas) { return squared_sigmas <= 1.0 ? 1.0 : 1.0 / std::sqrt(squared_sigmas); }

double range_on_line(const ScanPoint& point, const Eigen::Vector2d& normal, double offset) {
  const double along = normal.dot(point.ray);
  if (std::abs(along) < 0.05) return point.range_m;
  // The point lies `residual` off the line along the normal, so residual / along off it along the ray.
  const double range = point.range_m - (normal.dot(point.position) - offset) / along;
  return range >= 0.5 * point.range_m && range <= 2.0 * point.range_m ? range : point.range_m;
}

/// Weighted moments about a line.
/// \returns whether there are outliers
bool weigh(std::span<const ScanPoint> points, const LineEstimate& line, const PointNoise& noise, bool l1,
           const Eigen::Vector2d& anchor, Moments& moments) {
  const Eigen::Vector2d normal = line.normal();
  const double offset = normal.dot(line.centroid);
  double largest = 0.0;
  for (const ScanPoint& point : points) {
    const double variance = noise.variance_across(point.ray, range_on_line(point, normal, offset), normal);
    const double residual = normal.dot(point.position) - offset;
    const double squared = residual * residual / variance;
    largest = std::max(largest, squared);
    moments.add((l1 ? l1_weight(squared) : robust_weight(squared, noise.params)) / variance, point.position - anchor);
  }
  return largest > noise.params.full_weight_until * noise.params.full_weight_until;
}

void set_line_across_ray(std::span<const ScanPoint> points, LineEstimate& line) {
  line.angle = std::atan2(points.front().ray.y(), points.front().ray.x()) + std::numbers::pi / 2.0;
}

/// sigma_across and sigma_angle from the weights, independent at the centroid (Pfister et al.).
void set_covariance(std::span<const ScanPoint> points, const PointNoise& noise, LineFit& fit) {
  const Eigen::Vector2d normal = fit.line.normal(), along = fit.line.direction();
  const double offset = normal.dot(fit.line.centroid);
  double information = 0.0, moment = 0.0;
  for (const ScanPoint& point : points) {
    const double variance = noise.variance_across(point.ray, range_on_line(point, normal, offset), normal);
    const double residual = normal.dot(point.position) - offset;
    const double weight = robust_weight(residual * residual / variance, noise.params) / variance;
    const double s = along.dot(point.position - fit.line.centroid);
    information += weight;
    moment += weight * s * s;
  }
  // Residuals beyond two standard deviations of what chi-square allows say that the noise law is too good.
  const double freedom = std::max(1, fit.support - 2);
  const double excess = fit.support > 4 ? std::max(1.0, fit.chi2 / freedom - 2.0 * std::sqrt(2.0 / freedom)) : 1.0;
  fit.line.sigma_across = information > 0.0 ? std::sqrt(excess / information) : std::sqrt(1.0 / 1e-12);
  fit.line.sigma_angle = moment > 0.0 ? std::min(kLargestSigmaAngle, std::sqrt(excess / moment)) : kLargestSigmaAngle;
}

}  // namespace

double predicted_range(const ScanPoint& point, const DirectedLine& line) {
  return range_on_line(point, line.normal, line.normal.dot(line.estimate.centroid));
}

double residual_sigmas(const ScanPoint& point, const DirectedLine& line, const PointNoise& noise) {
  const double offset = line.normal.dot(line.estimate.centroid);
  return (line.normal.dot(point.position) - offset) /
         std::sqrt(noise.variance_across(point.ray, range_on_line(point, line.normal, offset), line.normal));
}

LineFit judge_line(std::span<const ScanPoint> points, const LineEstimate& line, const PointNoise& noise) {
  LineFit fit{.line = line};
  const Eigen::Vector2d normal = line.normal();
  const double offset = normal.dot(line.centroid);
  const double most = noise.params.no_weight_from;
  for (const ScanPoint& point : points) {
    const double residual = std::abs(normal.dot(point.position) - offset);
    const double variance = noise.variance_across(point.ray, range_on_line(point, normal, offset), normal);
    const double sigmas = residual / std::sqrt(variance);
    fit.chi2 += std::min(sigmas * sigmas, most * most);
    if (sigmas >= most) continue;
    ++fit.support;
    fit.mean_residual_sigmas += sigmas;
    fit.mean_residual_m += residual;
  }
  if (fit.support > 0) {
    fit.mean_residual_sigmas /= fit.support;
    fit.mean_residual_m /= fit.support;
  }
  return fit;
}

LineFit fit_line(std::span<const ScanPoint> points, const PointNoise& noise) {
  if (points.empty()) return {.line = {.sigma_across = 1e6, .sigma_angle = kLargestSigmaAngle}};
  const Eigen::Vector2d anchor = points.front().position;
  LineEstimate line;
  Moments first;
  for (const ScanPoint& point : points)
    first.add(1.0 / (point.sigma_m * point.sigma_m + 1e-8), point.position - anchor);
  bool spread = set_line(first, anchor, line);
  bool outliers = false;  // L1 steps are for scans that need them
  for (int iteration = 0; spread && points.size() > 2 && iteration < noise.params.iterations; ++iteration) {
    const bool l1 = outliers && iteration <= kL1Steps;
    const double before = line.angle;
    Moments moments;
    outliers |= weigh(points, line, noise, l1, anchor, moments) && iteration == 0;
    if (iteration == 0 && outliers) continue;
    if (moments.w <= 0.0) break;
    spread = set_line(moments, anchor, line);
    if (!l1 && iteration > 0 && std::abs(line.angle - before) < kSettledAngle) break;
  }
  if (!spread) set_line_across_ray(points, line);
  LineFit fit = judge_line(points, line, noise);
  set_covariance(points, noise, fit);
  if (!spread) fit.line.sigma_angle = kLargestSigmaAngle;
  return fit;
}

double variance_at(const DirectedLine& line, const Eigen::Vector2d& point) {
  const LineEstimate& e = line.estimate;
  const double s = line.direction.dot(point - e.centroid);
  return e.sigma_across * e.sigma_across + s * s * e.sigma_angle * e.sigma_angle;
}

std::optional<PointEstimate> intersect(const LineEstimate& first, const LineEstimate& second, double min_sine) {
  Eigen::Matrix2d normals;
  normals.row(0) = first.normal().transpose();
  normals.row(1) = second.normal().transpose();
  if (std::abs(normals.determinant()) < min_sine) return std::nullopt;
  const Eigen::Matrix2d inverse = normals.inverse();
  PointEstimate point;
  // Relative to one centroid, so that far lines lose no digits.
  point.position =
      first.centroid + inverse * Eigen::Vector2d(0.0, normals.row(1).dot(second.centroid - first.centroid));
  const Eigen::Vector2d variances(variance_at(first, point.position), variance_at(second, point.position));
  point.covariance = inverse * variances.asDiagonal() * inverse.transpose();
  return point;
}

std::optional<PointEstimate> intersect_ray(const LineEstimate& line, const Eigen::Vector2d& origin, double azimuth,
                                           double sigma_azimuth, double min_sine) {
  const Eigen::Vector2d ray(std::cos(azimuth), std::sin(azimuth));
  const Eigen::Vector2d normal = line.normal(), along = line.direction();
  const double sine = normal.dot(ray);
  if (std::abs(sine) < min_sine) return std::nullopt;
  const double range = normal.dot(line.centroid - origin) / sine;
  if (range <= 0.0) return std::nullopt;
  PointEstimate point{.position = origin + range * ray};
  // A line that shifts across itself carries the point along the ray; a bearing that turns carries it along the line.
  const Eigen::Vector2d by_shift = ray / sine;
  const Eigen::Vector2d by_turn = along * (range / sine);
  point.covariance = variance_at(line, point.position) * by_shift * by_shift.transpose() +
                     sigma_azimuth * sigma_azimuth * by_turn * by_turn.transpose();
  return point;
}

PointEstimate with_bearing(const PointEstimate& point, const Eigen::Vector2d& origin, double azimuth,
                           double sigma_azimuth) {
  const Eigen::Vector2d offset = point.position - origin;
  const double squared_range = offset.squaredNorm();
  if (squared_range < 1e-12) return point;
  const Eigen::Vector2d jacobian = Eigen::Vector2d(-offset.y(), offset.x()) / squared_range;
  const Eigen::Vector2d projected = point.covariance * jacobian;
  const double innovation_variance = jacobian.dot(projected) + sigma_azimuth * sigma_azimuth;
  const double innovation = geometry::angle_difference(azimuth, std::atan2(offset.y(), offset.x()));
  PointEstimate fused;
  fused.position = point.position + projected * (innovation / innovation_variance);
  fused.covariance = point.covariance - projected * projected.transpose() / innovation_variance;
  return fused;
}

}  // namespace credo::perception
