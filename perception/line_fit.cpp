// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/line_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
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

/// Range at which a beam meets a line that the measured end of it lies `residual` off.
/// \param along  what the ray has along the line's normal
double range_on_line(double range_m, double residual, double along) {
  const double range = range_m - residual / along;
  const bool met = (std::abs(along) >= 0.05) & (range >= 0.5 * range_m) & (range <= 2.0 * range_m);
  return met ? range : range_m;
}

/// One over the variance across a line of readings, as range_on_line() takes them. Side by side, without branches: the
/// divisions are what takes the time of a fit.
void inform(const double* ranges_m, const double* residuals, const double* along, std::size_t count, PointNoise noise,
            double* informations) {
  for (std::size_t i = 0; i < count; ++i)
    informations[i] = 1.0 / noise.variance_across(along[i], range_on_line(ranges_m[i], residuals[i], along[i]));
}

/// Visits points in their order with the residual across a line and its information.
template <class Visit>
void for_each_residual(std::span<const ScanPoint> points, const DirectedLine& line, const PointNoise& noise,
                       Visit&& visit) {
  constexpr std::size_t kMost = 64;
  std::array<double, kMost> ranges_m, residuals, along, informations;
  const double offset = line.normal.dot(line.estimate.centroid);
  for (; !points.empty(); points = points.subspan(std::min(kMost, points.size()))) {
    const std::size_t count = std::min(kMost, points.size());
    for (std::size_t i = 0; i < count; ++i) {
      ranges_m[i] = points[i].range_m;
      residuals[i] = line.normal.dot(points[i].position) - offset;
      along[i] = line.normal.dot(points[i].ray);
    }
    inform(ranges_m.data(), residuals.data(), along.data(), count, noise, informations.data());
    for (std::size_t i = 0; i < count; ++i) visit(points[i], residuals[i], informations[i]);
  }
}

/// Weighted moments about a line.
/// \returns whether there are outliers
bool weigh(std::span<const ScanPoint> points, const LineEstimate& line, const PointNoise& noise, bool l1,
           const Eigen::Vector2d& anchor, Moments& moments) {
  double largest = 0.0;
  for_each_residual(points, line, noise, [&](const ScanPoint& point, double residual, double information) {
    const double squared = residual * residual * information;
    largest = std::max(largest, squared);
    const double weight = l1 ? l1_weight(squared) : robust_weight(squared, noise.params);
    moments.add(weight * information, point.position - anchor);
  });
  return largest > noise.params.full_weight_until * noise.params.full_weight_until;
}

void set_line_across_ray(std::span<const ScanPoint> points, LineEstimate& line) {
  line.angle = std::atan2(points.front().ray.y(), points.front().ray.x()) + std::numbers::pi / 2.0;
}

/// sigma_across and sigma_angle from the weights, independent at the centroid (Pfister et al.).
void set_covariance(std::span<const ScanPoint> points, const DirectedLine& line, const PointNoise& noise,
                    LineFit& fit) {
  double sum = 0.0, moment = 0.0;
  for_each_residual(points, line, noise, [&](const ScanPoint& point, double residual, double information) {
    const double weight = robust_weight(residual * residual * information, noise.params) * information;
    const double s = line.direction.dot(point.position - line.estimate.centroid);
    sum += weight;
    moment += weight * s * s;
  });
  // Residuals beyond two standard deviations of what chi-square allows say that the noise law is too good.
  const double freedom = std::max(1, fit.support - 2);
  const double excess = fit.support > 4 ? std::max(1.0, fit.chi2 / freedom - 2.0 * std::sqrt(2.0 / freedom)) : 1.0;
  fit.line.sigma_across = sum > 0.0 ? std::sqrt(excess / sum) : std::sqrt(1.0 / 1e-12);
  fit.line.sigma_angle = moment > 0.0 ? std::min(kLargestSigmaAngle, std::sqrt(excess / moment)) : kLargestSigmaAngle;
}

}  // namespace

double predicted_range(const ScanPoint& point, const DirectedLine& line) {
  return range_on_line(point.range_m, line.normal.dot(point.position - line.estimate.centroid),
                       line.normal.dot(point.ray));
}

double residual_sigmas(const ScanPoint& point, const DirectedLine& line, const PointNoise& noise) {
  return line.normal.dot(point.position - line.estimate.centroid) /
         std::sqrt(noise.variance_across(point.ray, predicted_range(point, line), line.normal));
}

LineFit judge_line(std::span<const ScanPoint> points, const DirectedLine& line, const PointNoise& noise) {
  LineFit fit{.line = line.estimate};
  const double most = noise.params.no_weight_from;
  for_each_residual(points, line, noise, [&](const ScanPoint&, double residual, double information) {
    const double sigmas = std::abs(residual) * std::sqrt(information);
    fit.chi2 += std::min(sigmas * sigmas, most * most);
    if (sigmas >= most) return;
    ++fit.support;
    fit.mean_residual_sigmas += sigmas;
    fit.mean_residual_m += std::abs(residual);
  });
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
  const DirectedLine directed = line;
  LineFit fit = judge_line(points, directed, noise);
  set_covariance(points, directed, noise, fit);
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
