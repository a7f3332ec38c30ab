// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// The memory of the loop, by operator new: all is taken with the first acquisition of a drive, but for what the graph
// library takes. A program of its own, as it replaces the global operator new.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "evaluation/played_drive.hpp"
#include "localization/localizer.hpp"
#include "perception/observer.hpp"
#include "tests/support/counted_new.hpp"

namespace credo {
namespace {

/// What the stages of the loop allocate, by acquisition.
struct Allocations {
  std::vector<int> observing, localizing;
};

Allocations count_allocations(const evaluation::PlayedDrive& drive) {
  const datasets::DatasetHeader& robot = drive.dataset.header;
  perception::Observer observer(robot.rig);
  localization::Localizer localizer(robot.floor_plan.value(), robot.rig, robot.initial_pose);
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
  const evaluation::PlayedDrive drive =
      evaluation::play(sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/corridor_end.yaml"), 1);
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
