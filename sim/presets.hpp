// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// Ready-made instruments by name; nothing is said of where they are mounted.
/// \throws std::invalid_argument  for an unknown name, with the nearest known one.
[[nodiscard]] CameraSetup camera_preset(const std::string& name);
[[nodiscard]] RangeFinderSetup range_finder_preset(const std::string& name);
[[nodiscard]] SonarSetup sonar_preset(const std::string& name);

/// What the robot is told of the calibration is how large its errors really are.
void state_accuracy(World& world);

}  // namespace credo::sim
