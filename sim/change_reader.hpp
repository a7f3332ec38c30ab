// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "sim/world.hpp"
#include "sim/yaml_map.hpp"

namespace credo::sim {

/// The `changes` of a world file, in a building that is complete: what is put somewhere, taken away, moved, opened or
/// shut during the drive.
/// \throws std::runtime_error  with file and line: for an unknown key, a value out of its range, a change before the
///   one above it, or one of what is not there by then
void read_changes(std::vector<YamlMap> changes, World& world);

}  // namespace credo::sim
