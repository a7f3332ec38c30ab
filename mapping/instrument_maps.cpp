// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/instrument_maps.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <stdexcept>
#include <utility>

#include "mapping/fan_painter.hpp"

namespace credo::mapping {
namespace {

using grids::EvidentialGrid;

template <typename Reading>
std::vector<Reading> of_sensor(std::span<const Reading> readings, std::size_t sensor) {
  std::vector<Reading> result;
  for (const Reading& reading : readings)
    if (reading.sensor == static_cast<int>(sensor)) result.push_back(reading);
  return result;
}

/// Scans with a pose, by what is new in them.
double new_scans(const sensors::MotionPath& T_map_base, std::span<const sensors::RangeScan> scans,
                 const TrajectoryMappingParams& params) {
  const std::vector<double> shares = new_shares(T_map_base, scans, params);
  double sum = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (covers(T_map_base, scans[i].time, params.max_gap_s)) sum += shares[i];
  return sum;
}

/// What one thread has mapped of a ring so far.
struct RingWorker {
  FanPainter fans;
  std::vector<InstrumentMap> maps;  // one for each transducer
  MappingCounts counts;
  std::int64_t without_pose = 0;
  std::vector<PlacedReading> placed;  // of the sweep at hand
};

RingWorker worker_of(const sensors::Rig& rig, std::size_t ring, const MapperParams& params) {
  RingWorker worker{
      .fans = FanPainter(sonar_model(rig.sonar_rings[ring], params.sonar), rig.sonar_rings[ring], params.georeference),
      .maps = {},
      .counts = {},
      .placed = {}};
  for (std::size_t i = 0; i < rig.sonar_rings[ring].T_base_transducer.size(); ++i)
    worker.maps.push_back(
        {{.ring = static_cast<int>(ring), .transducer = static_cast<int>(i)}, EvidentialGrid(params.georeference)});
  return worker;
}

void add_ring(InstrumentMaps& result, std::size_t ring, const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
              std::span<const sensors::SonarSweep> sweeps, const TrajectoryMappingParams& params) {
  const std::vector<double> shares = new_shares(T_map_base, sweeps, params);
  const SensorReliability reliability(rig, params.mapper.sensors);
  tbb::enumerable_thread_specific<RingWorker> workers([&] { return worker_of(rig, ring, params.mapper); });
  tbb::parallel_for(std::size_t{0}, sweeps.size(), [&](std::size_t i) {
    RingWorker& worker = workers.local();
    const sensors::SonarSweep& sweep = sweeps[i];
    if (!covers(T_map_base, sweep.time, params.max_gap_s)) {
      ++worker.without_pose;
      return;
    }
    place_sweep(rig, params.mapper.georeference, params.mapper.pose,
                {{T_map_base.pose_at(sweep.time), params.covariance}, params.belief}, sweep, T_map_base, worker.counts,
                worker.placed, reliability.of_ring(ring), shares[i]);
    for (const PlacedReading& reading : worker.placed) {
      InstrumentMap& map = worker.maps[static_cast<std::size_t>(reading.transducer)];
      worker.fans.paint(map.grid, reading.T_map_transducer, reading.range_m, reading.reliability);
      ++map.readings;
      map.sweeps += shares[i];  // a power of a half: the sum is the same in any order
    }
  });
  RingWorker sum = worker_of(rig, ring, params.mapper);
  for (const RingWorker& worker : workers) {
    for (std::size_t i = 0; i < sum.maps.size(); ++i) {
      sum.maps[i].grid.merge(worker.maps[i].grid);
      sum.maps[i].readings += worker.maps[i].readings;
      sum.maps[i].sweeps += worker.maps[i].sweeps;
    }
    result.counts += worker.counts;
    result.without_pose += worker.without_pose;
  }
  std::move(sum.maps.begin(), sum.maps.end(), std::back_inserter(result.maps));
}

}  // namespace

std::string Instrument::name() const {
  if (!is_sonar()) return "range finder " + std::to_string(finder);
  return "transducer " + std::to_string(transducer) + " of ring " + std::to_string(ring);
}

InstrumentMaps map_by_instrument(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                 std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                                 const TrajectoryMappingParams& params,
                                 const std::function<void(double share)>& progress) {
  if (T_map_base.empty()) throw std::invalid_argument("the trajectory has no pose: nothing can be mapped along it");
  for (const sensors::RangeScan& scan : scans)
    require_sensor(rig.range_finders.size(), scan.sensor, 0, 0, "range finder");
  for (const sensors::SonarSweep& sweep : sweeps)
    require_sensor(rig.sonar_rings.size(), sweep.sensor, 0, 0, "sonar ring");
  InstrumentMaps result;
  const double all = static_cast<double>(scans.size() + sweeps.size());
  double done = 0.0;
  const auto report = [&](double readings) {
    if (progress) progress((done + readings) / all);
  };
  for (std::size_t finder = 0; finder < rig.range_finders.size(); ++finder) {
    const std::vector<sensors::RangeScan> own = of_sensor(scans, finder);
    if (own.empty()) continue;
    const auto count = static_cast<double>(own.size());
    TrajectoryMap map = map_along(T_map_base, rig, own, {}, params, [&](double share) { report(share * count); });
    done += count;
    result.counts += map.counts;
    result.without_pose += map.without_pose;
    result.maps.push_back({{.finder = static_cast<int>(finder)},
                           std::move(map.grid),
                           map.counts.echoes + map.counts.no_returns,
                           new_scans(T_map_base, own, params)});
  }
  for (std::size_t ring = 0; ring < rig.sonar_rings.size(); ++ring) {
    const std::vector<sensors::SonarSweep> own = of_sensor(sweeps, ring);
    if (own.empty()) continue;
    add_ring(result, ring, T_map_base, rig, own, params);
    done += static_cast<double>(own.size());
    report(0.0);
  }
  return result;
}

}  // namespace credo::mapping
