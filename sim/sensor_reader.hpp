// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "sim/world.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {

/// The `sensors` of a world file: each a preset and what is different from it.
/// \throws std::runtime_error  with file and line: for an unknown key or preset, or a value out of its range
void read_sensors(YamlMap sensors, World& world);

}  // namespace credo::sim
