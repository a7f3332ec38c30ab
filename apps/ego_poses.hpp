// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "datasets/dataset.hpp"
#include "evaluation/ego_trajectory.hpp"

namespace credo::apps {

/// evaluation::ego_trajectory with a progress bar, which an interrupt ends.
[[nodiscard]] std::vector<datasets::TimedPose> ego_poses(
    const datasets::Dataset& dataset, evaluation::LineFinder lines = evaluation::LineFinder::kSegments);

}  // namespace credo::apps
