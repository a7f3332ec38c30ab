// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <string>

#include "sim/world.hpp"

// The worlds that a campaign names: a file, a world that comes with credo, random, or random:KIND.
namespace credo::apps {

/// Whether it is drawn from the seed of its run, and no file.
[[nodiscard]] bool is_drawn(const std::string& world);

/// Empty where there is such a world.
/// \returns what was found, the nearest name, and all that are known
[[nodiscard]] std::string complaint_about_world(const std::string& world);

/// Precondition: nobody complains about it. \throws as load_world and random_world
[[nodiscard]] sim::World campaign_world(const std::string& world, std::uint64_t seed);

}  // namespace credo::apps
