// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "datasets/dataset.hpp"

namespace credo::apps {

/// How walls are found in a scan: neighbouring points in segments, or perception::hough_lines.
enum class LineFinder { kSegments, kHough };

/// Where the robot has been by ego-motion: by its first range finder and odometry, where there are such, and in the
/// frame of the first acquisition. One pose for each acquisition; images are not read.
/// \throws std::runtime_error  where the robot has neither
[[nodiscard]] std::vector<datasets::TimedPose> ego_poses(const datasets::Dataset& dataset,
                                                         LineFinder lines = LineFinder::kSegments);

}  // namespace credo::apps
