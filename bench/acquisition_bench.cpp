// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// One acquisition by stage, on one core: a decoded 640x480 image and a scan in memory, no file reading. The drive is
// the office world, simulated once. Goals for the whole: 3 ms (must), 0.3 ms (goal), 0.15 ms (stretch).

#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <vector>

#include "evaluation/played_drive.hpp"
#include "localization/localizer.hpp"
#include "perception/observer.hpp"

namespace {

using namespace credo;

const evaluation::PlayedDrive& office() {
  static const evaluation::PlayedDrive drive =
      evaluation::play(sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/office.yaml"), 1);
  return drive;
}

const datasets::DatasetHeader& robot() { return office().dataset.header; }

/// A localizer that has seen nothing.
localization::Localizer at_the_start() { return {robot().floor_plan.value(), robot().rig, robot().initial_pose}; }

void RadialLines(benchmark::State& state) {
  const evaluation::PlayedDrive& drive = office();
  perception::RadialLineExtractor extractor(*robot().rig.camera);
  perception::Scene scene;
  std::size_t i = 0;
  for (auto _ : state) {
    extractor.extract(*drive.acquisitions[i].image, scene);
    i = (i + 1) % drive.acquisitions.size();
  }
}
BENCHMARK(RadialLines)->Unit(benchmark::kMicrosecond);

void Perception(benchmark::State& state) {
  const evaluation::PlayedDrive& drive = office();
  perception::Observer observer(robot().rig);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(observer.observe(drive.acquisitions[i]));
    i = (i + 1) % drive.acquisitions.size();
  }
}
BENCHMARK(Perception)->Unit(benchmark::kMicrosecond);

/// Tracking and localization on scenes that were made beforehand.
void TrackingAndLocalization(benchmark::State& state) {
  const evaluation::PlayedDrive& drive = office();
  perception::Observer observer(robot().rig);
  std::vector<perception::Scene> scenes;
  for (const sensors::Acquisition& acquisition : drive.acquisitions) scenes.push_back(observer.observe(acquisition));
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      localizer.emplace(at_the_start());
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(scenes[i], drive.acquisitions[i].motion));
    i = (i + 1) % scenes.size();
  }
}
BENCHMARK(TrackingAndLocalization)->Unit(benchmark::kMicrosecond);

void Acquisition(benchmark::State& state) {
  const evaluation::PlayedDrive& drive = office();
  std::optional<perception::Observer> observer;
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      observer.emplace(robot().rig);
      localizer.emplace(at_the_start());
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(observer->observe(drive.acquisitions[i]), drive.acquisitions[i].motion));
    i = (i + 1) % drive.acquisitions.size();
  }
  state.SetLabel("must 3000, goal 300, stretch 150");
}
BENCHMARK(Acquisition)->Unit(benchmark::kMicrosecond);

}  // namespace
