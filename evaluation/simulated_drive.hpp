// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <functional>

#include "datasets/dataset.hpp"
#include "datasets/map_server.hpp"
#include "datasets/truth_states.hpp"
#include "sensors/acquisition.hpp"
#include "sim/simulation.hpp"

// A simulated drive that never is on disk, as the recording that it would be.
namespace credo::evaluation {

/// What a dataset of the simulation says of itself.
[[nodiscard]] datasets::DatasetHeader header_of(const sim::Simulation& simulation);

/// All readings but the images, with truth and events: the dataset that the simulation would be written into, without
/// the rounding of its files, and with no image.
[[nodiscard]] datasets::Dataset readings_of(const sim::Simulation& simulation);

/// Where the walls of a simulated building are.
[[nodiscard]] datasets::OccupancyMap true_map_of(const sim::Simulation& simulation);
/// The same from each change of the world on, by time.
[[nodiscard]] std::vector<datasets::TruthState> true_states_of(const sim::Simulation& simulation);

struct PlayParams {
  int threads = 1;                            ///< for rendering images
  std::function<void(double)> progress = {};  ///< is told the share of the work done; may be empty
};

/// Renders the images and hands out acquisition after acquisition, in the order of time, from this thread. At most a
/// batch of images is held at once.
/// \param readings  of the same simulation: readings_of
void for_each_acquisition(const sim::Simulation& simulation, const datasets::Dataset& readings,
                          const std::function<void(sensors::Acquisition)>& take, const PlayParams& params = {});

}  // namespace credo::evaluation
