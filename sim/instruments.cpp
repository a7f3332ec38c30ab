// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/instruments.hpp"

#include <algorithm>
#include <utility>

#include "sim/rearrangement.hpp"

namespace credo::sim {

Instruments::Instruments(World now, std::uint64_t seed) : world(std::move(now)) {
  if (world.camera) renderer.emplace(world, seed);
  for (std::size_t i = 0; i < world.range_finders.size(); ++i)
    ranges.emplace_back(world, world.range_finders[i], static_cast<int>(i), seed);
  for (std::size_t i = 0; i < world.sonars.size(); ++i)
    sonars.emplace_back(world, world.sonars[i], static_cast<int>(i), seed);
}

InstrumentsOverTime::InstrumentsOverTime(const World& world, std::uint64_t seed) : begin_s_(state_times(world)) {
  for (const double seconds : begin_s_)
    instruments_.push_back(std::make_unique<const Instruments>(world_at(world, seconds), seed));
}

const Instruments& InstrumentsOverTime::at(double seconds) const {
  const auto after = std::upper_bound(begin_s_.begin() + 1, begin_s_.end(), seconds);
  return *instruments_[static_cast<std::size_t>(after - begin_s_.begin()) - 1];
}

}  // namespace credo::sim
