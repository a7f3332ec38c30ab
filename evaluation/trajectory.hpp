// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/spatial_trajectory.hpp"

namespace credo::evaluation {

using datasets::flatten;
using datasets::lift;
using datasets::StampedPose;

/// T_a^-1 T_b, at the time of b.
[[nodiscard]] StampedPose relative(const StampedPose& a, const StampedPose& b);

/// |log R|. [rad], in [0, pi]
[[nodiscard]] double rotation_angle(const Eigen::Matrix3d& rotation);

/// Poses over time, in the order of the file.
struct Trajectory {
  std::string name;   ///< where it comes from
  bool timed = true;  ///< false: the format has no times (KITTI); `time` is the index then
  std::vector<StampedPose> poses = {};
};

/// All poses lie in z = 0 and turn about z alone (tolerance 1e-9).
[[nodiscard]] bool is_planar(const Trajectory& trajectory);

/// datasets::read_spatial_trajectory(), named after its path.
/// \throws datasets::FormatError naming file:line, what was expected and what was found
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path);

/// What `credo evaluate traj` says about a trajectory.
struct TrajectoryFacts {
  int poses = 0;
  double length_m = 0.0;
  double duration_s = 0.0;
  int times_going_back = 0;  ///< rows whose time is before that of the row above
  int equal_times = 0;
  double longest_gap_s = 0.0;
};

[[nodiscard]] TrajectoryFacts facts(const Trajectory& trajectory);

}  // namespace credo::evaluation
