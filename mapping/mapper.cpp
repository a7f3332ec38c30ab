// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/mapper.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mapping/fan_painter.hpp"
#include "mapping/scan_painter.hpp"

namespace credo::mapping {
namespace {

using evidence::Believed;
using geometry::PoseEstimate;

void check(const sensors::SonarRing& ring) {
  if (!ring.firing_times_s.empty() && ring.firing_times_s.size() != ring.T_base_transducer.size())
    throw std::invalid_argument("sonar ring: " + std::to_string(ring.firing_times_s.size()) + " firing times for " +
                                std::to_string(ring.T_base_transducer.size()) + " transducers");
}

}  // namespace

struct Mapper::State {
  sensors::Rig rig;
  MapperParams params;
  grids::EvidentialGrid grid;
  std::vector<FanPainter> fans;       // one for each sonar ring
  std::vector<ScanPainter> scans;     // one for each range finder
  std::vector<PlacedReading> placed;  // of the sweep at hand
  MappingCounts counts;
};

Mapper::Mapper(const sensors::Rig& rig, const MapperParams& params)
    : state_(std::make_unique<State>(State{rig, params, grids::EvidentialGrid(params.georeference), {}, {}, {}, {}})) {
  for (const sensors::SonarRing& ring : rig.sonar_rings) {
    check(ring);
    state_->fans.emplace_back(sonar_model(ring, params.sonar), ring, params.georeference);
  }
  const Li2006Laser laser(params.laser);
  for (const sensors::RangeFinder& finder : rig.range_finders)
    state_->scans.emplace_back(finder, params.georeference, laser_tables(laser, finder, params.scan), params.scan);
}

Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

void Mapper::insert(const Believed<PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
                    const sensors::MotionPath& path) {
  State& s = *state_;
  place_sweep(s.rig, s.params.georeference, s.params.pose, T_map_base, sweep, path, s.counts, s.placed);
  for (const PlacedReading& reading : s.placed)
    s.fans[static_cast<std::size_t>(sweep.sensor)].paint(s.grid, reading.T_map_transducer, reading.range_m,
                                                         reading.reliability);
}

void Mapper::insert(const Believed<PoseEstimate>& T_map_base, const sensors::RangeScan& scan,
                    const sensors::MotionPath& path) {
  State& s = *state_;
  const auto& finders = s.rig.range_finders;
  const bool there = scan.sensor >= 0 && static_cast<std::size_t>(scan.sensor) < finders.size();
  require_sensor(finders.size(), scan.sensor, scan.ranges_m.size(),
                 there ? static_cast<std::size_t>(finders[scan.sensor].count) : 0, "range finder");
  const PoseReliability reliability(T_map_base, s.params.georeference.resolution_m, s.params.pose);
  if (reliability.maps_nothing()) {
    ++s.counts.scans;
    ++s.counts.refused;
    return;
  }
  const ScanPainter::Counts counts =
      s.scans[scan.sensor].paint(s.grid, T_map_base.value.pose, reliability, scan.ranges_m, path, scan.time);
  ++s.counts.scans;
  s.counts.echoes += counts.echoes;
  s.counts.no_returns += counts.no_returns;
  s.counts.missing += counts.missing;
  s.counts.out_of_range += counts.out_of_range;
}

const grids::EvidentialGrid& Mapper::grid() const { return state_->grid; }

grids::EvidentialGrid Mapper::take_grid() {
  return std::exchange(state_->grid, grids::EvidentialGrid(state_->params.georeference));
}

const MappingCounts& Mapper::counts() const { return state_->counts; }

}  // namespace credo::mapping
