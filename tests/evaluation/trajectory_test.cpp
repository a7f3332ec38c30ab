// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/trajectory.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace credo::evaluation {
namespace {

TEST(Trajectory, IsReadUnderTheNameOfItsFile) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("named.tum", "1.5 1 2 0 0 0 0 1\n2.5 1 2 3 0 0 0 1\n");
  const Trajectory t = read_trajectory(file);
  EXPECT_EQ(t.name, file.string());
  EXPECT_TRUE(t.timed);
  EXPECT_EQ(t.poses.at(1).time, 2'500'000'000);
  EXPECT_FALSE(is_planar(t));
}

TEST(TrajectoryFacts, CountWhatIsWrong) {
  Trajectory t;
  for (const auto& [ns, x] : {std::pair{0, 0.0}, {1'000'000'000, 3.0}, {1'000'000'000, 3.0}, {500'000'000, 4.0}}) {
    t.poses.push_back(lift(ns, {x, 0, 0}));
  }
  const TrajectoryFacts f = facts(t);
  EXPECT_EQ(f.poses, 4);
  EXPECT_DOUBLE_EQ(f.length_m, 4.0);
  EXPECT_DOUBLE_EQ(f.duration_s, 1.0);
  EXPECT_EQ(f.times_going_back, 1);
  EXPECT_EQ(f.equal_times, 1);
  EXPECT_DOUBLE_EQ(f.longest_gap_s, 1.0);
}

TEST(Relative, IsTheMotionBetweenTwoPoses) {
  const geometry::Pose2 a{1, 2, 0.7}, b{-3, 1, -2.0};
  const geometry::Pose2 expected = a.inverse() * b, actual = flatten(relative(lift(0, a), lift(0, b)));
  EXPECT_NEAR(actual.x, expected.x, 1e-12);
  EXPECT_NEAR(actual.y, expected.y, 1e-12);
  EXPECT_NEAR(geometry::angle_difference(actual.theta, expected.theta), 0.0, 1e-12);
}

}  // namespace
}  // namespace credo::evaluation
