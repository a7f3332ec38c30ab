// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/world.hpp"

namespace credo::apps {

/// Plays a world into a dataset folder. \throws std::runtime_error if the folder may not be written
void simulate_into(const sim::World& world, std::uint64_t seed, const std::filesystem::path& out, bool force);

}  // namespace credo::apps
