// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim/random.hpp"

namespace credo::evaluation {
namespace {

GatedPair pair(int track, int observation, double sigmas) {
  return {.track = track, .observation = observation, .innovation = 0.01 * sigmas, .variance = 1e-4};
}

/// Association probabilities by listing every joint event.
std::vector<double> listed(int tracks, const std::vector<GatedPair>& pairs, const JpdaParams& params) {
  std::vector<double> sums(pairs.size(), 0.0);
  double total = 0.0;
  std::vector<std::size_t> event;
  const std::function<void(int, double)> list = [&](int track, double weight) {
    if (track == tracks) {
      total += weight;
      for (const std::size_t k : event) sums[k] += weight;
      return;
    }
    list(track + 1, weight * (1.0 - params.detection_probability * params.gate_probability));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const bool taken = std::ranges::any_of(
          event, [&](std::size_t other) { return pairs[other].observation == pairs[k].observation; });
      if (pairs[k].track != track || taken) continue;
      event.push_back(k);
      const double density =
          std::exp(-0.5 * pairs[k].distance_squared()) / std::sqrt(2.0 * std::numbers::pi * pairs[k].variance);
      list(track + 1, weight * params.detection_probability * density / params.clutter_per_rad);
      event.pop_back();
    }
  };
  list(0, 1.0);
  for (double& sum : sums) sum /= total;
  return sums;
}

TEST(Association, OnlyTheNearestNeighbourGivesOneObservationToTwoTracks) {
  const std::vector<GatedPair> pairs{pair(0, 0, 0.5), pair(0, 1, 2.0), pair(1, 0, 0.4)};
  EXPECT_EQ(nearest_neighbour(2, pairs), (std::vector{0, 0}));
  EXPECT_EQ(global_nearest_neighbour(2, 2, pairs, 9.0), (std::vector{1, 0}));
}

TEST(Association, TheGlobalNearestNeighbourWouldRatherLoseATrackThanPayMoreThanTheGate) {
  const std::vector<GatedPair> pairs{pair(0, 0, 0.5), pair(0, 1, 2.95), pair(1, 0, 0.4), pair(1, 1, 3.2)};
  EXPECT_EQ(global_nearest_neighbour(2, 2, pairs, 4.0), (std::vector{-1, 0}));
}

TEST(Jpda, ProbabilitiesAreThoseOfAllJointEvents) {
  sim::Random random(2);
  for (int round = 0; round < 50; ++round) {
    const int tracks = 4, observations = 5;
    std::vector<GatedPair> pairs;
    for (int t = 0; t < tracks; ++t)
      for (int o = 0; o < observations; ++o)
        if (random.chance(0.6)) pairs.push_back(pair(t, o, random.uniform(-3.0, 3.0)));
    const JpdaParams params{.detection_probability = random.uniform(0.3, 0.95)};
    const auto fast = joint_probabilities(tracks, observations, pairs, params);
    const auto expected = listed(tracks, pairs, params);
    for (std::size_t k = 0; k < pairs.size(); ++k) EXPECT_NEAR(fast[k], expected[k], 1e-12) << round << ' ' << k;
  }
}

TEST(Jpda, AnObservationBetweenTwoTracksIsSharedAndNotDecided) {
  const std::vector<GatedPair> pairs{pair(0, 0, 1.0), pair(1, 0, -1.0)};
  const auto probabilities = joint_probabilities(2, 1, pairs);
  EXPECT_NEAR(probabilities[0], probabilities[1], 1e-12);
  EXPECT_EQ(joint_probabilistic(2, 1, pairs, 0.5), (std::vector{-1, -1}));
}

TEST(Jpda, WhatIsClearIsDecided) {
  const std::vector<GatedPair> pairs{pair(0, 0, 0.2), pair(1, 1, -0.3), pair(1, 0, 3.0)};
  for (const double at_least : {0.0, 0.5}) EXPECT_EQ(joint_probabilistic(2, 2, pairs, at_least), (std::vector{0, 1}));
}

TEST(Jpda, ManyTracksInARowStayQuickAndSumToAtMostOne) {
  std::vector<GatedPair> pairs;
  const int tracks = 80;
  for (int t = 0; t < tracks; ++t)
    for (int o = std::max(0, t - 2); o <= std::min(tracks - 1, t + 2); ++o) pairs.push_back(pair(t, o, 0.8 * (t - o)));
  const auto probabilities = joint_probabilities(tracks, tracks, pairs);
  std::vector<double> by_track(tracks, 0.0), by_observation(tracks, 0.0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    by_track[static_cast<std::size_t>(pairs[k].track)] += probabilities[k];
    by_observation[static_cast<std::size_t>(pairs[k].observation)] += probabilities[k];
  }
  EXPECT_LE(*std::ranges::max_element(by_track), 1.0 + 1e-9);
  EXPECT_LE(*std::ranges::max_element(by_observation), 1.0 + 1e-9);
  EXPECT_GT(*std::ranges::min_element(by_track), 0.5);
}

TEST(Jpda, WithoutPairsNothingIsMatched) {
  EXPECT_EQ(joint_probabilistic(2, 3, {}, 0.5), (std::vector{-1, -1}));
  EXPECT_TRUE(joint_probabilities(0, 0, {}).empty());
}

}  // namespace
}  // namespace credo::evaluation
