// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/placed_sweep.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::mapping {
namespace {

using geometry::Pose2;

/// Where a transducer is when it fires.
Pose2 transducer_pose(const Pose2& T_map_base, const sensors::SonarRing& ring, std::size_t transducer,
                      const sensors::MotionPath& path, sensors::Timestamp time) {
  if (path.empty() || ring.firing_times_s.empty()) return T_map_base * ring.T_base_transducer[transducer];
  const sensors::Timestamp fired = time + sensors::from_seconds(ring.firing_times_s[transducer]);
  return T_map_base * path.motion(time, fired) * ring.T_base_transducer[transducer];
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

void require_sensor(std::size_t sensors, int index, std::size_t readings, std::size_t expected, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= sensors)
    throw std::invalid_argument(std::string("the rig has ") + std::to_string(sensors) + ' ' + what +
                                "s, but a reading is of number " + std::to_string(index));
  if (readings != expected)
    throw std::invalid_argument(std::string("a reading of ") + what + ' ' + std::to_string(index) + " has " +
                                std::to_string(readings) + " ranges instead of " + std::to_string(expected));
}

void place_sweep(const sensors::Rig& rig, const grids::Georeference& georeference, const PoseReliabilityParams& params,
                 const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
                 const sensors::MotionPath& path, MappingCounts& counts, std::vector<PlacedReading>& placed,
                 std::span<const double> trust, double share) {
  placed.clear();
  const auto& rings = rig.sonar_rings;
  const bool there = sweep.sensor >= 0 && static_cast<std::size_t>(sweep.sensor) < rings.size();
  require_sensor(rings.size(), sweep.sensor, sweep.ranges_m.size(),
                 there ? rings[static_cast<std::size_t>(sweep.sensor)].T_base_transducer.size() : 0, "sonar ring");
  const sensors::SonarRing& ring = rings[static_cast<std::size_t>(sweep.sensor)];
  const PoseReliability reliability(T_map_base, georeference.resolution_m, params, share);

  // All poses are checked before a reading is placed.
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(2.0 * ring.range_max_m + 1.0);
  for (std::size_t i = 0; i < sweep.ranges_m.size(); ++i) {
    const Pose2 pose = transducer_pose(T_map_base.value.pose, ring, i, path, sweep.time);
    static_cast<void>(georeference.cell_at(pose.translation() - margin));
    static_cast<void>(georeference.cell_at(pose.translation() + margin));
    placed.push_back({static_cast<int>(i), pose, sweep.ranges_m[i]});
  }
  ++counts.sweeps;
  if (reliability.maps_nothing()) {
    ++counts.refused;
    placed.clear();
    return;
  }
  std::erase_if(placed, [&](PlacedReading& reading) {
    const bool no_echo = std::isinf(reading.range_m) && reading.range_m > 0.0;
    if (std::isnan(reading.range_m)) {
      ++counts.missing;
      return true;
    }
    if (!no_echo && (reading.range_m < ring.range_min_m || reading.range_m > ring.range_max_m)) {
      ++counts.out_of_range;
      return true;
    }
    ++(no_echo ? counts.no_returns : counts.echoes);
    reading.reliability = reliability.at(no_echo ? ring.range_max_m : reading.range_m);
    if (!trust.empty()) reading.reliability *= trust[static_cast<std::size_t>(reading.transducer)];
    return false;
  });
}

}  // namespace credo::mapping
