// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "datasets/dataset.hpp"
#include "sim/world.hpp"

namespace credo::evaluation {

/// A world played once and kept in memory: what `credo simulate` writes and `credo run` reads.
struct PlayedDrive {
  datasets::Dataset dataset;                       ///< its images are in the acquisitions
  std::vector<sensors::Acquisition> acquisitions;  ///< by time
};

/// Whatever the number of threads, the same world and seed give the same bytes.
/// \param progress  is told the share of the work that is done; may be empty
/// \throws std::invalid_argument  for a world that cannot be played
[[nodiscard]] PlayedDrive play(const sim::World& world, std::uint64_t seed,
                               const std::function<void(double)>& progress = {});

}  // namespace credo::evaluation
