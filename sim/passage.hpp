// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sim/trajectory.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// How tall the robot is: as its highest sensor. [m]
[[nodiscard]] double height_of_robot(const World& world);

/// Where the way of a robot cannot be driven, and why.
struct Obstruction {
  std::size_t waypoint = 0;  ///< index into World::path: the one that cannot be reached, or not be stood on
  std::string what;          ///< found, and what to do
};

/// The first place, if any, at which the robot is outside of the building, or its body (a disc of
/// World::robot_radius_m, as tall as its highest sensor) touches a panel that is there by then.
[[nodiscard]] std::optional<Obstruction> find_obstruction(const World& world, const Trajectory& way);

}  // namespace credo::sim
