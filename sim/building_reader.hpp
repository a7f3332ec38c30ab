// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "sim/building.hpp"
#include "sim/world.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {

/// The `building` of a world file: light, materials, and everything that stands in it or hangs on its walls; then what
/// is moved after the plan was drawn.
/// \throws std::runtime_error  with file and line: for an unknown key, a value out of its range, what finds no wall, a
///   building without walls or larger than 500 m
void read_building(YamlMap building, World& world);

/// One of the `boxes` of a building, put there by `builder`. \throws as read_building
void read_box(YamlMap& map, const World& world, Builder& builder);

}  // namespace credo::sim
