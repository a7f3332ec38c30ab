// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/simulated_drive.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "datasets/acquisitions.hpp"

namespace credo::evaluation {
namespace {

std::vector<std::string> numbered(const char* kind, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(kind + std::to_string(i));
  return names;
}

datasets::OccupancyMap occupancy_of(const sim::TruthMap& truth) {
  using Cell = sim::TruthMap::Cell;
  using datasets::OccupancyMap;
  OccupancyMap map{.width = truth.width,
                   .height = truth.height,
                   .resolution_m = truth.resolution_m,
                   .origin_x_m = truth.origin.x(),
                   .origin_y_m = truth.origin.y(),
                   .cells = {}};
  map.cells.reserve(truth.cells.size());
  for (const Cell cell : truth.cells)
    map.cells.push_back(cell == Cell::kOccupied ? OccupancyMap::kOccupied
                        : cell == Cell::kFree   ? OccupancyMap::kFree
                                                : OccupancyMap::kUnknown);
  return map;
}

}  // namespace

datasets::DatasetHeader header_of(const sim::Simulation& simulation) {
  const sim::World& world = simulation.world();
  return {.name = world.name,
          .description = world.description,
          .license = "CC0-1.0",
          .robot_radius_m = world.robot_radius_m,
          .initial_pose = simulation.initial_pose(),
          .acquisition_sensor = simulation.acquisition_sensor(),
          .rig = simulation.rig(),
          .floor_plan = simulation.floor_plan()};
}

datasets::Dataset readings_of(const sim::Simulation& simulation) {
  datasets::Dataset drive;
  drive.header = header_of(simulation);
  const sensors::Rig& rig = drive.header.rig;
  drive.scans.resize(rig.range_finders.size());
  drive.sonar.resize(rig.sonar_rings.size());
  drive.events_recorded = true;
  drive.camera_name = rig.camera ? "camera0" : "";
  drive.range_finder_names = numbered("range", rig.range_finders.size());
  drive.sonar_ring_names = numbered("sonar", rig.sonar_rings.size());
  sim::Sink sink;
  sink.scan = [&](const sensors::RangeScan& scan) {
    drive.scans[static_cast<std::size_t>(scan.sensor)].push_back(scan);
  };
  sink.sonar = [&](const sensors::SonarSweep& sweep) {
    drive.sonar[static_cast<std::size_t>(sweep.sensor)].push_back(sweep);
  };
  sink.odometry = [&](const sensors::OdometryReading& reading) { drive.odometry.push_back(reading); };
  sink.truth = [&](sensors::Timestamp time, const geometry::Pose2& pose) { drive.truth.push_back({time, pose}); };
  sink.event = [&](sensors::Timestamp time, std::string_view name) {
    drive.events.push_back({time, std::string(name)});
  };
  simulation.run(sink);
  return drive;
}

datasets::OccupancyMap true_map_of(const sim::Simulation& simulation) { return occupancy_of(simulation.truth_map()); }

std::vector<datasets::TruthState> true_states_of(const sim::Simulation& simulation) {
  std::vector<datasets::TruthState> states;
  for (const sim::TruthState& state : simulation.truth_states())
    states.push_back({state.since, occupancy_of(state.map)});
  return states;
}

void for_each_acquisition(const sim::Simulation& simulation, const datasets::Dataset& readings,
                          const std::function<void(sensors::Acquisition)>& take, const PlayParams& params) {
  if (readings.header.rig.camera) {
    std::optional<sensors::Timestamp> previous;
    sim::Sink sink;
    sink.progress = params.progress;
    sink.image = [&](const sensors::OmniImage& image) {
      take(datasets::gather(readings, previous, image.time, image));
      previous = image.time;
    };
    simulation.run(sink, params.threads);
  } else {
    const datasets::Acquisitions acquisitions(readings);
    for (std::size_t i = 0; i < acquisitions.size(); ++i) {
      take(acquisitions.read(i));
      if (params.progress) params.progress(static_cast<double>(i + 1) / static_cast<double>(acquisitions.size()));
    }
  }
}

}  // namespace credo::evaluation
