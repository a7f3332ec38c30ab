// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "localization/localizer.hpp"
#include "perception/observer.hpp"

// A robot with a scanner and odometry that drives through a plan, and the pipeline that localizes it.
namespace credo::localization::test {

using Eigen::Vector2d;
using geometry::Pose2;
using geometry::PoseEstimate;

inline constexpr double kPi = 3.14159265358979323846;

/// A room of 6 m x 4 m with a recess, so that it looks different from everywhere.
inline geometry::FloorPlan room() {
  const std::vector<Vector2d> p{{0, 0}, {6, 0}, {6, 4}, {3.5, 4}, {3.5, 4.8}, {2, 4.8}, {2, 4}, {0, 4}};
  geometry::FloorPlan plan;
  plan.uncertainty_m = 0.005;
  for (std::size_t i = 0; i < p.size(); ++i) plan.walls.push_back({p[i], p[(i + 1) % p.size()]});
  return plan;
}

inline sensors::Rig rig() {
  sensors::Rig rig;
  sensors::RangeFinder& scanner = rig.range_finders.emplace_back();
  scanner.angle_min_rad = -kPi;
  scanner.count = 360;
  scanner.angle_increment_rad = 2.0 * kPi / scanner.count;
  scanner.range_min_m = 0.1;
  scanner.range_max_m = 10.0;
  scanner.noise = {.sigma_0_m = 0.005, .k_per_m = 0.0};
  rig.odometry = sensors::OdometryNoise{};
  return rig;
}

/// A drive through the room: acquisitions with scans and odometry, and the truth.
class Drive {
 public:
  /// \param noise_m  of the ranges; as the rig says it is
  explicit Drive(std::uint64_t seed, const geometry::FloorPlan& plan = room(), double noise_m = 0.005)
      : random_(seed), map_(plan), noise_m_(noise_m) {}

  sensors::Acquisition acquire(const Pose2& truth, const Pose2& step, bool blind = false) {
    sensors::Acquisition acquisition;
    acquisition.time = time_ += 1'000'000'000;
    const sensors::RangeFinder scanner = rig().range_finders.front();
    sensors::RangeScan scan;
    scan.time = acquisition.time;
    for (int i = 0; i < scanner.count; ++i) {
      const double angle = truth.theta + scanner.beam_angle(i);
      const double range = map_.cast(truth.translation(), {std::cos(angle), std::sin(angle)}, 10.0);
      scan.ranges_m.push_back(blind ? std::nanf("") : static_cast<float>(range + noise_m_ * normal_(random_)));
    }
    acquisition.scan = scan;
    const Pose2 measured{step.x * (1.0 + 0.02 * normal_(random_)), step.y, step.theta + 0.01 * normal_(random_)};
    acquisition.path = sensors::MotionPath({{time_ - 1'000'000'000, {}}, {time_, measured}});
    if (!first_) acquisition.motion = sensors::OdometryNoise{}.with_covariance(measured);
    first_ = false;
    return acquisition;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  LandmarkMap map_;
  double noise_m_;
  sensors::Timestamp time_ = 0;
  bool first_ = true;
};

inline PoseEstimate given(const Pose2& pose) {
  PoseEstimate estimate{pose, Eigen::Matrix3d::Zero()};
  estimate.covariance.diagonal() << 0.0025, 0.0025, 0.0012;
  return estimate;
}

inline double position_error(const Localization& fix, const Pose2& truth) {
  return std::hypot(fix.estimate.pose.x - truth.x, fix.estimate.pose.y - truth.y);
}

struct Pipeline {
  explicit Pipeline(const geometry::FloorPlan& plan, const std::optional<PoseEstimate>& initial,
                    perception::Method method = perception::Method::kDefault)
      : observer(rig(), observer_params(method)),
        localizer(plan, rig(), initial, LocalizerParams{}.with_method(method)) {}

  static perception::ObserverParams observer_params(perception::Method method) {
    perception::ObserverParams params;
    params.method = method;
    return params;
  }

  Localization operator()(sensors::Acquisition acquisition) {
    localizer.with_path(acquisition);
    return localizer.update(observer.observe(acquisition), acquisition.motion);
  }

  perception::Observer observer;
  Localizer localizer;
};

}  // namespace credo::localization::test
