// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

#include "sim/world.hpp"

namespace credo::sim {

/// Moves what stands nearest to `at`, of all that the floor plan shows, and leaves the plan as it is: a piece of
/// furniture, a pillar, or one wall with what hangs on it. It is turned about its own middle and then shifted.
/// \param by  shift [m]
/// \throws std::invalid_argument  where nothing that the plan shows is within 0.5 m
void move_thing(World& world, const Eigen::Vector2d& at, const Eigen::Vector2d& by, double turn_rad);

}  // namespace credo::sim
