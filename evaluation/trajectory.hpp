// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/time.hpp"

namespace credo::evaluation {

/// A spatial rigid transform at a time. Planar poses lie in z = 0 and turn about z.
struct StampedPose {
  sensors::Timestamp time = 0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

[[nodiscard]] StampedPose lift(sensors::Timestamp time, const geometry::Pose2& pose);
/// The part of a pose that lies in the plane: x, y and the heading of its x axis.
[[nodiscard]] geometry::Pose2 flatten(const StampedPose& pose);

/// T_a^-1 T_b, at the time of b.
[[nodiscard]] StampedPose relative(const StampedPose& a, const StampedPose& b);

/// |log R|. [rad], in [0, pi]
[[nodiscard]] double rotation_angle(const Eigen::Matrix3d& rotation);

/// Poses over time, in the order of the file.
struct Trajectory {
  std::string name;  ///< where it comes from
  bool timed = true;  ///< false: the format has no times (KITTI); `time` is the index then
  std::vector<StampedPose> poses = {};
};

/// All poses lie in z = 0 and turn about z alone (tolerance 1e-9).
[[nodiscard]] bool is_planar(const Trajectory& trajectory);

/// Reads what the content says it is: a TUM file (8 columns), a KITTI file (12 columns), a EuRoC csv (time [ns], position,
/// quaternion with w first), a csv of planar poses (time [ns], x, y, theta, ...: a ground truth or a localization.csv), the
/// folder of a dataset (its ground truth) or the folder of a run (its localization.csv).
/// \throws std::runtime_error naming file:line, what was expected and what was found
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path);

/// What `credo evaluate traj` says about a trajectory.
struct TrajectoryFacts {
  int poses = 0;
  double length_m = 0.0;
  double duration_s = 0.0;
  int times_going_back = 0;      ///< rows whose time is before that of the row above
  int equal_times = 0;
  double longest_gap_s = 0.0;
};

[[nodiscard]] TrajectoryFacts facts(const Trajectory& trajectory);

}  // namespace credo::evaluation
