// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// Moves what stands nearest to `at`, of all that the floor plan shows, and leaves the plan as it is: a piece of
/// furniture, a pillar, or one wall with what hangs on it. It is turned about its own middle and then shifted.
/// \param by  shift [m]
/// \throws std::invalid_argument  where nothing that the plan shows is within 0.5 m
void move_thing(World& world, const Eigen::Vector2d& at, const Eigen::Vector2d& by, double turn_rad);

// What happens during the drive, `when_s` from its start, in the order of time; each call adds to World::changes.

/// The panels from `first` on, those built last, are not there before.
void appear(World& world, double when_s, std::size_t first);
/// What stands nearest to `at` is taken away. \throws std::invalid_argument  where nothing that can be moved, at most
///   2.5 m large, stands within 0.5 m by then
void take_away(World& world, double when_s, const Eigen::Vector2d& at);
/// What stands nearest to `at` is turned about its own middle and shifted. \throws as take_away
void shift(World& world, double when_s, const Eigen::Vector2d& at, const Eigen::Vector2d& by, double turn_rad);
/// The leaf of the opening nearest to `at` is turned to an angle; 0 shuts it. \throws std::invalid_argument  where no
///   opening with a leaf is within 0.5 m
void turn_leaf(World& world, double when_s, const Eigen::Vector2d& at, double leaf_rad);

/// When the world begins to be as it is for a while: 0, and the times of its changes. Increasing.
[[nodiscard]] std::vector<double> state_times(const World& world);

/// The world as it is at a moment of the drive, for good. What is not there has no height: panels keep their places in
/// World::panels.
[[nodiscard]] World world_at(const World& world, double seconds);

}  // namespace credo::sim
