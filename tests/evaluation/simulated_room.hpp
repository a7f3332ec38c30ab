// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "localization/landmark_map.hpp"
#include "perception/observer.hpp"
#include "sim/random.hpp"

// A robot with a range finder and odometry that drives through a room.
namespace credo::evaluation::test {

using geometry::Pose2;
using geometry::PoseEstimate;

/// 6 m x 4 m with a recess, so that it looks different from everywhere.
inline geometry::FloorPlan room() {
  const std::vector<Eigen::Vector2d> p{{0, 0}, {6, 0}, {6, 4}, {3.5, 4}, {3.5, 4.8}, {2, 4.8}, {2, 4}, {0, 4}};
  geometry::FloorPlan plan;
  plan.uncertainty_m = 0.005;
  for (std::size_t i = 0; i < p.size(); ++i) plan.walls.push_back({p[i], p[(i + 1) % p.size()]});
  return plan;
}

inline sensors::Rig rig() {
  sensors::Rig result;
  sensors::RangeFinder& scanner = result.range_finders.emplace_back();
  scanner.angle_min_rad = -std::numbers::pi;
  scanner.count = 360;
  scanner.angle_increment_rad = 2.0 * std::numbers::pi / scanner.count;
  scanner.range_min_m = 0.1;
  scanner.range_max_m = 10.0;
  scanner.noise = {.sigma_0_m = 0.005, .k_per_m = 0.0};
  result.odometry = sensors::OdometryNoise{};
  return result;
}

inline PoseEstimate believed(const Pose2& pose, double sigma_m = 0.05, double sigma_rad = 0.035) {
  PoseEstimate estimate{pose, Eigen::Matrix3d::Zero()};
  estimate.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return estimate;
}

/// One moment of a drive.
struct Moment {
  perception::Scene scene;
  std::optional<PoseEstimate> motion;
  Pose2 truth;
};

/// Steps of 20 cm through the room; from `blind_from` on the scan is missing.
inline std::vector<Moment> drive(int steps, std::uint64_t seed, int blind_from = 1000) {
  const localization::LandmarkMap map(room());
  const sensors::Rig robot = rig();
  const sensors::RangeFinder& scanner = robot.range_finders.front();
  perception::Observer observer(robot);
  sim::Random random(seed);
  std::vector<Moment> moments;
  Pose2 truth{1.0, 1.5, 0.0};
  for (int k = 0; k < steps; ++k) {
    const Pose2 step = k == 0 ? Pose2{} : Pose2{0.2, 0.0, 0.06};
    truth = truth * step;
    sensors::Acquisition acquisition;
    acquisition.time = (k + 1) * 1'000'000'000LL;
    sensors::RangeScan scan{.time = acquisition.time, .sensor = 0, .ranges_m = {}};
    for (int i = 0; i < scanner.count; ++i) {
      const double angle = truth.theta + scanner.beam_angle(i);
      const double range = map.cast(truth.translation(), {std::cos(angle), std::sin(angle)}, 10.0);
      scan.ranges_m.push_back(static_cast<float>(range + random.normal(0.005)));
    }
    if (k < blind_from) acquisition.scan = scan;
    const double slip = random.normal(0.01), turn = random.normal(0.005);
    const Pose2 measured{step.x + (k > 0 ? slip : 0.0), 0.0, step.theta + (k > 0 ? turn : 0.0)};
    Moment& moment = moments.emplace_back();
    if (k > 0) moment.motion = robot.odometry->with_covariance(measured);
    moment.scene = observer.observe(acquisition);
    moment.truth = truth;
  }
  return moments;
}

inline double position_error(const Pose2& pose, const Pose2& truth) {
  return (pose.translation() - truth.translation()).norm();
}

}  // namespace credo::evaluation::test
