// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/pose.hpp"
#include "sim/world.hpp"

namespace credo::sim {

struct DecidableParams {
  double elsewhere_m = 0.5;     ///< poses nearer than this and ...
  double elsewhere_deg = 20.0;  ///< ... turned by less than this are the same place
  double sigmas = 5.0;          ///< by which readings must differ
  /// What one beam can add to that: readings have outliers, so that no single beam decides.
  double most_of_a_beam = 3.0;
};

/// Whether the first range finder alone can tell this pose from every other one that the robot can reach: noise-free
/// readings there differ by more than 5 sigma, the root of the sum over the beams of squared differences in expected
/// standard deviations, those of the range finder and of the floor plan taken together. The readings are of the world
/// as it is, without people. Every place is tried at 0.2 m and 5 degrees; the most similar ones are then refined.
/// \param world      with its clutter: Simulation::world()
/// \param T_map_base a pose in the free space that the robot's way is in
/// \throws std::invalid_argument  for a world without a range finder
[[nodiscard]] bool decidable(const World& world, const geometry::Pose2& T_map_base, const DecidableParams& params = {});

}  // namespace credo::sim
