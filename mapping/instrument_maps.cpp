// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/instrument_maps.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <iterator>
#include <stdexcept>
#include <utility>

#include "mapping/batches.hpp"
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

/// The maps of a ring's transducers in the making.
class RingMapping {
 public:
  RingMapping(const sensors::MotionPath& T_map_base, const sensors::Rig& rig, std::size_t ring,
              const TrajectoryMappingParams& params)
      : T_map_base_(T_map_base), rig_(rig), ring_(ring), params_(params), reliability_(rig, params.mapper.sensors) {
    for (std::size_t i = 0; i < rig.sonar_rings[ring].T_base_transducer.size(); ++i)
      maps_.push_back({{.ring = static_cast<int>(ring), .transducer = static_cast<int>(i)},
                       EvidentialGrid(params.mapper.georeference)});
    said_.resize(maps_.size());
  }

  /// Deals a sweep's readings out to their transducers.
  void place(const sensors::SonarSweep& sweep, double share, InstrumentMaps& result) {
    if (!covers(T_map_base_, sweep.time, params_.max_gap_s)) {
      ++result.without_pose;
      return;
    }
    place_sweep(rig_, params_.mapper.georeference, params_.mapper.pose,
                {{T_map_base_.pose_at(sweep.time), params_.covariance}, params_.belief}, sweep, T_map_base_,
                result.counts, placed_, reliability_.of_ring(ring_), share);
    for (const PlacedReading& reading : placed_) {
      said_[static_cast<std::size_t>(reading.transducer)].push_back(reading);
      maps_[static_cast<std::size_t>(reading.transducer)].sweeps += share;
    }
  }
  /// Maps what was placed of a transducer since the last time. Transducers may be painted at once, by painters of their
  /// own.
  void paint(std::size_t transducer, FanPainter& fans) {
    InstrumentMap& map = maps_[transducer];
    for (const PlacedReading& reading : said_[transducer])
      fans.paint(map.grid, reading.T_map_transducer, reading.range_m, reading.reliability);
    map.readings += static_cast<std::int64_t>(said_[transducer].size());
    said_[transducer].clear();
  }
  [[nodiscard]] std::vector<InstrumentMap>& maps() { return maps_; }

 private:
  const sensors::MotionPath& T_map_base_;
  const sensors::Rig& rig_;
  std::size_t ring_;
  const TrajectoryMappingParams& params_;
  SensorReliability reliability_;
  std::vector<InstrumentMap> maps_;               // one for each transducer
  std::vector<std::vector<PlacedReading>> said_;  // of the batch at hand, by transducer
  std::vector<PlacedReading> placed_;             // of the sweep at hand
};

/// Cores share the transducers out and not the sweeps, so that there is one map of each, and none to merge.
/// \param report  is told how many of the sweeps are done
template <typename Report>
void add_ring(InstrumentMaps& result, std::size_t ring, const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
              std::span<const sensors::SonarSweep> sweeps, const TrajectoryMappingParams& params,
              const Report& report) {
  const std::vector<double> shares = new_shares(T_map_base, sweeps, params);
  RingMapping mapping(T_map_base, rig, ring, params);
  tbb::enumerable_thread_specific<FanPainter> painters([&] {
    return FanPainter(sonar_model(rig.sonar_rings[ring], params.mapper.sonar), rig.sonar_rings[ring],
                      params.mapper.georeference);
  });
  in_batches(
      sweeps.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) mapping.place(sweeps[i], shares[i], result);
        tbb::parallel_for(std::size_t{0}, mapping.maps().size(),
                          [&](std::size_t transducer) { mapping.paint(transducer, painters.local()); });
      },
      report);
  std::move(mapping.maps().begin(), mapping.maps().end(), std::back_inserter(result.maps));
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
    add_ring(result, ring, T_map_base, rig, own, params,
             [&](std::size_t sweeps_done) { report(static_cast<double>(sweeps_done)); });
    done += static_cast<double>(own.size());
  }
  return result;
}

}  // namespace credo::mapping
