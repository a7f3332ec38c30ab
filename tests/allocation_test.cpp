// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// The memory of the loop, by operator new: all is taken with the first acquisition of a drive, but for what the graph
// library takes. A program of its own, as it replaces the global operator new.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "localization/localizer.hpp"
#include "perception/observer.hpp"
#include "sim/simulation.hpp"
#include "tests/support/counted_new.hpp"

namespace credo {
namespace {

/// A drive in memory, images decoded.
struct Drive {
  sensors::Rig rig;
  geometry::FloorPlan plan;
  std::optional<geometry::PoseEstimate> initial_pose;
  std::vector<sensors::Acquisition> acquisitions;
};

const sensors::RangeScan& nearest(const std::vector<sensors::RangeScan>& scans, sensors::Timestamp time) {
  return *std::min_element(scans.begin(), scans.end(), [time](const auto& a, const auto& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

Drive simulate(const char* world) {
  const sim::Simulation simulation(sim::load_world(std::string(CREDO_SOURCE_DIR "/sim/worlds/") + world + ".yaml"), 1);
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
  for (const sensors::OmniImage& image : images) {
    sensors::Acquisition& acquisition = drive.acquisitions.emplace_back();
    acquisition.time = image.time;
    acquisition.image = image;
    acquisition.scan = nearest(scans, image.time);
    acquisition.path = path;
    if (drive.acquisitions.size() > 1 && drive.rig.odometry) {
      const sensors::Timestamp before = drive.acquisitions[drive.acquisitions.size() - 2].time;
      acquisition.motion = drive.rig.odometry->with_covariance(path.motion(before, image.time));
    }
  }
  return drive;
}

/// What the stages of the loop allocate, by acquisition.
struct Allocations {
  std::vector<int> observing, localizing;
};

Allocations count_allocations(const Drive& drive) {
  perception::Observer observer(drive.rig);
  localization::Localizer localizer(drive.plan, drive.rig, drive.initial_pose);
  Allocations result;
  const auto counted = [](auto&& stage) {
    const int before = testing::allocations();
    stage();
    return testing::allocations() - before;
  };
  for (const sensors::Acquisition& acquisition : drive.acquisitions) {
    const perception::Scene* scene = nullptr;
    const int observing = counted([&] { scene = &observer.observe(acquisition); });
    const int localizing = counted([&] { static_cast<void>(localizer.update(*scene, acquisition.motion)); });
    result.observing.push_back(observing);
    result.localizing.push_back(localizing);
  }
  result.observing.erase(result.observing.begin());
  result.localizing.erase(result.localizing.begin());
  return result;
}

TEST(Allocation, OfTheLoopEndsWithTheFirstAcquisition) {
  const Drive drive = simulate("corridor_end");
  ASSERT_GT(drive.acquisitions.size(), 20U);
  const Allocations found = count_allocations(drive);
  EXPECT_THAT(found.observing, ::testing::Each(0));
  // Where many tracks compete for many primitives the graph library is asked, and that allocates: seldom.
  const auto allocating = std::count_if(found.localizing.begin(), found.localizing.end(), [](int n) { return n > 0; });
  EXPECT_LE(allocating, static_cast<std::ptrdiff_t>(found.localizing.size() / 5))
      << ::testing::PrintToString(found.localizing);
}

}  // namespace
}  // namespace credo
