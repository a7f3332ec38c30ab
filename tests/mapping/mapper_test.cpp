// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/mapper.hpp"

#include <gtest/gtest.h>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

TEST(Mapper, RefusesReadingsThatAreNotOfTheRig) {
  Mapper mapper(rig_with(panoramic()));
  sensors::RangeScan scan;
  scan.ranges_m.assign(359, 2.0F);
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  scan.ranges_m.push_back(2.0F);
  scan.sensor = 1;
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  scan.sensor = -1;
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  sensors::SonarSweep sweep;
  sweep.ranges_m = {1.0F};
  EXPECT_THROW(mapper.insert(certain({}), sweep), std::invalid_argument);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

TEST(Mapper, RefusesAResolutionThatDoesNotFit) {
  for (const double resolution : {0.0, -0.1, std::nan(""), 1e-6, 5e-4, 5.0}) {
    MapperParams params;
    params.georeference.resolution_m = resolution;
    EXPECT_THROW(Mapper(rig_with(panoramic()), params), std::invalid_argument) << resolution;
    EXPECT_THROW(Mapper(rig_with(one_sonar()), params), std::invalid_argument) << resolution;
  }
  sensors::RangeFinder none = panoramic();
  none.count = 0;
  EXPECT_THROW(Mapper{rig_with(none)}, std::invalid_argument);
  sensors::RangeFinder still = panoramic();
  still.angle_increment_rad = 0.0;
  EXPECT_THROW(Mapper{rig_with(still)}, std::invalid_argument);
  sensors::SonarRing times = one_sonar();
  times.firing_times_s = {0.0, 0.1};
  EXPECT_THROW(Mapper{rig_with(times)}, std::invalid_argument);
}

TEST(Mapper, TheOrderOfReadingsDoesNotMatterToTheBit) {
  sensors::Rig rig = rig_with(panoramic());
  rig.sonar_rings = {one_sonar()};
  std::vector<int> order{0, 1, 2, 3, 4, 5, 6, 7};
  const auto map = [&] {
    Mapper mapper(rig);
    for (const int k : order) {
      const Pose2 pose{1.0 + 0.4 * k, 1.2, 0.3 * k};
      if (k % 2 == 0) {
        mapper.insert(with_sigma(pose, 0.01 * k, 0.002), scan_of_room(panoramic(), pose, 6.0, 3.0));
      } else {
        sensors::SonarSweep sweep;
        sweep.ranges_m = {static_cast<float>(0.3 * k)};
        mapper.insert(certain(pose), sweep);
      }
    }
    return mapper.take_grid();
  };
  const grids::EvidentialGrid first = map();
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(map(), first);
  std::swap(order[1], order[5]);
  EXPECT_EQ(map(), first);
}

/// More tables of increments than are kept, by range and by reliability.
TEST(Mapper, IncrementsThatWereForgottenComeBackTheSame) {
  sensors::SonarRing ring = one_sonar();
  ring.range_max_m = 20.0;
  const sensors::Rig rig = rig_with(ring);
  Mapper all(rig);
  grids::EvidentialGrid one_by_one{grids::Georeference{}};
  for (int k = 0; k < 2000; ++k) {
    const auto pose = with_sigma({0.0, 0.0, 0.0}, 0.0025 * (k % 20), 0.0);
    const sensors::SonarSweep sweep{0, 0, {static_cast<float>(19.9 - 0.1 * (k / 20))}};
    all.insert(pose, sweep);
    Mapper single(rig);
    single.insert(pose, sweep);
    one_by_one.merge(single.grid());
  }
  EXPECT_EQ(all.grid(), one_by_one);
}

}  // namespace
}  // namespace credo::mapping
