// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/omni_renderer.hpp"
#include "sim/range_simulator.hpp"
#include "sim/sonar_simulator.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// The robot's instruments in the world as it is between two changes. Their errors are those of the seed, the same in
/// every state of the world.
struct Instruments {
  /// \param now  the world at a moment (world_at)
  Instruments(World now, std::uint64_t seed);
  Instruments(const Instruments&) = delete;  // they refer to the world
  Instruments& operator=(const Instruments&) = delete;

  const World world;
  std::optional<OmniRenderer> renderer;
  std::vector<RangeSimulator> ranges;
  std::vector<SonarSimulator> sonars;
};

/// The instruments by the time of what they look at.
class InstrumentsOverTime {
 public:
  InstrumentsOverTime(const World& world, std::uint64_t seed);
  /// \param seconds  from the start, not negative
  [[nodiscard]] const Instruments& at(double seconds) const;

 private:
  std::vector<double> begin_s_;
  std::vector<std::unique_ptr<const Instruments>> instruments_;
};

}  // namespace credo::sim
