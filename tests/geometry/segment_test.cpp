// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/segment.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/geometry/any_number.hpp"

namespace credo::geometry {
namespace {

Eigen::Vector2d any_point() { return {any_number(), any_number()}; }

TEST(SegmentDistance, IsMeasuredToTheNearestPoint) {
  const Segment segment{{0.0, 0.0}, {4.0, 0.0}};
  EXPECT_DOUBLE_EQ(distance({2.0, 3.0}, segment), 3.0);
  EXPECT_DOUBLE_EQ(distance({-3.0, 4.0}, segment), 5.0);
  EXPECT_DOUBLE_EQ(distance({7.0, -4.0}, segment), 5.0);
  EXPECT_DOUBLE_EQ(distance({3.0, 4.0}, Segment{}), 5.0);
}

RC_GTEST_PROP(SegmentDistance, IsTheLeastOverItsPoints, ()) {
  const Segment segment{any_point(), any_point()};
  const Eigen::Vector2d p = any_point();
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i <= 1000; ++i)
    least = std::min(least, (p - segment.a - i / 1000.0 * (segment.b - segment.a)).norm());
  RC_ASSERT(distance(p, segment) <= least + 1e-9);
  RC_ASSERT(distance(p, segment) >= least - segment.length() / 1000.0);
}

RC_GTEST_PROP(SegmentDistance, IsTheSameInEveryFrame, ()) {
  const Pose2 T{any_number(), any_number(), any_number()};
  const Segment segment{any_point(), any_point()};
  const Eigen::Vector2d p = any_point();
  RC_ASSERT(std::abs(distance(T * p, T * segment) - distance(p, segment)) < 1e-9);
  RC_ASSERT(std::abs((T * segment).length() - segment.length()) < 1e-9);
}

TEST(Segment, NormalStandsToTheLeftOfItsDirection) {
  const Segment segment{{1.0, 1.0}, {1.0, 5.0}};
  EXPECT_EQ(segment.direction(), Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(segment.normal(), Eigen::Vector2d(-1.0, 0.0));
  EXPECT_EQ(segment.centre(), Eigen::Vector2d(1.0, 3.0));
}

}  // namespace
}  // namespace credo::geometry
