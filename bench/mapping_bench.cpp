// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Readings into an evidential map, cells of 5 cm, on one core; where MRPT's occupancy grid is installed
// (libmrpt-maps-dev), it takes in the same readings in turn with ours: MRPT/ours says how many times as fast we are.
// Whole maps beside a plain a[i] += b[i] over as many bytes: plain/ours is the share of the bandwidth that is reached.
// Goals: MRPT/ours >= 3.5 for scans and >= 0.5 for sweeps; plain/ours >= 0.6 in L2 and >= 0.75 beyond the caches;
// 10 ms for 236 sweeps. docs/mapping_speed.md has the results.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "bench/scenes.hpp"
#include "bench/versus.hpp"
#include "mapping/mapper.hpp"
#include "mapping/region_filler.hpp"
#ifdef CREDO_MRPT
#include "bench/mrpt_maps.hpp"
#endif

namespace credo::bench {
namespace {

using geometry::Pose2;

sensors::RangeFinder half_circle() {
  sensors::RangeFinder finder;
  finder.angle_min_rad = -0.5 * std::numbers::pi;
  finder.angle_increment_rad = std::numbers::pi / 360.0;
  finder.count = 361;
  finder.range_max_m = 40.0;
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

evidence::Believed<geometry::PoseEstimate> certain(const Pose2& pose) {
  return {{pose, Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}};
}

/// One scan from every pose of a scene, with 1 cm of noise.
std::vector<sensors::RangeScan> scans_of(const Scene& scene, const sensors::RangeFinder& finder) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<sensors::RangeScan> scans;
  for (const Pose2& pose : scene.poses) {
    sensors::RangeScan& scan = scans.emplace_back();
    for (int beam = 0; beam < finder.count; ++beam)
      scan.ranges_m.push_back(
          static_cast<float>(distance_along(scene, pose * Pose2{0.0, 0.0, finder.beam_angle(beam)}) + noise(random)));
  }
  return scans;
}

/// The nearest echo within a cone, as a transducer hears it. \param most_m  farther walls are heard from there
double echo(const Scene& scene, const Pose2& transducer, double half_width_rad, double most_m) {
  double nearest = most_m;
  for (int ray = -4; ray <= 4; ++ray)
    nearest = std::min(nearest, distance_along(scene, transducer * Pose2{0.0, 0.0, 0.25 * ray * half_width_rad}));
  return nearest;
}

sensors::SonarSweep sweep_of(const Scene& scene, const sensors::SonarRing& ring, const Pose2& pose) {
  sensors::SonarSweep sweep;
  for (const Pose2& transducer : ring.T_base_transducer)  // echoes all, up to the largest cones
    sweep.ranges_m.push_back(
        static_cast<float>(std::max(ring.range_min_m, echo(scene, pose * transducer, 0.5 * ring.beam_width_rad, 2.9))));
  return sweep;
}

/// Ours in turn with MRPT's, or alone where it is not installed.
template <typename Ours, typename Peer>
void beside_mrpt(benchmark::State& state, const Ours& ours, [[maybe_unused]] const Peer& peer) {
#ifdef CREDO_MRPT
  versus(state, kPoses, ours, "MRPT", peer);
#else
  alone(state, kPoses, ours);
#endif
}

/// \param scans_per_reading  after so many the map is made ready to be read, within the time; kPoses at most
void scan_of_361_beams(benchmark::State& state, const Scene& scene, int scans_per_reading) {
  sensors::Rig rig;
  rig.range_finders = {half_circle()};
  mapping::Mapper mapper(rig);
  const std::vector<sensors::RangeScan> scans = scans_of(scene, rig.range_finders[0]);
  const auto ours = [&] {
    for (int k = 0; k < kPoses; ++k) {
      mapper.insert(certain(scene.poses[k]), scans[k]);
      if ((k + 1) % scans_per_reading == 0) benchmark::DoNotOptimize(mapper.grid());
    }
  };
#ifdef CREDO_MRPT
  auto grid = mrpt_grid(scene.width_m, scene.height_m, mapper.grid().georeference().resolution_m);
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;
  for (const sensors::RangeScan& scan : scans) observations.push_back(mrpt_scan(rig.range_finders[0], scan.ranges_m));
#endif
  beside_mrpt(state, ours, [&] {
#ifdef CREDO_MRPT
    for (int k = 0; k < kPoses; ++k) grid.insertObservation(observations[k], mrpt_pose(scene.poses[k]));
#endif
  });
}

void sweep_of_16_sonars(benchmark::State& state, const Scene& scene) {
  sensors::Rig rig;
  rig.sonar_rings = {ring_of_16()};
  mapping::Mapper mapper(rig);
  std::vector<sensors::SonarSweep> sweeps;
  for (const Pose2& pose : scene.poses) sweeps.push_back(sweep_of(scene, rig.sonar_rings[0], pose));
  const auto ours = [&] {
    for (int k = 0; k < kPoses; ++k) mapper.insert(certain(scene.poses[k]), sweeps[k]);
  };
#ifdef CREDO_MRPT
  auto grid = mrpt_grid(scene.width_m, scene.height_m, mapper.grid().georeference().resolution_m);
  std::vector<std::vector<mrpt::obs::CObservationRange>> observations;
  for (const sensors::SonarSweep& sweep : sweeps)
    observations.push_back(mrpt_sweep(rig.sonar_rings[0], sweep.ranges_m));
#endif
  beside_mrpt(state, ours, [&] {
#ifdef CREDO_MRPT
    for (int k = 0; k < kPoses; ++k) {
      const mrpt::poses::CPose3D pose = mrpt_pose(scene.poses[k]);
      for (const mrpt::obs::CObservationRange& observation : observations[k]) grid.insertObservation(observation, pose);
    }
#endif
  });
}

/// The experiment of Li X. 2007: a robot with 16 sonars goes round a room of 4.55 x 3.75 m and stops 236 times. The
/// mapper is new each time: tables of increments and tiles are made within the time.
void drive_of_236_sweeps(benchmark::State& state) {
  constexpr int kSweeps = 236;
  const Scene scene = room("", 4.55, 3.75, 6);
  sensors::Rig rig;
  rig.sonar_rings = {ring_of_16()};
  std::vector<Pose2> poses;
  std::vector<sensors::SonarSweep> sweeps;
  for (int k = 0; k < kSweeps; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / kSweeps;
    poses.push_back({2.275 + 1.3 * std::cos(turn), 1.875 + 0.9 * std::sin(turn), turn + 0.5 * std::numbers::pi});
    sweeps.push_back(sweep_of(scene, rig.sonar_rings[0], poses.back()));
  }
  for (auto _ : state) {
    mapping::Mapper mapper(rig);
    for (int k = 0; k < kSweeps; ++k) mapper.insert(certain(poses[k]), sweeps[k]);
    benchmark::DoNotOptimize(mapper.grid());
  }
}
BENCHMARK(drive_of_236_sweeps)->Unit(benchmark::kMillisecond);

/// What the memory allows: the peer of whole maps.
#if defined(__x86_64__)
[[gnu::target_clones("avx2", "default")]]
#endif
void add(std::int32_t* to, const std::int32_t* from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] += from[i];
}

#if defined(__x86_64__)
[[gnu::target_clones("avx2", "default")]]
#endif
void add(std::int32_t* to, std::int32_t increment, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] += increment;
}

/// \return a square of `side` tiles by `side`, each cell with some evidence
grids::EvidentialGrid square_map(int side) {
  grids::EvidentialGrid map;
  const auto increment = evidence::fixed_increment({0.9, 0.05, 0.0, 0.05}, 0.01);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      grids::Tile& tile = map.tile({y, x});
      tile.empty.fill(increment.empty);
      tile.occupied.fill(increment.occupied);
      tile.unknown.fill(increment.unknown);
    }
  return map;
}

int calls_for(int side) { return std::max(1, 1024 / (side * side)); }

void merge_of_two_maps(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  grids::EvidentialGrid mine = square_map(side);
  const grids::EvidentialGrid other = square_map(side);
  const std::size_t numbers = mine.tiles().size() * 3 * grids::Tile::kCells;
  std::vector<std::int32_t> to(numbers, -1), from(numbers, -1);
  const int calls = calls_for(side);
  versus(
      state, calls,
      [&] {
        for (int call = 0; call < calls; ++call) mine.merge(other);
      },
      "plain",
      [&] {
        for (int call = 0; call < calls; ++call) {
          add(to.data(), from.data(), numbers);
          benchmark::ClobberMemory();
        }
      });
}
BENCHMARK(merge_of_two_maps)->ArgName("tiles")->Arg(2)->Arg(45)->UseManualTime()->Unit(benchmark::kMicrosecond);

void evidence_for_all_cells(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  grids::EvidentialGrid map = square_map(side);
  const std::size_t numbers = map.tiles().size() * 3 * grids::Tile::kCells;
  std::vector<std::int32_t> to(numbers, -1);
  mapping::RegionFiller::Increments increments;
  increments[0].increment = evidence::fixed_increment({0.9, 0.05, 0.0, 0.05}, 0.01);
  const auto width = static_cast<float>(side * grids::Tile::kSide);
  const std::vector<mapping::RegionFiller::Corner> square{{0.0F, 0.0F}, {width, 0.0F}, {width, width}, {0.0F, width}};
  mapping::RegionFiller filler;
  mapping::PendingRegions pending;
  const int calls = calls_for(side);
  versus(
      state, calls,
      [&] {
        for (int call = 0; call < calls; ++call) {
          filler.add_contour(square, 0);
          filler.fill(map, pending, increments, mapping::RegionFiller::Regions::kApart);
          pending.settle(map);
        }
      },
      "plain",
      [&] {
        for (int call = 0; call < calls; ++call) {
          add(to.data(), -1, numbers);
          benchmark::ClobberMemory();
        }
      });
}
BENCHMARK(evidence_for_all_cells)->ArgName("tiles")->Arg(3)->Arg(64)->UseManualTime()->Unit(benchmark::kMicrosecond);

[[maybe_unused]] const bool registered = [] {
  for (const Scene& scene : scenes()) {
    benchmark::RegisterBenchmark(("scan_of_361_beams/" + scene.name).c_str(), scan_of_361_beams, scene, kPoses)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("scan_of_361_beams_then_read/" + scene.name).c_str(), scan_of_361_beams, scene, 1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("sweep_of_16_sonars/" + scene.name).c_str(), sweep_of_16_sonars, scene)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace credo::bench
