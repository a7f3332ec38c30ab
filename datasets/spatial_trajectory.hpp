// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/time.hpp"

namespace credo::datasets {

/// A spatial rigid transform at a time. Planar poses lie in z = 0 and turn about z.
struct StampedPose {
  sensors::Timestamp time = 0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
};

[[nodiscard]] StampedPose lift(sensors::Timestamp time, const geometry::Pose2& pose);
/// The part of a pose that lies in the plane: x, y and the heading of its x axis.
[[nodiscard]] geometry::Pose2 flatten(const StampedPose& pose);

/// How a trajectory was written.
enum class TrajectoryFormat {
  kTum,        ///< timestamp tx ty tz qx qy qz qw; seconds
  kKitti,      ///< 12 numbers, the first three rows of a transform; no time
  kEuroc,      ///< csv: ns, position, quaternion with w first
  kPoseTable,  ///< csv: ns, x, y, theta and perhaps more (groundtruth0/data.csv, localization.csv)
};

/// Poses in the order of the file, whose times may go back.
struct SpatialTrajectory {
  std::filesystem::path file;
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool has_times = true;           ///< false: KITTI, where the time is the index
  std::vector<StampedPose> poses;  ///< one at least
  std::vector<int> lines;          ///< of the file, one for each pose
};

/// Reads a file, whose format is told by the content, or what a folder holds: the ground truth of a dataset, the
/// localization.csv or the trajectory.tum of results.
/// \throws FormatError, with file and line: an unknown format, a bad row, a number that is not finite or beyond 1e6, a
///   quaternion or a matrix that is no rotation, or no pose at all
[[nodiscard]] SpatialTrajectory read_spatial_trajectory(const std::filesystem::path& path);

}  // namespace credo::datasets
