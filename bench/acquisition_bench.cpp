// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// One acquisition by stage, on one core: a decoded 640x480 image and a scan in memory, no file reading. The drives are
// simulated once: the office world (argument 0) and nominal drives through random buildings (argument: their seed).
// Goals for the whole: 1 ms (must), 0.3 ms (goal), 0.15 ms (stretch).

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "evaluation/played_drive.hpp"
#include "localization/localizer.hpp"
#include "perception/observer.hpp"
#include "sim/random_world.hpp"

namespace {

using namespace credo;
using evaluation::PlayedDrive;

/// A drive as a benchmark's argument names it, and what is made of it.
class Drive {
 public:
  explicit Drive(std::int64_t seed) : played_(&played(static_cast<std::uint64_t>(seed))) {}

  [[nodiscard]] std::size_t size() const { return played_->acquisitions.size(); }
  [[nodiscard]] const sensors::Acquisition& operator[](std::size_t i) const { return played_->acquisitions[i]; }
  [[nodiscard]] const sensors::Rig& rig() const { return played_->dataset.header.rig; }
  /// A localizer that has seen nothing.
  [[nodiscard]] localization::Localizer localizer() const {
    const datasets::DatasetHeader& robot = played_->dataset.header;
    return {robot.floor_plan.value(), robot.rig, robot.initial_pose};
  }

 private:
  static const PlayedDrive& played(std::uint64_t seed) {
    static std::map<std::uint64_t, PlayedDrive> drives;
    const auto known = drives.find(seed);
    if (known != drives.end()) return known->second;
    const sim::World world =
        seed == 0 ? sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/office.yaml") : sim::random_world(seed);
    return drives.emplace(seed, evaluation::play(world, std::max<std::uint64_t>(seed, 1))).first->second;
  }

  const PlayedDrive* played_;
};

void drives(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(0)->Arg(7001)->Arg(7002)->Arg(7003)->Unit(benchmark::kMicrosecond);
}

void RadialLines(benchmark::State& state) {
  const Drive drive(state.range(0));
  perception::RadialLineExtractor extractor(*drive.rig().camera);
  perception::Scene scene;
  std::size_t i = 0;
  for (auto _ : state) {
    extractor.extract(*drive[i].image, scene);
    i = (i + 1) % drive.size();
  }
}
BENCHMARK(RadialLines)->Apply(drives);

void Perception(benchmark::State& state) {
  const Drive drive(state.range(0));
  perception::Observer observer(drive.rig());
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(observer.observe(drive[i]));
    i = (i + 1) % drive.size();
  }
}
BENCHMARK(Perception)->Apply(drives);

/// Tracking and localization on scenes that were made beforehand.
void TrackingAndLocalization(benchmark::State& state) {
  const Drive drive(state.range(0));
  perception::Observer observer(drive.rig());
  std::vector<perception::Scene> scenes;
  for (std::size_t i = 0; i < drive.size(); ++i) scenes.push_back(observer.observe(drive[i]));
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      localizer.emplace(drive.localizer());
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(scenes[i], drive[i].motion));
    i = (i + 1) % scenes.size();
  }
}
BENCHMARK(TrackingAndLocalization)->Apply(drives);

void Acquisition(benchmark::State& state) {
  const Drive drive(state.range(0));
  std::optional<perception::Observer> observer;
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      observer.emplace(drive.rig());
      localizer.emplace(drive.localizer());
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(observer->observe(drive[i]), drive[i].motion));
    i = (i + 1) % drive.size();
  }
  state.SetLabel("must 1000, goal 300, stretch 150");
}
BENCHMARK(Acquisition)->Apply(drives);

}  // namespace
