// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "datasets/dataset.hpp"
#include "sim/simulation.hpp"

namespace credo::apps {

/// The file of a world. \param name  a file, or the name of a world that comes with Credo
/// \throws std::runtime_error  with the names of those that do
[[nodiscard]] std::filesystem::path find_world(const std::string& name);

/// What the dataset of a simulation says of itself and of the robot.
[[nodiscard]] datasets::DatasetHeader header_of(const sim::Simulation& simulation);

/// Plays a world into a dataset folder. \throws std::runtime_error if the folder may not be written
void simulate_into(const sim::World& world, std::uint64_t seed, const std::filesystem::path& out, bool force);

}  // namespace credo::apps
