// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "datasets/map_server.hpp"
#include "grids/mass_map.hpp"
#include "results/belief_tiff.hpp"

// A map of any rule as the files that a map has.
namespace credo::results {

/// What each cell is called, as grids::decide: pignistic probabilities, the conflict divided out; a cell whose conflict
/// is total is unknown. An empty map gives one unknown cell.
[[nodiscard]] datasets::OccupancyMap to_occupancy(const grids::MassMap& map, const grids::DecisionParams& params = {});

/// The same as percent of the pignistic probability of "occupied"; -1 where it is not known.
[[nodiscard]] datasets::OccupancyMap to_probabilities(const grids::MassMap& map,
                                                      const grids::DecisionParams& params = {});

/// The four masses as they are: of empty, occupied, conflict, unknown. An empty map gives one vacuous pixel.
[[nodiscard]] BeliefImage belief_image(const grids::MassMap& map);

}  // namespace credo::results
