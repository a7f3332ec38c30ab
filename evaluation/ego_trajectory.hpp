// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <functional>
#include <vector>

#include "datasets/dataset.hpp"

namespace credo::evaluation {

/// How walls are found in a scan: neighbouring points in segments, or perception::hough_lines (Li X. 2007, sec. 5.1).
enum class LineFinder { kSegments, kHough };

/// Where the robot has been by ego-motion: by its first range finder and odometry, where there are such, and from
/// the pose that the dataset begins with, or (0, 0, 0) where it tells none. One pose for each acquisition; images are
/// not read.
/// \param progress  called with the share done; what it throws ends the work
/// \throws std::runtime_error where the robot has neither
[[nodiscard]] std::vector<datasets::TimedPose> ego_trajectory(const datasets::Dataset& dataset,
                                                              LineFinder lines = LineFinder::kSegments,
                                                              const std::function<void(double share)>& progress = {});

}  // namespace credo::evaluation
