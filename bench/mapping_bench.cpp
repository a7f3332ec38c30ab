// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Readings into an evidential map, cells of 5 cm, on one core: a scan of 361 beams in a room of 12 x 8 m, and a ring of
// 16 sonars in it. Goals: 15 us for the scan.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mapping/mapper.hpp"

namespace {

using namespace credo;

constexpr double kWidth_m = 12.0, kHeight_m = 8.0;

double distance_to_room(const geometry::Pose2& from) {
  const double c = std::cos(from.theta), s = std::sin(from.theta);
  const double along_x = c > 0 ? (kWidth_m - from.x) / c : c < 0 ? -from.x / c : 1e9;
  const double along_y = s > 0 ? (kHeight_m - from.y) / s : s < 0 ? -from.y / s : 1e9;
  return std::min(along_x, along_y);
}

sensors::RangeFinder half_circle() {
  sensors::RangeFinder finder;
  finder.angle_min_rad = -0.5 * std::numbers::pi;
  finder.angle_increment_rad = std::numbers::pi / 360.0;
  finder.count = 361;
  finder.range_max_m = 20.0;
  return finder;
}

sensors::SonarRing ring_of_16() {
  sensors::SonarRing ring;
  for (int i = 0; i < 16; ++i) {
    const double theta = i * std::numbers::pi / 8.0;
    ring.T_base_transducer.push_back({0.2 * std::cos(theta), 0.2 * std::sin(theta), theta});
  }
  return ring;
}

evidence::Believed<geometry::PoseEstimate> pose_number(int k) {
  return {{{4.0 + 0.37 * (k % 8), 3.0 + 0.21 * (k % 5), 0.7 * k}, Eigen::Matrix3d::Zero()},
          {.yes = 1.0, .no = 0.0, .unknown = 0.0}};
}

void scan_of_361_beams(benchmark::State& state) {
  sensors::Rig rig;
  rig.range_finders = {half_circle()};
  mapping::Mapper mapper(rig);
  std::vector<sensors::RangeScan> scans(16);
  for (int k = 0; k < 16; ++k)
    for (int i = 0; i < 361; ++i)
      scans[k].ranges_m.push_back(static_cast<float>(
          distance_to_room(pose_number(k).value.pose * geometry::Pose2{0.0, 0.0, rig.range_finders[0].beam_angle(i)})));
  int k = 0;
  for (auto _ : state) {
    mapper.insert(pose_number(k), scans[k]);
    k = (k + 1) % 16;
  }
  state.SetItemsProcessed(state.iterations() * 361);
}
BENCHMARK(scan_of_361_beams)->Unit(benchmark::kMicrosecond);

void sweep_of_16_sonars(benchmark::State& state) {
  sensors::Rig rig;
  rig.sonar_rings = {ring_of_16()};
  mapping::Mapper mapper(rig);
  std::vector<sensors::SonarSweep> sweeps(16);
  for (int k = 0; k < 16; ++k)
    for (const geometry::Pose2& transducer : rig.sonar_rings[0].T_base_transducer) {
      const double range_m = distance_to_room(pose_number(k).value.pose * transducer);
      sweeps[k].ranges_m.push_back(static_cast<float>(std::min(range_m, 2.9)));  // echoes all: the largest fans
    }
  int k = 0;
  for (auto _ : state) {
    mapper.insert(pose_number(k), sweeps[k]);
    k = (k + 1) % 16;
  }
}
BENCHMARK(sweep_of_16_sonars)->Unit(benchmark::kMicrosecond);

void merge_of_two_maps(benchmark::State& state) {
  grids::EvidentialGrid mine, other;
  const auto increment = evidence::quantise(evidence::log_commonality({0.9, 0.05, 0.0, 0.05}, 0.95));
  for (int y = 0; y < 448; ++y)
    for (int x = 0; x < 448; ++x) {
      mine.add({x, y}, increment);
      other.add({x, y}, increment);
    }
  for (auto _ : state) mine.merge(other);
  state.SetItemsProcessed(state.iterations() * 448 * 448);  // cells
}
BENCHMARK(merge_of_two_maps)->Unit(benchmark::kMicrosecond);

}  // namespace
