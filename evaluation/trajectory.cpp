// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace credo::evaluation {

StampedPose relative(const StampedPose& a, const StampedPose& b) {
  return {.time = b.time,
          .rotation = a.rotation.transpose() * b.rotation,
          .position = a.rotation.transpose() * (b.position - a.position)};
}

double rotation_angle(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d twice_sine{rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                                   rotation(1, 0) - rotation(0, 1)};
  return std::atan2(twice_sine.norm(), rotation.trace() - 1.0);
}

bool is_planar(const Trajectory& trajectory) {
  constexpr double kTolerance = 1e-9;
  return std::all_of(trajectory.poses.begin(), trajectory.poses.end(), [](const StampedPose& pose) {
    return std::abs(pose.position.z()) <= kTolerance && std::abs(pose.rotation(2, 2) - 1.0) <= kTolerance;
  });
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  datasets::SpatialTrajectory read = datasets::read_spatial_trajectory(path);
  return {.name = path.string(), .timed = read.has_times, .poses = std::move(read.poses)};
}

TrajectoryFacts facts(const Trajectory& trajectory) {
  TrajectoryFacts result{.poses = static_cast<int>(trajectory.poses.size())};
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i) {
    const StampedPose& before = trajectory.poses[i - 1];
    const StampedPose& after = trajectory.poses[i];
    result.length_m += (after.position - before.position).norm();
    result.times_going_back += after.time < before.time ? 1 : 0;
    result.equal_times += after.time == before.time ? 1 : 0;
    result.longest_gap_s = std::max(result.longest_gap_s, sensors::seconds_between(before.time, after.time));
  }
  if (!trajectory.poses.empty() && trajectory.timed) {
    const auto [first, last] =
        std::minmax_element(trajectory.poses.begin(), trajectory.poses.end(),
                            [](const StampedPose& a, const StampedPose& b) { return a.time < b.time; });
    result.duration_s = sensors::seconds_between(first->time, last->time);
  }
  return result;
}

}  // namespace credo::evaluation
