// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datasets/dataset.hpp"

namespace credo::apps {

/// Poses that a person sets during a drive, as `credo run --pose-at` takes them: each is given to the acquisition at
/// its time or to the next one after it, carried there by odometry.
class PosesByHand {
 public:
  /// \param times  of the acquisitions
  /// \param poses  T_map_base, in any order; each is known as well as the dataset's initial pose
  /// \throws std::runtime_error  for a time before the first acquisition or after the last one
  PosesByHand(const datasets::Dataset& dataset, const std::vector<sensors::Timestamp>& times,
              std::vector<datasets::TimedPose> poses);

  /// The latest pose that was set since the acquisition before, at the time of this one.
  [[nodiscard]] std::optional<geometry::PoseEstimate> next(const sensors::Acquisition& acquisition);

 private:
  std::vector<datasets::TimedPose> poses_;  ///< by time
  Eigen::Matrix3d covariance_;
  sensors::OdometryNoise noise_;
  std::size_t done_ = 0;
};

}  // namespace credo::apps
