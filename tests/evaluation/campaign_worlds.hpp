// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <stdexcept>
#include <string>

#include "sim/building.hpp"
#include "sim/presets.hpp"
#include "sim/world.hpp"

namespace credo::tests {

/// One room, a range finder and odometry, 9 stops: quick to play.
inline sim::World small_world() {
  sim::World world;
  world.name = "small";
  world.materials = sim::common_materials();
  sim::Builder(world).add_walls({{0, 0}, {4, 0}, {4, 3}, {2.5, 3}, {2.5, 2.4}, {0, 2.4}}, true, "wall", true);
  world.path = {{{0.8, 0.8}, false}, {{3.2, 0.9}, false}};
  world.drive.step_m = 0.3;
  world.range_finders.push_back(sim::range_finder_preset("opensimple"));
  world.odometry.emplace();
  return world;
}

/// "small", and "broken", which cannot be made.
inline sim::World small_world_of(const std::string& name, std::uint64_t) {
  if (name == "broken") throw std::invalid_argument("no way\nthrough");
  return small_world();
}

}  // namespace credo::tests
