// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/contributed_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using testing::HasSubstr;
using testing::ThrowsMessage;

/// What a robot sees of a room on its way along a wall, a scan a second.
std::vector<sensors::RangeScan> scans_of(double y) {
  std::vector<sensors::RangeScan> scans;
  for (int k = 0; k < 8; ++k) {
    scans.push_back(scan_of_room(panoramic(), {1.0 + 0.4 * k, y, 0.0}, 6.0, 3.0));
    scans.back().time = sensors::from_seconds(k);
  }
  return scans;
}

grids::EvidentialGrid map_of(double y, std::span<const sensors::RangeScan> scans) {
  std::vector<sensors::OdometryReading> way;
  for (int k = 0; k < 8; ++k) way.push_back({sensors::from_seconds(k), {1.0 + 0.4 * k, y, 0.0}});
  return map_along(sensors::MotionPath(way), rig_with(panoramic()), scans, {}).grid;
}

grids::EvidentialGrid map_of(double y) { return map_of(y, scans_of(y)); }

TEST(ContributedMap, OneOfThreeRobotsIsTakenOutToTheBit) {
  const grids::EvidentialGrid first = map_of(0.5), second = map_of(1.5), third = map_of(2.5);
  ContributedMap map;
  map.add("first", first);
  map.add("second", second);
  map.add("third", third);
  EXPECT_EQ(map.take_out("second"), second);
  grids::EvidentialGrid without;
  without.merge(third);
  without.merge(first);
  EXPECT_EQ(map.whole(), without);
  map.add("second", second);
  EXPECT_EQ(map.take_out("first"), first);
  EXPECT_EQ(map.take_out("third"), third);
  EXPECT_EQ(map.whole(), second);
  EXPECT_EQ(map.take_out("second"), second);
  EXPECT_TRUE(map.whole().tiles().empty());
}

TEST(ContributedMap, APeriodOfADriveIsTakenOutToTheBit) {
  const std::vector<sensors::RangeScan> scans = scans_of(1.5);
  const auto part = [&](double from_s, double until_s) {
    const Period period{sensors::from_seconds(from_s), sensors::from_seconds(until_s)};
    return map_of(1.5, during(period, std::span(scans)));
  };
  ContributedMap map;
  map.add("before", part(0.0, 3.0));
  map.add("door open", part(3.0, 5.0));
  map.add("after", part(5.0, 8.0));
  EXPECT_EQ(map.whole(), map_of(1.5));
  static_cast<void>(map.take_out("door open"));
  grids::EvidentialGrid rest = part(0.0, 3.0);
  rest.merge(part(5.0, 8.0));
  EXPECT_EQ(map.whole(), rest);
}

TEST(ContributedMap, WhatComesInPartsGoesAsOne) {
  ContributedMap map;
  map.add("robot", map_of(0.5));
  map.add("other", map_of(2.5));
  map.add("robot", map_of(1.5));
  EXPECT_EQ(map.contributions().size(), 2u);
  static_cast<void>(map.take_out("robot"));
  EXPECT_EQ(map.whole(), map_of(2.5));
}

TEST(ContributedMap, IsExactWhereCellsHaveReachedTheirFloor) {
  constexpr std::int32_t kMuch = FixedLogCommonality::kFloor / 2 - 1;
  grids::EvidentialGrid much, more, little;
  much.add({0, 0}, {0, kMuch, kMuch});
  more.add({0, 0}, {0, kMuch, kMuch});
  little.add({0, 0}, {-5, -7, -11});
  ContributedMap map;
  map.add("much", much);
  map.add("more", more);
  map.add("little", little);
  ASSERT_FALSE(map.whole().saturated_tiles().empty());
  static_cast<void>(map.take_out("much"));
  more.merge(little);
  EXPECT_EQ(map.whole(), more);
}

TEST(ContributedMap, SaysWhoContributedWhenAskedForAnother) {
  ContributedMap map;
  EXPECT_THAT([&] { map.take_out("ann"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("none")));
  map.add("ann", {});
  map.add("bob", {});
  EXPECT_THAT([&] { map.take_out("eve"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("'eve'")));
  EXPECT_THAT([&] { map.take_out("eve"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("ann, bob")));
  EXPECT_THROW(map.add("eve", grids::EvidentialGrid({.resolution_m = 0.1})), std::invalid_argument);
  EXPECT_EQ(map.contributions().size(), 2u);
}

}  // namespace
}  // namespace credo::mapping
