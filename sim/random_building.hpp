// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/building.hpp"
#include "sim/random.hpp"
#include "sim/random_world.hpp"

namespace credo::sim {

/// What a room is for says how it is furnished.
enum class RoomUse { kCorridor, kOffice, kHall };

struct Room {
  std::vector<Eigen::Vector2d> outline;  ///< counter-clockwise
  RoomUse use = RoomUse::kOffice;
  std::vector<std::size_t> outer;  ///< walls, by their first corner, that have the street behind them: for windows
};

/// Rooms and doors, before anything stands in them. The first room is the one that the others are entered from.
struct Layout {
  std::vector<Room> rooms;
  std::vector<Door> doors;
};
[[nodiscard]] Layout draw_layout(BuildingKind kind, Random& random);

/// Builds it and furnishes it. The rooms of modules are all furnished alike, and a symmetric room in pairs of things.
/// \throws std::invalid_argument  where a door does not fit into its wall
void build(const Layout& layout, BuildingKind kind, Random& random, World& world);

}  // namespace credo::sim
