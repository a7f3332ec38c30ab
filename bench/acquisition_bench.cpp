// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// One acquisition by stage, on one core: a decoded 640x480 image and a scan in memory, no file reading. The drive is
// the office world, simulated once. Goals for the whole: 3 ms (must), 0.3 ms (goal), 0.15 ms (stretch).

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "localization/localizer.hpp"
#include "perception/observer.hpp"
#include "sim/simulation.hpp"

namespace {

using namespace credo;

/// The drive of a world as acquisitions.
struct Drive {
  sensors::Rig rig;
  geometry::FloorPlan plan;
  std::optional<geometry::PoseEstimate> initial_pose;
  std::vector<sensors::Acquisition> acquisitions;
};

Drive simulate(const std::string& world) {
  const sim::Simulation simulation(sim::load_world(std::string(CREDO_SOURCE_DIR) + "/sim/worlds/" + world + ".yaml"),
                                   1);
  std::vector<sensors::OmniImage> images;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::OdometryReading> odometry;
  sim::Sink sink;
  sink.image = [&](const sensors::OmniImage& image) { images.push_back({image.time, image.pixels.clone()}); };
  sink.scan = [&](const sensors::RangeScan& scan) { scans.push_back(scan); };
  sink.odometry = [&](const sensors::OdometryReading& reading) { odometry.push_back(reading); };
  simulation.run(sink, 2);

  Drive drive{simulation.rig(), simulation.floor_plan(), simulation.initial_pose(), {}};
  const sensors::MotionPath path(odometry);
  for (std::size_t i = 0; i < images.size(); ++i) {
    sensors::Acquisition acquisition;
    acquisition.time = images[i].time;
    acquisition.image = images[i];
    const auto nearest = std::min_element(scans.begin(), scans.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.time - images[i].time) < std::abs(b.time - images[i].time);
    });
    if (nearest != scans.end()) acquisition.scan = *nearest;
    acquisition.path = path;
    if (i > 0 && drive.rig.odometry)
      acquisition.motion = drive.rig.odometry->with_covariance(path.motion(images[i - 1].time, images[i].time));
    drive.acquisitions.push_back(std::move(acquisition));
  }
  return drive;
}

const Drive& office() {
  static const Drive drive = simulate("office");
  return drive;
}

void RadialLines(benchmark::State& state) {
  const Drive& drive = office();
  perception::RadialLineExtractor extractor(*drive.rig.camera);
  perception::Scene scene;
  std::size_t i = 0;
  for (auto _ : state) {
    extractor.extract(*drive.acquisitions[i].image, scene);
    i = (i + 1) % drive.acquisitions.size();
  }
}
BENCHMARK(RadialLines)->Unit(benchmark::kMicrosecond);

void Perception(benchmark::State& state) {
  const Drive& drive = office();
  perception::Observer observer(drive.rig);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(observer.observe(drive.acquisitions[i]));
    i = (i + 1) % drive.acquisitions.size();
  }
}
BENCHMARK(Perception)->Unit(benchmark::kMicrosecond);

/// Tracking and localization on scenes that were made beforehand.
void TrackingAndLocalization(benchmark::State& state) {
  const Drive& drive = office();
  perception::Observer observer(drive.rig);
  std::vector<perception::Scene> scenes;
  for (const sensors::Acquisition& acquisition : drive.acquisitions) scenes.push_back(observer.observe(acquisition));
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      localizer.emplace(drive.plan, drive.rig, drive.initial_pose);
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(scenes[i], drive.acquisitions[i].motion));
    i = (i + 1) % scenes.size();
  }
}
BENCHMARK(TrackingAndLocalization)->Unit(benchmark::kMicrosecond);

void Acquisition(benchmark::State& state) {
  const Drive& drive = office();
  std::optional<perception::Observer> observer;
  std::optional<localization::Localizer> localizer;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == 0) {
      state.PauseTiming();
      observer.emplace(drive.rig);
      localizer.emplace(drive.plan, drive.rig, drive.initial_pose);
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(localizer->update(observer->observe(drive.acquisitions[i]), drive.acquisitions[i].motion));
    i = (i + 1) % drive.acquisitions.size();
  }
  state.SetLabel("must 3000, goal 300, stretch 150");
}
BENCHMARK(Acquisition)->Unit(benchmark::kMicrosecond);

}  // namespace
