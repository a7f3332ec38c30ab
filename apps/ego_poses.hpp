// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "datasets/dataset.hpp"

namespace credo::apps {

/// Where the robot has been by ego-motion: by its first range finder and odometry, where there are such, and from
/// the pose that the dataset begins with, or (0, 0, 0) where it tells none. One pose for each acquisition; images are
/// not read. \throws std::runtime_error  where the robot has neither
[[nodiscard]] std::vector<datasets::TimedPose> ego_poses(const datasets::Dataset& dataset);

}  // namespace credo::apps
