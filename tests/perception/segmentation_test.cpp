// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "range_world.hpp"

namespace credo::perception {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The scanners that one set of parameters must serve.
struct Scanner {
  const char* name;
  int count;
  sensors::RangeNoise noise;
  double range_max;
};
constexpr Scanner kScanners[] = {{"laser", 720, {0.01, 0.0}, 12.0},
                                 {"good triangulation", 360, {0.004, 0.0015}, 8.0},
                                 {"coarse triangulation", 180, {0.005, 0.0045}, 6.0},
                                 {"old triangulation", 256, {0.01, 0.01}, 6.0}};

void expect_rectangle(const Segmented& result, const char* name) {
  ASSERT_EQ(result.segments.size(), 4u) << name;
  for (const RangeSegment& segment : result.segments) {
    EXPECT_EQ(segment.end_a, SegmentEnd::kJoined) << name;
    EXPECT_EQ(segment.end_b, SegmentEnd::kJoined) << name;
  }
}

TEST(Segmentation, ARoomIsFourWallsWhateverTheScanner) {
  RangeWorld world;
  world.add_room(-1.9, -1.4, 2.1, 1.6);
  for (const Scanner& scanner : kScanners) {
    const auto finder = full_turn(scanner.count, scanner.noise, scanner.range_max);
    int four = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const double turn = 0.37 * seed;
      const auto result = segment_scan(scan_of(world, finder, {0.1, 0.1, turn}, seed), finder);
      four += result.segments.size() == 4;
    }
    EXPECT_GE(four, 18) << scanner.name;
    expect_rectangle(segment_scan(scan_of(world, finder), finder), scanner.name);
  }
}

// Whichever wall the first beam meets, wherever it meets it.
TEST(Segmentation, AWallAcrossTheFirstBeamIsOneSegment) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const auto finder = full_turn(360);
  for (int step = 0; step < 72; ++step) {
    const double turn = step * std::numbers::pi / 36.0 + 0.01;
    const auto scan = scan_of(world, finder, {0.0, 0.0, turn}, 11);
    const auto result = segment_scan(scan, finder);
    expect_rectangle(result, "turned");
    for (const RangeSegment& segment : result.segments) {
      EXPECT_GT(segment.last, segment.first);
      EXPECT_LT(segment.last, static_cast<int>(result.points.size()));
    }
  }
}

TEST(Segmentation, CornersLieWhereTheLinesMeet) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const auto finder = full_turn(180);
  const auto result = segment_scan(scan_of(world, finder), finder);
  for (const RangeSegment& segment : result.segments)
    for (const Eigen::Vector2d& end : {segment.extent.a, segment.extent.b}) {
      EXPECT_NEAR(std::abs(end.x()), 2.0, 2e-3);
      EXPECT_NEAR(std::abs(end.y()), 1.5, 2e-3);
    }
}

TEST(Segmentation, StrayReadingsDoNotShatterWalls) {
  RangeWorld world;
  world.add_room(-1.9, -1.4, 2.1, 1.6);
  for (const Scanner& scanner : kScanners) {
    const auto finder = full_turn(scanner.count, scanner.noise, scanner.range_max);
    double segments = 0.0;
    for (std::uint32_t seed = 1; seed <= 30; ++seed)
      segments += static_cast<double>(segment_scan(scan_of(world, finder, {}, seed, 0.01), finder).segments.size());
    EXPECT_LT(segments / 30.0, 4.6) << scanner.name;
    EXPECT_GT(segments / 30.0, 3.8) << scanner.name;
  }
}

TEST(Segmentation, MissingBeamsDoNotShatterWalls) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const auto finder = full_turn(360);
  auto scan = scan_of(world, finder, {}, 5);
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += 13) scan.ranges_m[i] = static_cast<float>(kNan);
  expect_rectangle(segment_scan(scan, finder), "nan");
}

// 3 cm of relief is seen near by a good scanner, and is noise for a poor one far away.
TEST(Segmentation, ReliefIsSeenWhereTheNoiseAllows) {
  RangeWorld world;
  world.add(-2.0, 1.0, -0.5, 1.0);
  world.add(-0.5, 1.0, -0.5, 1.06);
  world.add(-0.5, 1.06, 0.5, 1.06);
  world.add(0.5, 1.06, 0.5, 1.0);
  world.add(0.5, 1.0, 2.0, 1.0);
  const auto good = full_turn(720, {0.004, 0.0}), poor = full_turn(256, {0.01, 0.01});
  const auto near = segment_scan(scan_of(world, good, {}, 3), good);
  EXPECT_GE(near.segments.size(), 3u);
  EXPECT_TRUE(std::any_of(near.segments.begin(), near.segments.end(), [](const RangeSegment& segment) {
    return std::abs(segment.fit.line.centroid.y() - 1.06) < 0.005 && std::abs(segment.extent.length() - 1.0) < 0.05;
  }));
  const auto far = segment_scan(scan_of(world, poor, {0.0, -2.0, 0.0}, 3), poor);
  EXPECT_EQ(far.segments.size(), 1u);
}

// A small box before a wall: neither swallowed by the wall nor dragging it along.
TEST(Segmentation, ABoxBeforeAWallIsAThingOfItsOwn) {
  RangeWorld world;
  world.add(-3.0, 2.0, 3.0, 2.0);
  world.add(0.1, 1.85, 0.4, 1.85);
  const auto finder = full_turn(360, {0.004, 0.0015});
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const auto result = segment_scan(scan_of(world, finder, {}, seed), finder);
    const auto count_at = [&](double y) {
      return std::count_if(result.segments.begin(), result.segments.end(), [y](const RangeSegment& segment) {
        return std::abs(segment.fit.line.centroid.y() - y) < 0.02;
      });
    };
    EXPECT_EQ(count_at(1.85), 1) << seed;
    EXPECT_GE(count_at(2.0), 2) << seed;
    for (const RangeSegment& segment : result.segments) EXPECT_LT(segment.extent.length(), 3.3) << seed;
  }
}

// The far corner of a room, seen by a scanner whose noise there is wider than the spacing of its points.
TEST(Segmentation, AFarCornerInTheNoiseIsStillTwoWalls) {
  RangeWorld world;
  world.add(-1.0, 4.0, 1.5, 4.0);
  world.add(1.5, 4.0, 1.5, 1.5);
  const auto finder = full_turn(256, {0.01, 0.01}, 5.0);
  int two = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed)
    two += segment_scan(scan_of(world, finder, {}, seed), finder).segments.size() == 2;
  EXPECT_GE(two, 36);
}

// A corridor wall with a recess: what ends freely, what is hidden.
TEST(Segmentation, TellsFreeEndsFromHiddenOnes) {
  RangeWorld world;
  world.add(-3.0, 1.0, 0.5, 1.0);  // ends freely at x = 0.5, seen from the left
  world.add(-3.0, 2.5, 4.0, 2.5);  // behind it, hidden up to where the view passes the end
  const auto finder = full_turn(720);
  const auto result = segment_scan(scan_of(world, finder, {}, 2), finder);
  ASSERT_EQ(result.segments.size(), 2u);
  const bool first_is_near = result.segments[0].fit.line.centroid.y() < 1.5;
  const RangeSegment& near = result.segments[first_is_near ? 0 : 1];
  const RangeSegment& far = result.segments[first_is_near ? 1 : 0];
  EXPECT_EQ(near.end_a, SegmentEnd::kFree);  // a is the clockwise end, at x = 0.5
  EXPECT_NEAR(near.extent.a.x(), 0.5, 0.02);
  EXPECT_GT(near.jump_a_sigmas, 9.0);
  EXPECT_EQ(far.end_b, SegmentEnd::kOccluded);
  EXPECT_EQ(near.end_b, SegmentEnd::kUnseen) << "where the wall leaves the scan, flat";
}

TEST(Segmentation, AnEndBesideEmptyBeamsIsOpenAndBesideMissingOnesUnseen) {
  RangeWorld world;
  world.add(-1.0, 1.0, 1.0, 1.0);
  const auto finder = full_turn(360);
  auto scan = scan_of(world, finder, {}, 2);
  auto result = segment_scan(scan, finder);
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(result.segments[0].end_a, SegmentEnd::kOpen);
  EXPECT_EQ(result.segments[0].end_b, SegmentEnd::kOpen);
  for (float& range : scan.ranges_m)
    if (std::isinf(range)) range = static_cast<float>(kNan);
  result = segment_scan(scan, finder);
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(result.segments[0].end_a, SegmentEnd::kUnseen);
  EXPECT_EQ(result.segments[0].end_b, SegmentEnd::kUnseen);
}

TEST(Segmentation, AClockwiseScannerGivesTheSameSegments) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  world.add(0.5, -0.5, 1.0, -0.5);
  const auto finder = full_turn(360);
  auto clockwise = finder;
  clockwise.angle_min_rad = -finder.angle_min_rad - finder.angle_increment_rad;
  clockwise.angle_increment_rad = -finder.angle_increment_rad;
  const auto a = segment_scan(scan_of(world, finder), finder);
  const auto b = segment_scan(scan_of(world, clockwise), clockwise);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (const RangeSegment& segment : a.segments)
    EXPECT_TRUE(std::any_of(b.segments.begin(), b.segments.end(), [&](const RangeSegment& other) {
      return (segment.extent.a - other.extent.a).norm() < 0.02 && (segment.extent.b - other.extent.b).norm() < 0.02;
    })) << segment.extent;
}

TEST(Segmentation, APartialScanDoesNotCloseItself) {
  RangeWorld world;
  world.add(-3.0, 1.0, 3.0, 1.0);
  sensors::RangeFinder finder;
  finder.count = 181;
  finder.angle_min_rad = 0.0;
  finder.angle_increment_rad = std::numbers::pi / 180.0;
  finder.range_max_m = 8.0;
  const auto result = segment_scan(scan_of(world, finder, {}, 4), finder);
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_GT(result.segments[0].extent.a.x(), 2.0) << "counter-clockwise: from the right";
}

TEST(Segmentation, TakesWhateverScanThereIs) {
  const auto finder = full_turn(360);
  sensors::RangeScan scan;
  const auto count_of = [&] { return segment_scan(scan, finder).segments.size(); };
  EXPECT_EQ(count_of(), 0u) << "no beams";
  scan.ranges_m.assign(360, static_cast<float>(kNan));
  EXPECT_EQ(count_of(), 0u) << "all nan";
  scan.ranges_m[5] = 1.0F;
  EXPECT_EQ(count_of(), 0u) << "one point";
  scan.ranges_m[6] = 1.0F;
  EXPECT_EQ(count_of(), 0u) << "two points";
  scan.ranges_m.assign(360, 1e30F);
  for (const RangeSegment& segment : segment_scan(scan, finder).segments)
    EXPECT_TRUE(segment.extent.a.allFinite() && segment.extent.b.allFinite());
  scan.ranges_m.assign(360, 1.0F);
  for (const RangeSegment& segment : segment_scan(scan, finder).segments)
    EXPECT_LT(segment.extent.length(), 1.2) << "a circle has no long straight piece";
  scan.ranges_m.assign(360, 0.0F);
  EXPECT_EQ(count_of(), 0u) << "all at the sensor";

  auto still = finder;
  still.angle_increment_rad = 0.0;
  EXPECT_EQ(segment_scan(scan, still).segments.size(), 0u);
}

TEST(Segmentation, ThePapersThresholdIsInMetres) {
  RangeWorld world;
  world.add(-2.0, 1.0, 0.0, 1.0);
  world.add(0.0, 1.0, 0.0, 1.20);
  world.add(0.0, 1.20, 2.0, 1.20);
  const auto finder = full_turn(360, {0.0001, 0.0});
  SegmentationParams params;
  params.merge_chi2 = 0.0;
  params.split_m = 0.05;
  const auto fine = segment_scan(scan_of(world, finder), finder, params);
  params.split_m = 0.40;
  const auto coarse = segment_scan(scan_of(world, finder), finder, params);
  EXPECT_GE(fine.segments.size(), 2u);
  EXPECT_EQ(coarse.segments.size(), 1u);
}

}  // namespace
}  // namespace credo::perception
