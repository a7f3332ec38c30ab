// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_experiment.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "datasets/time_order.hpp"
#include "evaluation/ego_trajectory.hpp"
#include "evaluation/simulated_drive.hpp"

namespace credo::evaluation {
namespace {

template <typename Reading>
void keep_until(std::vector<Reading>& readings, sensors::Timestamp end) {
  std::erase_if(readings, [&](const Reading& reading) { return reading.time >= end; });
}

sensors::MotionPath path_of(std::span<const datasets::TimedPose> poses) {
  std::vector<sensors::OdometryReading> rows;
  for (const datasets::TimedPose& row : poses) rows.push_back({row.time, row.pose});
  return sensors::MotionPath(std::move(rows));
}

/// What was read, along given poses.
MapDrive drive_along(sensors::MotionPath T_map_base, datasets::Dataset&& readings, datasets::OccupancyMap truth) {
  return {.T_map_base = std::move(T_map_base),
          .rig = readings.header.rig,
          .scans = datasets::in_time_order(std::move(readings.scans)),
          .sweeps = datasets::in_time_order(std::move(readings.sonar)),
          .truth = std::move(truth)};
}

}  // namespace

MapDrive play_for_mapping(const sim::World& world, std::uint64_t seed) {
  const sim::Simulation simulation(world, seed);
  datasets::Dataset readings = readings_of(simulation);
  sensors::MotionPath path = path_of(readings.truth);
  return drive_along(std::move(path), std::move(readings), true_map_of(simulation));
}

EgoMotionDrive play_with_ego_motion(const sim::World& world, std::uint64_t seed) {
  const sim::Simulation simulation(world, seed);
  datasets::Dataset readings = readings_of(simulation);
  const sensors::MotionPath truth = path_of(readings.truth);
  const std::vector<datasets::TimedPose> poses = ego_trajectory(readings);
  EgoMotionDrive result;
  for (const datasets::TimedPose& row : poses) {
    result.last_error_m = (row.pose.translation() - truth.pose_at(row.time).translation()).norm();
    result.mean_error_m += result.last_error_m / static_cast<double>(poses.size());
  }
  result.drive = drive_along(path_of(poses), std::move(readings), true_map_of(simulation));
  return result;
}

mapping::TrajectoryMappingParams as_in_papers(const mapping::SonarParams& sonar) {
  mapping::TrajectoryMappingParams params;
  params.mapper.sonar = sonar;
  params.mapper.freshness.correlation = 0.0;
  return params;
}

MapDrive first_part(const MapDrive& drive, double seconds) {
  MapDrive part = drive;
  sensors::Timestamp first = std::numeric_limits<sensors::Timestamp>::max();
  if (!drive.scans.empty()) first = std::min(first, drive.scans.front().time);
  if (!drive.sweeps.empty()) first = std::min(first, drive.sweeps.front().time);
  if (drive.scans.empty() && drive.sweeps.empty()) return part;
  const sensors::Timestamp end = first + sensors::from_seconds(seconds);
  keep_until(part.scans, end);
  keep_until(part.sweeps, end);
  return part;
}

mapping::RuleMap map_by(const MapMethod& method, const MapDrive& drive) {
  return mapping::map_along(drive.T_map_base, drive.rig, drive.scans, drive.sweeps, method.params, method.rule);
}

grids::MassMap decided_by_belief(const grids::MassMap& map) {
  grids::MassMap decided = map;
  for (evidence::GridMass& mass : decided.masses) {
    const bool occupied = evidence::belief(mass, evidence::GridElement::kOccupied, evidence::GridModel::kFree) > 0.5;
    mass = {.empty = occupied ? 0.0 : 1.0, .occupied = occupied ? 1.0 : 0.0, .conflict = 0.0, .unknown = 0.0};
  }
  return decided;
}

grids::MassMap decided_by_zhu(const grids::MassMap& map, const mapping::ZhuDecisionParams& params) {
  grids::MassMap decided = map;
  for (evidence::GridMass& mass : decided.masses) {
    const mapping::ZhuState state = decide_zhu(mass, params);
    const bool empty = state == mapping::ZhuState::kEmpty, occupied = state == mapping::ZhuState::kOccupied;
    mass = {.empty = empty ? 1.0 : 0.0,
            .occupied = occupied ? 1.0 : 0.0,
            .conflict = 0.0,
            .unknown = empty || occupied ? 0.0 : 1.0};
  }
  return decided;
}

DecidedDifferently decided_differently(const grids::MassMap& a, const grids::MassMap& b) {
  if (a.box != b.box) throw std::invalid_argument("maps of different rectangles cannot be compared cell by cell");
  const auto sign = [](const evidence::GridMass& mass) {
    return (mass.occupied > mass.empty) - (mass.occupied < mass.empty);
  };
  const auto underflown = [](const evidence::GridMass& mass) {
    return std::max(mass.empty, mass.occupied) < std::numeric_limits<double>::min() && mass.unknown < 1.0;
  };
  DecidedDifferently different;
  for (std::size_t i = 0; i < a.masses.size(); ++i) {
    if (sign(a.masses[i]) == sign(b.masses[i])) continue;
    ++different.cells;
    different.underflown += underflown(a.masses[i]) || underflown(b.masses[i]);
  }
  return different;
}

}  // namespace credo::evaluation
