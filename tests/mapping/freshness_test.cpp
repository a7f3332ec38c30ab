// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/freshness.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

constexpr FreshnessParams kTenth{.correlation = 0.1, .way_m = 0.02, .turn_rad = 0.02, .still_m = 0.0, .still_rad = 0.0};

double next(Freshness& freshness, const Pose2& pose, int sensor = 0) {
  return freshness.of_next(sensors::SonarSweep{0, sensor, {}}, pose);
}

TEST(Freshness, OfARobotThatStandsStillAddsUpToTheInverseOfTheCorrelation) {
  Freshness freshness(kTenth);
  EXPECT_EQ(next(freshness, {}), 1.0);
  double sum = 1.0, last = 1.0;
  for (int k = 1; k < 100'000; ++k) {
    const double share = next(freshness, {});
    EXPECT_GT(share, 0.0);
    EXPECT_LE(share, last);
    last = share;
    sum += share;
  }
  EXPECT_LT(last, 1e-8);
  EXPECT_NEAR(sum, 10.0, 0.8);  // rounding to powers of a half goes both ways
}

TEST(Freshness, ComesBackWithTheWayAndWithTheTurn) {
  Freshness walking(kTenth), turning(kTenth), standing(kTenth);
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(next(walking, {}));
    static_cast<void>(next(turning, {}));
    static_cast<void>(next(standing, {}));
  }
  const double stale = next(standing, {});
  EXPECT_GT(next(walking, {0.01, 0.0, 0.0}), stale);
  EXPECT_GT(next(turning, {0.0, 0.0, -0.01}), stale);
  EXPECT_NEAR(next(walking, {1.0, 0.0, 0.0}), 1.0, 1e-9);
  EXPECT_NEAR(next(turning, {0.0, 0.0, 1.0}), 1.0, 1e-9);
}

TEST(Freshness, APoseThatJittersAtRestIsAtRestAndASlowRobotIsNot) {
  std::mt19937 random(4);
  std::normal_distribution<double> place(0.0, 0.002), turn(0.0, 0.004);
  Freshness resting, creeping;
  double at_rest = 0.0, on_its_way = 0.0;
  for (int k = 0; k < 250; ++k) {
    at_rest += next(resting, {place(random), place(random), turn(random)});
    on_its_way += next(creeping, {0.005 * k, 0.0, 0.0});  // 5 cm/s, ten times a second
  }
  EXPECT_LT(at_rest, 10.5);  // 10 but for rounding
  EXPECT_GT(on_its_way, 150.0);
}

TEST(Freshness, OfSensorsIsTheirOwn) {
  Freshness freshness(kTenth);
  static_cast<void>(next(freshness, {}));
  EXPECT_EQ(next(freshness, {}, 1), 1.0);
  EXPECT_EQ(freshness.of_next(sensors::RangeScan{0, 0, {}}, {}), 1.0);
  for (int k = 0; k < 5; ++k) static_cast<void>(next(freshness, {}, 1));
  EXPECT_LT(next(freshness, {}, 1), 1.0);
}

TEST(Freshness, CanBeOff) {
  Freshness off({.correlation = 0.0});
  for (int k = 0; k < 5; ++k) EXPECT_EQ(next(off, {}), 1.0);
}

TEST(Freshness, RefusesParametersThatAreNone) {
  for (const FreshnessParams& params :
       {FreshnessParams{.correlation = 1.0}, FreshnessParams{.correlation = -0.1}, FreshnessParams{.way_m = 0.0},
        FreshnessParams{.still_m = -1.0}, FreshnessParams{.turn_rad = std::nan("")}})
    EXPECT_THROW(Freshness{params}, std::invalid_argument);
}

TEST(FreshnessOfAMap, HoldsWhatARobotThatStandsStillCanBeSureOf) {
  const sensors::MotionPath still(std::vector<sensors::OdometryReading>{{0, {}}});
  const auto evidence_after = [&](int readings, double correlation) {
    std::vector<sensors::SonarSweep> sweeps;
    for (int k = 0; k < readings; ++k) sweeps.push_back({sensors::Timestamp{k}, 0, {1.0F}});
    TrajectoryMappingParams params;
    params.mapper.freshness.correlation = correlation;
    return weight(map_along(still, rig_with(one_sonar()), {}, sweeps, params).grid.at({10, 0}));
  };
  EXPECT_NEAR(evidence_after(100, 0.0), 100.0 * evidence_after(1, 0.0), 1e-3);
  EXPECT_GT(evidence_after(100, 0.1), evidence_after(3, 0.1));
  EXPECT_LT(evidence_after(1000, 0.1), 10.0 * evidence_after(1, 0.1));
  EXPECT_LT(evidence_after(1000, 0.1), 1.05 * evidence_after(100, 0.1));
}

}  // namespace
}  // namespace credo::mapping
