// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>

#include "geometry/floor_plan.hpp"
#include "sim/simulation.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// The floor plan as somebody drew it: the world's mapped panels and marks at `height_m`, every junction moved by its
/// own error of World::plan_uncertainty_m. Panels that share a junction still share it.
[[nodiscard]] geometry::FloorPlan draw_floor_plan(const World& world, double height_m, std::uint64_t seed);

/// Occupied where a panel crosses a cell at the height of a range finder or a sonar ring (without both, of the camera);
/// free where a waypoint of the robot can be connected to without crossing one; unknown elsewhere.
/// \param world  as it is at a moment (world_at); of what is not there then, only the extent of the map tells
[[nodiscard]] TruthMap draw_truth_map(const World& world, double resolution_m);

}  // namespace credo::sim
