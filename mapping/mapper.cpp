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
using geometry::Pose2;
using geometry::PoseEstimate;

template <typename Sensors>
void require_sensor(const Sensors& sensors, int index, std::size_t readings, std::size_t expected_if_there,
                    const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= sensors.size())
    throw std::invalid_argument(std::string("the rig has ") + std::to_string(sensors.size()) + ' ' + what +
                                "s, but a reading is of number " + std::to_string(index));
  if (readings != expected_if_there)
    throw std::invalid_argument(std::string("a reading of ") + what + ' ' + std::to_string(index) + " has " +
                                std::to_string(readings) + " ranges instead of " + std::to_string(expected_if_there));
}

/// Where every transducer is when it fires.
Pose2 transducer_pose(const Pose2& T_map_base, const sensors::SonarRing& ring, std::size_t transducer,
                      const sensors::MotionPath& path, sensors::Timestamp time) {
  if (path.empty() || ring.firing_times_s.empty()) return T_map_base * ring.T_base_transducer[transducer];
  const sensors::Timestamp fired = time + sensors::from_seconds(ring.firing_times_s[transducer]);
  return T_map_base * path.motion(time, fired) * ring.T_base_transducer[transducer];
}

void check(const sensors::SonarRing& ring) {
  if (!ring.firing_times_s.empty() && ring.firing_times_s.size() != ring.T_base_transducer.size())
    throw std::invalid_argument("sonar ring: " + std::to_string(ring.firing_times_s.size()) + " firing times for " +
                                std::to_string(ring.T_base_transducer.size()) + " transducers");
}

}  // namespace

MappingCounts& MappingCounts::operator+=(const MappingCounts& other) {
  sweeps += other.sweeps;
  scans += other.scans;
  refused += other.refused;
  echoes += other.echoes;
  no_returns += other.no_returns;
  missing += other.missing;
  out_of_range += other.out_of_range;
  return *this;
}

struct Mapper::State {
  sensors::Rig rig;
  MapperParams params;
  grids::EvidentialGrid grid;
  std::vector<FanPainter> fans;    // one for each sonar ring
  std::vector<ScanPainter> scans;  // one for each range finder
  std::vector<Pose2> transducers;  // of the sweep at hand
  MappingCounts counts;
};

Mapper::Mapper(const sensors::Rig& rig, const MapperParams& params)
    : state_(std::make_unique<State>(State{rig, params, grids::EvidentialGrid(params.georeference), {}, {}, {}, {}})) {
  for (const sensors::SonarRing& ring : rig.sonar_rings) {
    check(ring);
    state_->fans.emplace_back(Li2007(ring, params.sonar), ring, params.georeference);
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
  const auto& rings = s.rig.sonar_rings;
  const bool there = sweep.sensor >= 0 && static_cast<std::size_t>(sweep.sensor) < rings.size();
  require_sensor(rings, sweep.sensor, sweep.ranges_m.size(), there ? rings[sweep.sensor].T_base_transducer.size() : 0,
                 "sonar ring");
  const sensors::SonarRing& ring = rings[sweep.sensor];
  const PoseReliability reliability(T_map_base, s.params.georeference.resolution_m, s.params.pose);

  // All poses are checked before the first cell changes.
  s.transducers.clear();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(2.0 * ring.range_max_m + 1.0);
  for (std::size_t i = 0; i < sweep.ranges_m.size(); ++i) {
    const Pose2& pose = s.transducers.emplace_back(transducer_pose(T_map_base.value.pose, ring, i, path, sweep.time));
    static_cast<void>(s.params.georeference.cell_at(pose.translation() - margin));
    static_cast<void>(s.params.georeference.cell_at(pose.translation() + margin));
  }
  ++s.counts.sweeps;
  if (reliability.maps_nothing()) {
    ++s.counts.refused;
    return;
  }
  for (std::size_t i = 0; i < sweep.ranges_m.size(); ++i) {
    const double range_m = sweep.ranges_m[i];
    const bool no_echo = std::isinf(range_m) && range_m > 0.0;
    if (std::isnan(range_m)) {
      ++s.counts.missing;
    } else if (!no_echo && (range_m < ring.range_min_m || range_m > ring.range_max_m)) {
      ++s.counts.out_of_range;
    } else {
      ++(no_echo ? s.counts.no_returns : s.counts.echoes);
      s.fans[sweep.sensor].paint(s.grid, s.transducers[i], range_m,
                                 reliability.at(no_echo ? ring.range_max_m : range_m));
    }
  }
}

void Mapper::insert(const Believed<PoseEstimate>& T_map_base, const sensors::RangeScan& scan,
                    const sensors::MotionPath& path) {
  State& s = *state_;
  const auto& finders = s.rig.range_finders;
  const bool there = scan.sensor >= 0 && static_cast<std::size_t>(scan.sensor) < finders.size();
  require_sensor(finders, scan.sensor, scan.ranges_m.size(),
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
