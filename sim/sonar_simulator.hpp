// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sensors/acquisition.hpp"
#include "sim/crowd.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// A sonar ring: walls answer only when met nearly head-on, corners always, edges when near; what leaves a wall at a
/// slant may come back by a detour and be read too long (Kuc and Siegel 1987; Wilkes et al. 1990).
class SonarSimulator {
 public:
  /// \param world, setup  are kept by reference
  SonarSimulator(const World& world, const SonarSetup& setup, int sensor, std::uint64_t seed);

  /// \param T_map_base  the true pose at a number of seconds from the sweep's timestamp
  /// \param index       of the sweep: selects its noise
  /// \param people      who stands where at such a time, cut at the height of the ring; nobody where it is empty
  [[nodiscard]] sensors::SonarSweep sweep(sensors::Timestamp time,
                                          const std::function<geometry::Pose2(double)>& T_map_base, std::uint64_t index,
                                          const std::function<std::vector<Disc>(double)>& people = {}) const;

  /// The distance of the first echo that is loud enough, without noise; infinite without one.
  [[nodiscard]] double first_echo(const geometry::Pose2& T_map_transducer, std::span<const Disc> people = {}) const;

 private:
  /// Where two panels meet: seen from inside of the angle below 180 degrees a corner, from outside an edge.
  struct Junction {
    Eigen::Vector2d at, along_a, along_b;
  };
  void find_junctions();
  void listen_to_walls(const geometry::Pose2& T_map_transducer, double& nearest) const;
  void listen_to_junctions(const geometry::Pose2& T_map_transducer, double& nearest) const;
  void listen_to_people(const geometry::Pose2& T_map_transducer, std::span<const Disc> people, double& nearest) const;
  [[nodiscard]] bool is_loud(double range_m, double off_axis_rad, double strength) const;

  const World* world_;
  const SonarSetup* setup_;
  RayCaster caster_;
  std::uint64_t seed_;
  int sensor_;
  std::vector<double> ray_angles_;
  std::vector<Junction> junctions_;
};

}  // namespace credo::sim
