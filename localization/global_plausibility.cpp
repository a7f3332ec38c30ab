// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/global_plausibility.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using geometry::PoseEstimate;

/// A point farther behind the first wall than so many of its standard deviations is behind it.
constexpr double kThroughSigmas = 3.0;
/// A radial line is no point of the plan that is farther from it. [standard deviations]
constexpr double kBearingGate = 3.0;
constexpr double kNormal = 0.3989422804014327;  // 1 / sqrt(2 pi)

Vector2d left_of(const Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

double Plausibility::scan_share() const {
  constexpr double kBeforeWeight = 0.1;
  const double weight = on_plan + behind + kBeforeWeight * before;
  return weight > 0.0 ? on_plan / weight : 0.0;
}

ScenePlausibility::ScenePlausibility(const LandmarkMap& map, const DistanceField& field, const sensors::Rig& rig,
                                     const PlausibilityParams& params)
    : map_(&map), params_(params), field_(&field) {
  if (!rig.range_finders.empty()) range_finder_.push_back(rig.range_finders.front());
}

void ScenePlausibility::look_at(const perception::Scene& scene) {
  beams_.clear();
  silent_.clear();
  bearings_.clear();
  camera_ = scene.camera_origin;
  for (const perception::RadialLine& line : scene.radial_lines) bearings_.push_back(line.azimuth);
  if (range_finder_.empty() || !scene.range_finder_seen) return;

  const sensors::RangeFinder& finder = range_finder_.front();
  const int stride = std::max(1, (finder.count + params_.most_beams - 1) / params_.most_beams);
  answered_.assign(static_cast<std::size_t>(finder.count), false);
  for (const sensors::ScanPoint& point : scene.points) {
    if (point.beam < 0 || point.beam >= finder.count) continue;
    answered_[static_cast<std::size_t>(point.beam)] = true;
    if (point.beam % stride != 0) continue;
    beams_.push_back({.origin = point.position - point.range_m * point.ray,
                      .ray = point.ray,
                      .point = point.position,
                      .range_m = point.range_m,
                      .sigma_m = std::hypot(params_.on_plan_sigma_m, point.sigma_m)});
  }
  const auto answered = [&](int beam) {
    return answered_[static_cast<std::size_t>((beam + finder.count) % finder.count)];
  };
  for (int beam = 0; beam < finder.count; beam += stride) {
    if (answered(beam - 1) || answered(beam) || answered(beam + 1)) continue;
    const double angle = finder.T_base_sensor.theta + finder.beam_angle(beam);
    silent_.push_back({.origin = finder.T_base_sensor.translation(), .ray = {std::cos(angle), std::sin(angle)}});
  }
}

double ScenePlausibility::on_plan(double sigmas) const {
  const double off = std::exp(params_.before - params_.on_plan);
  return params_.beam_weight * (params_.on_plan + std::log(off + (1.0 - off) * std::exp(-0.5 * sigmas * sigmas)));
}

Plausibility ScenePlausibility::at(const Pose2& T_map_base) {
  Plausibility plausibility;
  const Matrix2d R = T_map_base.rotation();
  const Vector2d t = T_map_base.translation();
  double sum = 0.0;
  for (const Beam& beam : beams_) {
    const Vector2d ray = R * beam.ray;
    const RayHit hit = map_->first_hit(t + R * beam.origin, ray, beam.range_m);
    const double passed_m = beam.range_m - hit.range_m;
    const double through_m = passed_m * std::abs(ray.dot(hit.normal));
    const double tolerance_m = kThroughSigmas * beam.sigma_m;
    if (passed_m > 0.0 && through_m > tolerance_m) {
      sum += params_.beam_weight * params_.behind;
      ++plausibility.behind;
      continue;
    }
    const double distance_m = (*field_)(t + R * beam.point);
    sum += on_plan(distance_m / beam.sigma_m);
    ++(distance_m <= tolerance_m ? plausibility.on_plan : plausibility.before);
  }
  for (const Beam& beam : silent_) {
    const double reach_m = range_finder_.front().range_max_m;
    const Vector2d ray = R * beam.ray;
    const RayHit hit = map_->first_hit(t + R * beam.origin, ray, reach_m);
    if (!(hit.range_m <= reach_m))
      sum += params_.beam_weight * params_.silent_in_the_open;
    else if (hit.range_m < params_.surely_in_reach * reach_m && -ray.dot(hit.normal) > params_.steepest_incidence)
      sum += params_.beam_weight * params_.silent_before_wall;
  }
  plausibility.log_ratio = sum + params_.bearing_weight * bearings_at(T_map_base);
  return plausibility;
}

void ScenePlausibility::list_sights(const Pose2& pose) {
  constexpr double kBefore_m = 0.1, kNearest_m = 0.2;
  sights_.clear();
  const Vector2d camera = pose * camera_;
  for (const PointLandmark& point : map_->points()) {
    const Vector2d way = point.position - camera;
    const double range_m = way.norm();
    if (range_m > params_.sight_m || range_m < kNearest_m) continue;
    if (!map_->sees(camera, point.position, kBefore_m)) continue;
    if (!map_->type_from(point, camera)) continue;
    sights_.push_back({.point = point.position});
  }
  aim_sights(pose);
}

/// The same points from a pose beside the one that they were listed for.
void ScenePlausibility::aim_sights(const Pose2& pose) {
  const Vector2d camera = pose * camera_;
  for (Sight& sight : sights_) {
    sight.way = sight.point - camera;
    sight.azimuth = std::atan2(sight.way.y(), sight.way.x());
    sight.sigma = std::hypot(params_.bearing_sigma_rad, params_.bearing_sigma_m / sight.way.norm());
  }
}

/// The share of the radial lines that are expected to be points in sight: of many lines, most are something else.
double ScenePlausibility::mapped_share() const {
  const double recognised = params_.recognised_share * static_cast<double>(sights_.size());
  return std::min(params_.most_mapped_share, recognised / static_cast<double>(bearings_.size()));
}

/// Density of a radial line from a sight, against one from anywhere. \param sigmas  between the two
double ScenePlausibility::against_chance(const Sight& sight, double sigmas) const {
  const double density = kNormal * std::exp(-0.5 * sigmas * sigmas) / sight.sigma;
  return mapped_share() * geometry::kTurn * density / static_cast<double>(sights_.size());
}

/// A radial line comes from one of the points in sight, or from anywhere.
double ScenePlausibility::bearings_at(const Pose2& pose) {
  if (bearings_.empty()) return 0.0;
  list_sights(pose);
  double sum = 0.0;
  for (const double bearing : bearings_) {
    double mapped = 0.0;
    for (const Sight& sight : sights_) {
      const double sigmas = geometry::angle_difference(bearing + pose.theta, sight.azimuth) / sight.sigma;
      if (std::abs(sigmas) < kBearingGate) mapped += against_chance(sight, sigmas);
    }
    sum += std::log(1.0 - mapped_share() + mapped);
  }
  return sum;
}

void ScenePlausibility::NormalEquations::add(const Vector3d& by_pose, double residual, double weight) {
  information += weight * by_pose * by_pose.transpose();
  pull -= weight * residual * by_pose;
}

/// The way across the first wall along each beam, with Geman and McClure's weights.
void ScenePlausibility::pull_beams(const Pose2& pose, double scale_m, NormalEquations& equations) const {
  const Matrix2d R = pose.rotation();
  const Vector2d t = pose.translation();
  for (const Beam& beam : beams_) {
    const Vector2d ray = R * beam.ray, arm = R * beam.point;
    const RayHit hit = map_->first_hit(t + R * beam.origin, ray, beam.range_m + 2.0 * scale_m);
    if (!std::isfinite(hit.range_m)) continue;
    const double residual = (beam.range_m - hit.range_m) * ray.dot(hit.normal);
    const double scale = std::max(scale_m, 2.0 * beam.sigma_m);
    const double robust = 1.0 / (1.0 + residual * residual / (scale * scale));
    const double weight = params_.beam_weight * robust * robust / (beam.sigma_m * beam.sigma_m);
    equations.add({hit.normal.x(), hit.normal.y(), hit.normal.dot(left_of(arm))}, residual, weight);
  }
}

/// Each radial line and each point in sight that it may be, as far as that is likelier than chance.
void ScenePlausibility::pull_bearings(const Pose2& pose, NormalEquations& equations) const {
  const Vector2d arm = pose.rotation() * camera_;
  for (const double bearing : bearings_)
    for (const Sight& sight : sights_) {
      const double residual = geometry::angle_difference(sight.azimuth, bearing + pose.theta);
      const double sigmas = residual / sight.sigma;
      if (std::abs(sigmas) >= kBearingGate) continue;
      const double mapped = against_chance(sight, sigmas);
      const double responsibility = mapped / (1.0 - mapped_share() + mapped);
      const Vector2d aside = left_of(sight.way) / sight.way.squaredNorm();
      const double weight = params_.bearing_weight * responsibility / (sight.sigma * sight.sigma);
      equations.add({-aside.x(), -aside.y(), -aside.dot(left_of(arm)) - 1.0}, residual, weight);
    }
}

PoseEstimate ScenePlausibility::refine(const PoseEstimate& expected) {
  constexpr int kMost = 8;
  constexpr double kFinest_m = 0.06, kSmallestStep = 1e-3;
  const Matrix3d prior = expected.covariance.inverse();
  PoseEstimate refined = expected;
  bool sights_known = false;
  double scale_m =
      std::clamp(std::sqrt(expected.covariance(0, 0) + expected.covariance(1, 1)), kFinest_m, DistanceField::kReach_m);
  for (int i = 0; i < kMost; ++i) {
    const Pose2& pose = refined.pose;
    const Vector3d from_expected(pose.x - expected.pose.x, pose.y - expected.pose.y,
                                 geometry::angle_difference(pose.theta, expected.pose.theta));
    NormalEquations equations{prior, -prior * from_expected};
    pull_beams(pose, scale_m, equations);
    if (scale_m <= kFinest_m) {
      // What is in sight is listed once: it hardly changes on the last steps.
      sights_known ? aim_sights(pose) : list_sights(pose);
      sights_known = true;
      pull_bearings(pose, equations);
    }
    refined.covariance = equations.information.inverse();
    const Vector3d step = refined.covariance * equations.pull;
    refined.pose = {pose.x + step.x(), pose.y + step.y(), geometry::wrap_angle(pose.theta + step.z())};
    if (scale_m <= kFinest_m && step.norm() < kSmallestStep) break;
    scale_m = std::max(0.5 * scale_m, kFinest_m);
  }
  return refined;
}

}  // namespace credo::localization
