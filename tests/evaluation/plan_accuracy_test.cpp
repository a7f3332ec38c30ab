// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/plan_accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/simulated_drive.hpp"
#include "grids/wall_extraction.hpp"
#include "mapping/mapper.hpp"

namespace credo::evaluation {
namespace {

const geometry::FloorPlan kTruth{.walls = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}}, .verticals = {}};

const evidence::FixedLogCommonality kEmpty = evidence::fixed_increment(evidence::GridMass::from(0.9, 0.0), 0.95);

/// A map that saw all of the first wall and none of the second.
grids::EvidentialGrid map_beside_the_first() {
  grids::EvidentialGrid map;
  for (int x = 0; x < 76; ++x) map.add({x, 0}, kEmpty);
  return map;
}

TEST(PlanAccuracy, OfTheTruthIsPerfectWhereItWasSeen) {
  const PlanAccuracy a = plan_accuracy(kTruth, kTruth, map_beside_the_first());
  EXPECT_NEAR(a.extracted_m, 7.0, 1e-9);
  EXPECT_NEAR(a.precision(), 1.0, 1e-9);
  EXPECT_NEAR(a.seen_m, 3.9, 0.05);
  EXPECT_NEAR(a.recall(), 1.0, 1e-9);
  EXPECT_NEAR(a.mean_distance_m, 0.0, 1e-12);
}

TEST(PlanAccuracy, CountsByLength) {
  const geometry::FloorPlan half{.walls = {{{0, 0.04}, {2, 0.04}}, {{0, 1}, {1, 1}}}, .verticals = {}};
  const PlanAccuracy a = plan_accuracy(half, kTruth, map_beside_the_first());
  EXPECT_NEAR(a.precision(), 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(a.recall(), 2.1 / 3.9, 0.02);
  EXPECT_NEAR(a.mean_distance_m, 0.04, 1e-9);
}

TEST(PlanAccuracy, OfNoWallsIsNone) {
  const PlanAccuracy a = plan_accuracy({}, kTruth, map_beside_the_first());
  EXPECT_EQ(a.precision(), 0.0);
  EXPECT_EQ(a.recall(), 0.0);
  EXPECT_TRUE(std::isnan(a.mean_distance_m));
}

TEST(PlanAccuracy, RefusesAMapOfAnotherPlace) {
  grids::EvidentialGrid elsewhere;
  elsewhere.add({5000, 5000}, kEmpty);
  EXPECT_THROW((void)plan_accuracy(kTruth, kTruth, elsewhere), std::invalid_argument);
  EXPECT_THROW((void)plan_accuracy(kTruth, {}, elsewhere), std::invalid_argument);
}

/// The walls of a drive through the hall, mapped from true poses, against its plan.
TEST(PlanAccuracy, WallsOfASimulatedMapAreThoseOfThePlan) {
  sim::World world = sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/corridor_end.yaml");
  const sim::Simulation simulation(world, 1);
  const datasets::Dataset drive = readings_of(simulation);
  std::vector<sensors::OdometryReading> poses;
  for (const datasets::TimedPose& p : drive.truth) poses.push_back({p.time, p.pose});
  const grids::EvidentialGrid map =
      mapping::map_along(sensors::MotionPath(poses), drive.header.rig, drive.scans.at(0), {}).grid;
  const PlanAccuracy a = plan_accuracy(grids::extract_walls(map), drive.header.floor_plan.value(), map);
  EXPECT_GT(a.precision(), 0.9);
  EXPECT_GT(a.recall(), 0.8);
  EXPECT_LT(a.mean_distance_m, 0.03);
}

}  // namespace
}  // namespace credo::evaluation
