// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/association.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace credo::evaluation {
namespace {

Trajectory at_times(std::string name, const std::vector<double>& seconds) {
  Trajectory result{.name = std::move(name)};
  for (const double t : seconds) result.poses.push_back(lift(sensors::from_seconds(t), {t, 0, 0}));
  return result;
}

std::vector<std::pair<double, double>> matched(const AssociatedPair& pair) {
  std::vector<std::pair<double, double>> result;
  for (std::size_t i = 0; i < pair.estimate.poses.size(); ++i) {
    result.emplace_back(pair.reference.poses[i].position.x(), pair.estimate.poses[i].position.x());
  }
  return result;
}

using Matches = std::vector<std::pair<double, double>>;

TEST(Association, TakesTheNearestWithinTheLimit) {
  const auto reference = at_times("ref", {0.0, 0.1, 0.2, 0.3, 0.4});
  const auto estimate = at_times("est", {0.004, 0.195, 0.35});
  const auto pair = associate(reference, estimate);
  EXPECT_EQ(matched(pair), (Matches{{0.0, 0.004}, {0.2, 0.195}}));
  EXPECT_EQ(pair.possible, 3);
}

TEST(Association, IncludesTheLimitItself) {
  EXPECT_EQ(matched(associate(at_times("r", {1.0, 2.0}), at_times("e", {1.01, 2.010000001}))), (Matches{{1.0, 1.01}}));
}

TEST(Association, IsOneToOneAndTheNearestWins) {
  const auto pair = associate(at_times("ref", {0.0, 1.0, 2.0}), at_times("est", {0.006, 0.002}));
  EXPECT_EQ(matched(pair), (Matches{{0.0, 0.002}}));
}

TEST(Association, DoesNotCareWhichIsLonger) {
  const auto a = at_times("a", {0.0, 0.5, 1.0, 1.5}), b = at_times("b", {0.501, 1.499});
  EXPECT_EQ(matched(associate(a, b)), (Matches{{0.5, 0.501}, {1.5, 1.499}}));
  EXPECT_EQ(matched(associate(b, a)), (Matches{{0.501, 0.5}, {1.499, 1.5}}));
}

TEST(Association, AddsTheOffsetToTheEstimate) {
  const AssociationParams params{.t_offset_s = 10.0};
  EXPECT_EQ(matched(associate(at_times("r", {10.0, 11.0, 12.0}), at_times("e", {1.0, 2.0}), params)),
            (Matches{{11.0, 1.0}, {12.0, 2.0}}));
  EXPECT_EQ(matched(associate(at_times("r", {11.0}), at_times("e", {1.0, 2.0}), params)), (Matches{{11.0, 1.0}}));
}

TEST(Association, FindsRowsThatAreOutOfOrder) {
  EXPECT_EQ(matched(associate(at_times("r", {2.0, 0.0, 1.0}), at_times("e", {1.0, 2.0}))), (Matches{{1, 1}, {2, 2}}));
}

TEST(Association, InterpolatesTheReferenceWhereAsked) {
  const auto pair = associate(at_times("r", {0.0, 1.0, 2.0}), at_times("e", {0.25, 1.75, 2.5}), {.interpolate = true});
  ASSERT_EQ(pair.estimate.poses.size(), 2u);
  EXPECT_NEAR(pair.reference.poses[0].position.x(), 0.25, 1e-12);
  EXPECT_NEAR(pair.reference.poses[1].position.x(), 1.75, 1e-12);
}

TEST(Association, SaysWhatToDoWhenNothingMatches) {
  EXPECT_THAT([] { (void)associate(at_times("r", {0.0}), at_times("e", {5.0})); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("--t_max_diff")));
}

TEST(Association, MatchesRowByRowWithoutTimes) {
  auto a = at_times("a", {0.0, 1.0}), b = at_times("b", {5.0, 9.0}), c = at_times("c", {1.0});
  b.timed = false;
  EXPECT_EQ(matched(associate(a, b)), (Matches{{0, 5}, {1, 9}}));
  EXPECT_THROW((void)associate(c, b), std::runtime_error);
  for (const double bad : {std::nan(""), 1e300, -1e300}) {
    EXPECT_THROW((void)associate(b, b, {.t_offset_s = bad}), std::invalid_argument) << bad;
    EXPECT_THROW((void)associate(b, b, {.t_max_diff_s = bad}), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace credo::evaluation
