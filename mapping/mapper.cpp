// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <span>
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
using grids::EvidentialGrid;

void check(const sensors::SonarRing& ring) {
  if (!ring.firing_times_s.empty() && ring.firing_times_s.size() != ring.T_base_transducer.size())
    throw std::invalid_argument("sonar ring: " + std::to_string(ring.firing_times_s.size()) + " firing times for " +
                                std::to_string(ring.T_base_transducer.size()) + " transducers");
}

void check_share(double share) {
  if (!(share > 0.0 && share <= 1.0))
    throw std::invalid_argument("the share of a reading that is new must be in (0, 1], not " + std::to_string(share));
}

}  // namespace

struct Mapper::State {
  sensors::Rig rig;
  MapperParams params;
  SensorReliability reliability;
  EvidentialGrid grid;
  std::vector<FanPainter> fans;       // one for each sonar ring
  std::vector<ScanPainter> scans;     // one for each range finder
  std::vector<PlacedReading> placed;  // of the sweep at hand
  PendingRegions pending;             // of scans, not in the grid yet
  MappingCounts counts;

  /// Maps a reading whose evidence paint(grid, pose) adds: straight into the map, or blurred over the poses that may
  /// be. \returns what paint does, which is the same from all of them
  template <typename Paint>
  MappingCounts map(const Believed<PoseEstimate>& T_map_base, std::span<const float> ranges_m, double range_max_m,
                    const Paint& paint) {
    const auto poses = poses_for_blur(T_map_base, ranges_m, range_max_m, params.georeference.resolution_m, params.blur);
    if (poses.empty()) return paint(grid, T_map_base);
    pending.settle(grid);
    return paint_mean(grid, poses, [&](EvidentialGrid& from_here, const Believed<PoseEstimate>& pose) {
      const MappingCounts seen = paint(from_here, pose);
      pending.settle(from_here);
      return seen;
    });
  }
};

Mapper::Mapper(const sensors::Rig& rig, const MapperParams& params)
    : state_(std::make_unique<State>(State{.rig = rig,
                                           .params = params,
                                           .reliability = SensorReliability(rig, params.sensors),
                                           .grid = EvidentialGrid(params.georeference),
                                           .fans = {},
                                           .scans = {},
                                           .placed = {},
                                           .pending = {},
                                           .counts = {}})) {
  for (const sensors::SonarRing& ring : rig.sonar_rings) {
    check(ring);
    state_->fans.emplace_back(sonar_model(ring, params.sonar), ring, params.georeference);
  }
  for (const sensors::RangeFinder& finder : rig.range_finders)
    state_->scans.emplace_back(finder, params.georeference, laser_tables(params.laser, finder, params.scan),
                               params.scan);
}

Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

void Mapper::insert(const Believed<PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
                    const sensors::MotionPath& path, double share) {
  State& s = *state_;
  check_share(share);
  const auto& rings = s.rig.sonar_rings;
  const auto ring = static_cast<std::size_t>(sweep.sensor);
  const bool there = sweep.sensor >= 0 && ring < rings.size();
  require_sensor(rings.size(), sweep.sensor, sweep.ranges_m.size(), there ? rings[ring].T_base_transducer.size() : 0,
                 "sonar ring");
  const auto paint = [&](EvidentialGrid& grid, const Believed<PoseEstimate>& pose) {
    MappingCounts counts;
    place_sweep(s.rig, s.params.georeference, s.params.pose, pose, sweep, path, counts, s.placed,
                s.reliability.of_ring(ring), share);
    for (const PlacedReading& reading : s.placed)
      s.fans[ring].paint(grid, reading.T_map_transducer, reading.range_m, reading.reliability);
    return counts;
  };
  s.counts += s.map(T_map_base, sweep.ranges_m, rings[ring].range_max_m, paint);
}

void Mapper::insert(const Believed<PoseEstimate>& T_map_base, const sensors::RangeScan& scan,
                    const sensors::MotionPath& path, double share) {
  State& s = *state_;
  check_share(share);
  const auto& finders = s.rig.range_finders;
  const auto finder = static_cast<std::size_t>(scan.sensor);
  const bool there = scan.sensor >= 0 && finder < finders.size();
  require_sensor(finders.size(), scan.sensor, scan.ranges_m.size(),
                 there ? static_cast<std::size_t>(finders[finder].count) : 0, "range finder");
  const double trust = share * s.reliability.of_finder(finder);
  const auto paint = [&](EvidentialGrid& grid, const Believed<PoseEstimate>& pose) {
    const PoseReliability reliability(pose, s.params.georeference.resolution_m, s.params.pose, trust);
    if (reliability.maps_nothing()) return MappingCounts{.scans = 1, .refused = 1};
    return counts_of(
        s.scans[finder].paint(grid, s.pending, pose.value.pose, reliability, scan.ranges_m, path, scan.time));
  };
  s.counts += s.map(T_map_base, scan.ranges_m, finders[finder].range_max_m, paint);
}

const grids::EvidentialGrid& Mapper::grid() const {
  state_->pending.settle(state_->grid);
  return state_->grid;
}

grids::EvidentialGrid Mapper::take_grid() {
  state_->pending.settle(state_->grid);
  return std::exchange(state_->grid, EvidentialGrid(state_->params.georeference));
}

const MappingCounts& Mapper::counts() const { return state_->counts; }

}  // namespace credo::mapping
