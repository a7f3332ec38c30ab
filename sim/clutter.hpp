// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>

#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// The world with unmapped things in it, until they hide World::clutter_share of the length of the mapped walls at the
/// height of the robot's first range finder: cupboards, boxes and shelves along the walls, and, one in four, chairs and
/// crates that stand free, which count by their width. They leave the robot's way clear; where there is
/// no room for so many, fewer are placed. The share of what is returned is 0: all is there.
[[nodiscard]] World with_clutter(World world, const Trajectory& way, std::uint64_t seed);

}  // namespace credo::sim
