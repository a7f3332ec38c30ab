// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

#include "apps/clerentin_experiment.hpp"

namespace credo::apps {

/// positions_paper.png and positions_default.png, beliefs.png, and where there is such a track edge_life.png and
/// wall_between.png; of the first random seed, the tracks' of the runs by the paper's method.
/// \param folder  is there
/// \throws std::runtime_error if a file cannot be written
void draw_pictures(const ClerentinExperiment& experiment, const std::filesystem::path& folder);

}  // namespace credo::apps
