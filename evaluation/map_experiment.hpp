// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "datasets/map_server.hpp"
#include "evaluation/map_score.hpp"
#include "mapping/map_rule.hpp"
#include "sim/world.hpp"

// What the experiments of the four mapping papers are made of: drives whose truth is known, and maps of them.
namespace credo::evaluation {

/// The readings of a robot, the poses that it took them from, and the truth.
struct MapDrive {
  sensors::MotionPath T_map_base;
  sensors::Rig rig;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
  datasets::OccupancyMap truth;
};

/// Plays a world with its true poses.
[[nodiscard]] MapDrive play_for_mapping(const sim::World& world, std::uint64_t seed);

/// A drive with the poses of its ego-motion, and how far these are from the true ones.
struct EgoMotionDrive {
  MapDrive drive;
  double mean_error_m = 0.0;
  double last_error_m = 0.0;
};
/// Plays a world; its poses are those of ego_trajectory(), from the start that the world tells.
[[nodiscard]] EgoMotionDrive play_with_ego_motion(const sim::World& world, std::uint64_t seed);

/// Parameters by which every reading counts in full: the papers know of no errors that readings repeat.
[[nodiscard]] mapping::TrajectoryMappingParams as_in_papers(const mapping::SonarParams& sonar);
/// The readings up to a time after the first one. [s]
[[nodiscard]] MapDrive first_part(const MapDrive& drive, double seconds);

/// A sensor model with a rule.
struct MapMethod {
  std::string name;
  mapping::TrajectoryMappingParams params;
  mapping::MapRule rule;
};

[[nodiscard]] mapping::RuleMap map_by(const MapMethod& method, const MapDrive& drive);

/// Li X. 2007, step 6, to the letter: occupied is what is believed to be occupied by more than a half, its conflict
/// included (eq. (2)), empty the rest.
[[nodiscard]] grids::MassMap decided_by_belief(const grids::MassMap& map);

/// Zhu, eq. (10): occupied, empty, or undecided.
[[nodiscard]] grids::MassMap decided_by_zhu(const grids::MassMap& map, const mapping::ZhuDecisionParams& params = {});

struct DecidedDifferently {
  std::int64_t cells = 0;
  std::int64_t underflown = 0;  ///< of them, where a map's m(empty) and m(occupied) are both below what a double holds
                                ///< in full: a product of many readings that was never normalised
};

/// Cells that two maps of one place decide differently. \throws std::invalid_argument if their boxes differ
[[nodiscard]] DecidedDifferently decided_differently(const grids::MassMap& a, const grids::MassMap& b);

}  // namespace credo::evaluation
