// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/played_drive.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include "evaluation/simulated_drive.hpp"

namespace credo::evaluation {

PlayedDrive play(const sim::World& world, std::uint64_t seed, const std::function<void(double)>& progress) {
  const sim::Simulation simulation(world, seed);
  PlayedDrive drive{readings_of(simulation), {}};
  for_each_acquisition(
      simulation, drive.dataset,
      [&](sensors::Acquisition acquisition) { drive.acquisitions.push_back(std::move(acquisition)); },
      {.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency())), .progress = progress});
  return drive;
}

}  // namespace credo::evaluation
