// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_icp.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace credo::evaluation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;
using geometry::PoseEstimate;

/// The wall nearest to a point, or nothing within reach.
const geometry::Segment* nearest_wall(const Vector2d& point, const std::vector<geometry::Segment>& walls,
                                      double reach_m) {
  const geometry::Segment* nearest = nullptr;
  double least = reach_m;
  for (const geometry::Segment& wall : walls) {
    const double apart = geometry::distance(point, wall);
    if (apart > least) continue;
    least = apart;
    nearest = &wall;
  }
  return nearest;
}

/// Normal equations of one iteration, and how many points lie on the plan.
struct Normal {
  Matrix3d information;
  Vector3d gradient;
  int inliers = 0;
};

Normal linearise(const perception::Scene& scene, const Pose2& pose, const std::vector<geometry::Segment>& walls,
                 double plan_variance, const IcpParams& params) {
  Normal sum{Matrix3d::Zero(), Vector3d::Zero()};
  const Eigen::Matrix2d R = pose.rotation();
  for (const sensors::ScanPoint& point : scene.points) {
    const Vector2d from_base = R * point.position;
    const geometry::Segment* const wall = nearest_wall(pose.translation() + from_base, walls, params.reach_m);
    if (wall == nullptr) continue;
    const Vector2d normal = wall->normal();
    const double off = normal.dot(pose.translation() + from_base - wall->a);
    const double across = normal.dot(R * point.ray) * point.sigma_m;
    const double variance = across * across + plan_variance;
    const double scaled = off / params.robust_sigmas;
    const double weight = 1.0 / (variance + scaled * scaled);  // Cauchy's, over the variance
    const Vector3d by_pose(normal.x(), normal.y(), geometry::cross(from_base, normal));
    sum.information += weight * by_pose * by_pose.transpose();
    sum.gradient -= weight * off * by_pose;
    sum.inliers += std::abs(off) < params.inlier_m ? 1 : 0;
  }
  return sum;
}

Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x - b.x, a.y - b.y, geometry::angle_difference(a.theta, b.theta)};
}

}  // namespace

IcpLocalizer::IcpLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const PoseEstimate& initial,
                           const IcpParams& params)
    : params_(params), walls_(plan.walls), motion_(initial) {
  constexpr double kSmallest_m = 0.002;  // skirting, wallpaper: the floor of Credo's walls
  plan_variance_ = plan.uncertainty_m * plan.uncertainty_m + kSmallest_m * kSmallest_m;
  if (!rig.range_finders.empty()) {
    const sensors::CalibrationAccuracy& a = rig.range_finders.front().accuracy;
    mounting_.diagonal() << a.x_m * a.x_m, a.y_m * a.y_m, a.theta_rad * a.theta_rad;
  }
}

localization::Localization IcpLocalizer::update(const perception::Scene& scene,
                                                const std::optional<PoseEstimate>& motion) {
  return update_from(motion_.predict(motion, scene.time), scene);
}

localization::Localization IcpLocalizer::update_from(const PoseEstimate& start, const perception::Scene& scene) {
  const Matrix3d prior = start.covariance.inverse();
  Pose2 pose = start.pose;
  Normal sum = linearise(scene, pose, walls_, plan_variance_, params_);
  for (int iteration = 0; iteration < params_.iterations; ++iteration) {
    const Vector3d gradient = sum.gradient - prior * difference(pose, start.pose);
    const Vector3d step = (sum.information + prior).ldlt().solve(gradient);
    pose = {pose.x + step.x(), pose.y + step.y(), geometry::wrap_angle(pose.theta + step.z())};
    sum = linearise(scene, pose, walls_, plan_variance_, params_);
    if (step.head<2>().norm() < params_.converged_m && std::abs(step.z()) < params_.converged_rad) break;
  }
  Matrix3d turn = Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = pose.rotation();
  const Matrix3d of_scan = scene.points.empty() ? Matrix3d::Zero().eval() : (mounting_ + scene.carry_covariance).eval();
  const PoseEstimate estimate{pose, (sum.information + prior).inverse() + turn * of_scan * turn.transpose()};
  motion_.correct(estimate, scene.time);
  const int points = static_cast<int>(scene.points.size());
  localization::Localization fix = baseline_fix(scene.time, estimate, points > 0 ? 1.0 * sum.inliers / points : 0.0);
  fix.detected = points;
  fix.matched = sum.inliers;
  return fix;
}

}  // namespace credo::evaluation
