// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/scan_agreement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using sensors::ScanPoint;

/// Every how many points one is taken, so that at most `most` are.
std::size_t stride(std::size_t points, int most) {
  return std::max<std::size_t>(1, (points + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most));
}

}  // namespace

std::optional<double> ScanAgreement::share(const ScanAgreementParams& params) const {
  const double weight = on_plan + behind + params.before_weight * before;
  if (on_plan + before + behind < params.least_points || !(weight > 0.0)) return {};
  return on_plan / weight;
}

ScanMatcher::ScanMatcher(const LandmarkMap& map, const ScanAgreementParams& params)
    : map_(&map), params_(params), field_(map.surfaces()) {
  const auto most = static_cast<std::size_t>(std::max(0, params.most_points));
  chosen_.reserve(most);
  turned_.reserve(most);
}

ScanAgreement ScanMatcher::compare(std::span<const ScanPoint> points, const Pose2& T_map_base) const {
  ScanAgreement agreement;
  if (field_.resolution_m() > params_.on_plan_m) return agreement;  // the cells of an enormous plan cannot tell
  const Eigen::Matrix2d R = T_map_base.rotation();
  for (std::size_t i = 0; i < points.size(); i += stride(points.size(), params_.most_points)) {
    const ScanPoint& point = points[i];
    const Vector2d in_map = T_map_base.translation() + R * point.position;
    const double tolerance = std::hypot(params_.on_plan_m, params_.on_plan_sigmas * point.sigma_m);
    const Vector2d sensor = in_map - point.range_m * (R * point.ray);
    if (field_(in_map) <= tolerance)
      ++agreement.on_plan;
    else if (map_->sees(sensor, in_map, tolerance))
      ++agreement.before;
    else
      ++agreement.behind;
  }
  return agreement;
}

/// Mean nearness of the chosen points to walls, 0 .. 1, from a pose whose turn `turned_` has already.
double ScanMatcher::fit(const Pose2& pose) const {
  double sum = 0.0;
  for (const Vector2d& point : turned_) sum += DistanceField::kReach_m - field_(pose.translation() + point);
  return sum / (DistanceField::kReach_m * static_cast<double>(turned_.size()));
}

Pose2 ScanMatcher::search(std::span<const ScanPoint> points, const geometry::PoseEstimate& expected) {
  chosen_.clear();
  for (std::size_t i = 0; i < points.size(); i += stride(points.size(), params_.most_points))
    chosen_.push_back(points[i].position);
  if (chosen_.empty()) return expected.pose;
  const Eigen::Matrix3d information = expected.covariance.inverse();
  Pose2 best = expected.pose;
  double highest = -std::numeric_limits<double>::infinity();
  // All poses so many steps to either side of a centre.
  const auto look_around = [&](const Pose2& centre, int steps_x, int steps_y, int steps_turn, double step_m,
                               double step_rad, std::size_t every) {
    for (int k = -steps_turn; k <= steps_turn; ++k) {
      const double theta = geometry::wrap_angle(centre.theta + k * step_rad);
      const Eigen::Matrix2d R = Pose2{0.0, 0.0, theta}.rotation();
      turned_.clear();
      for (std::size_t i = 0; i < chosen_.size(); i += every) turned_.push_back(R * chosen_[i]);
      for (int i = -steps_x; i <= steps_x; ++i)
        for (int j = -steps_y; j <= steps_y; ++j) {
          const Pose2 pose{centre.x + i * step_m, centre.y + j * step_m, theta};
          const Vector3d step(pose.x - expected.pose.x, pose.y - expected.pose.y,
                              geometry::wrap_angle(theta - expected.pose.theta));
          const double score = fit(pose) - params_.prior_weight * step.dot(information * step);
          if (!(score > highest)) continue;
          highest = score;
          best = pose;
        }
    }
  };
  const auto steps = [&](int axis, double at_most, double step) {
    const double sigma = std::sqrt(std::max(0.0, expected.covariance(axis, axis)));
    return static_cast<int>(std::ceil(std::min(params_.search_sigmas * sigma, at_most) / step));
  };
  look_around(expected.pose, steps(0, params_.search_at_most_m, params_.search_step_m),
              steps(1, params_.search_at_most_m, params_.search_step_m),
              steps(2, params_.search_at_most_rad, params_.search_step_rad), params_.search_step_m,
              params_.search_step_rad, 2);
  highest = -std::numeric_limits<double>::infinity();
  for (const double finer : {0.5, 0.25, 0.125})
    look_around(Pose2(best), 1, 1, 1, finer * params_.search_step_m, finer * params_.search_step_rad, 1);
  return best;
}

}  // namespace credo::localization
