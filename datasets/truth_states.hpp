// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <vector>

#include "datasets/map_server.hpp"
#include "sensors/time.hpp"

namespace credo::datasets {

/// The true occupancy from a moment on, until the next one. For evaluation only.
struct TruthState {
  sensors::Timestamp since = 0;
  OccupancyMap map;
};

/// The states of a world that changed during the drive (`truth_maps/` of a dataset), by time; none where the folder is
/// not there: what truth_map.yaml says then held from the start.
/// \throws FormatError  for a table or a map that cannot be read, or maps that do not have the same cells
[[nodiscard]] std::vector<TruthState> read_truth_states(const std::filesystem::path& dataset);

/// \param dataset  the folder in which `truth_maps/` is made
/// \throws std::runtime_error if a file cannot be written; std::invalid_argument for a map that is none
void write_truth_states(const std::vector<TruthState>& states, const std::filesystem::path& dataset);

}  // namespace credo::datasets
