// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/cooperation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.hpp"
#include "range_world.hpp"

namespace credo::perception {
namespace {

using geometry::to_radians;

/// A wall y = 1 from x = -1 to x = 1 that ends freely, another one far behind it.
class CooperationTest : public ::testing::Test {
 protected:
  CooperationTest() {
    world_.add(-1.0, 1.0, 1.0, 1.0);
    world_.add(-6.0, 3.0, 6.0, 3.0);
    finder_ = full_turn(360);
    scan_ = segment_scan(scan_of(world_, finder_), finder_);
    for (std::size_t i = 0; i < scan_.segments.size(); ++i)
      if (scan_.segments[i].fit.line.centroid.y() < 2.0) near_ = i;
  }

  static RadialLine line_to(const Eigen::Vector2d& point, const Eigen::Vector2d& origin = {0.0, 0.0}) {
    return {.azimuth = std::atan2(point.y() - origin.y(), point.x() - origin.x()),
            .sigma = 0.002,
            .contrast = 40.0,
            .polarity = 1,
            .visible_share = 0.8};
  }

  Cooperation run(const std::vector<RadialLine>& lines, const Eigen::Vector2d& origin = {0.0, 0.0},
                  const CooperationParams& params = {}) {
    Cooperation result;
    cooperate(lines, origin, scan_.points, to_radians(1.0), params, scan_.segments, result);
    return result;
  }

  RangeWorld world_;
  sensors::RangeFinder finder_;
  Segmented scan_;
  std::size_t near_ = 0;
};

TEST_F(CooperationTest, TheRangeFindersEndStandsAlone) {
  const geometry::Segment before = scan_.segments[near_].extent;
  const Cooperation result = run({});
  EXPECT_EQ(result.ends[near_][0].radial_line, -1);
  EXPECT_EQ(result.ends[near_][1].radial_line, -1);
  EXPECT_TRUE(result.cuts.empty());
  EXPECT_EQ(scan_.segments[near_].extent, before);
}

TEST_F(CooperationTest, ABearingThroughASegmentCutsIt) {
  const Cooperation result = run({line_to({-0.3, 1.0}), line_to({0.4, 1.0})});
  ASSERT_EQ(result.cuts.size(), 2u);
  // Counter-clockwise: from the right to the left.
  EXPECT_EQ(result.cuts[0].radial_line, 1);
  EXPECT_NEAR(result.cuts[0].position.x(), 0.4, 1e-3);
  EXPECT_NEAR(result.cuts[1].position.x(), -0.3, 1e-3);
  for (const SegmentCut& cut : result.cuts) {
    EXPECT_EQ(cut.segment, static_cast<int>(near_));
    const auto x = [&](int i) { return scan_.points[static_cast<std::size_t>(i)].position.x(); };
    EXPECT_LE(x(cut.first_point), cut.position.x());
    EXPECT_GE(x(cut.first_point - 1), cut.position.x());
  }
}

TEST_F(CooperationTest, WhereBothAgreeTheBearingPlacesTheEnd) {
  const Cooperation result = run({line_to({1.0, 1.0})});
  ASSERT_EQ(result.ends[near_][0].radial_line, 0);
  EXPECT_TRUE(result.cuts.empty());
  EXPECT_NEAR(scan_.segments[near_].extent.a.x(), 1.0, 1e-4) << "not to half a beam";
  EXPECT_EQ(result.uses[0].segment, static_cast<int>(near_));
  EXPECT_TRUE(result.uses[0].at_a);
}

TEST_F(CooperationTest, TheCameraNeedNotBeWhereTheRangeFinderIs) {
  const Eigen::Vector2d camera(0.2, -0.3);
  const Cooperation result = run({line_to({1.0, 1.0}, camera), line_to({0.1, 1.0}, camera)}, camera);
  EXPECT_EQ(result.ends[near_][0].radial_line, 0);
  EXPECT_NEAR(scan_.segments[near_].extent.a.x(), 1.0, 1e-4);
  ASSERT_EQ(result.cuts.size(), 1u);
  EXPECT_NEAR(result.cuts[0].position.x(), 0.1, 1e-3);
}

TEST_F(CooperationTest, OfTwoBearingsTheNearerOneIsTheEnd) {
  const Cooperation result = run({line_to({0.985, 1.0}), line_to({0.999, 1.0})});
  EXPECT_EQ(result.ends[near_][0].radial_line, 1);
  ASSERT_EQ(result.cuts.size(), 1u);
  EXPECT_EQ(result.cuts[0].radial_line, 0);
}

TEST_F(CooperationTest, ABearingIntoTheOpenMeetsNothing) {
  const Cooperation result = run({line_to({0.0, -1.0})});
  EXPECT_EQ(result.uses[0].segment, -1);
  EXPECT_TRUE(result.cuts.empty());
}

TEST_F(CooperationTest, ABearingMeetsTheNearerOfTwoSegments) {
  const Cooperation result = run({line_to({0.2, 1.0})});
  ASSERT_EQ(result.cuts.size(), 1u);
  EXPECT_EQ(result.cuts[0].segment, static_cast<int>(near_));
}

TEST_F(CooperationTest, ThePapersToleranceIsAnAngle) {
  CooperationParams paper;
  paper.agree_rad = to_radians(1.0);
  const Eigen::Vector2d place = scan_.segments[near_].extent.a;
  const double end = std::atan2(place.y(), place.x());
  RadialLine inside = line_to({1.0, 1.0}), outside = inside;
  inside.azimuth = end + to_radians(0.8);
  outside.azimuth = end + to_radians(2.0);
  EXPECT_EQ(run({inside}, {0.0, 0.0}, paper).ends[near_][0].radial_line, 0);
  const Cooperation result = run({outside}, {0.0, 0.0}, paper);
  EXPECT_EQ(result.ends[near_][0].radial_line, -1);
  EXPECT_EQ(result.cuts.size(), 1u);
}

TEST(EndpointCase, CountsWhatTheCameraSaw) {
  using enum EndpointSource;
  EXPECT_EQ(endpoint_case(kRangeFinder, kRangeFinder), 1);
  EXPECT_EQ(endpoint_case(kRangeFinder, kCamera), 2);
  EXPECT_EQ(endpoint_case(kCamera, kCamera), 3);
  EXPECT_EQ(endpoint_case(kBoth, kRangeFinder), 3);
  EXPECT_EQ(endpoint_case(kBoth, kCamera), 4);
  EXPECT_EQ(endpoint_case(kBoth, kBoth), 5);
}

}  // namespace
}  // namespace credo::perception
