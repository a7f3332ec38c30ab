// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/change_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mapping/readings.hpp"

namespace credo::evaluation {
namespace {

using namespace mapping::test;  // NOLINT: the helpers of these tests

constexpr sensors::Timestamp kStep = 200'000'000;

/// Empty up to x = width, walls of one cell around it, unknown beyond.
datasets::OccupancyMap room(double width) {
  datasets::OccupancyMap map{.width = 120, .height = 80, .resolution_m = 0.05, .cells = {}};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double at = (x + 0.5) * map.resolution_m;
      const bool along = y == 0 || y == map.height - 1;
      map.cells.push_back(at > width + map.resolution_m ? -1 : along || at > width ? 100 : 0);
    }
  return map;
}

/// A robot in a room of 5 m x 4 m whose wall comes to x = 3 m after ten seconds, and goes back after twenty.
struct MovingWall {
  sensors::Rig rig = rig_with(panoramic());
  sensors::MotionPath path;
  std::vector<sensors::RangeScan> scans;
  std::vector<datasets::TruthState> states{{0, room(5.0)}, {50 * kStep, room(3.0)}, {100 * kStep, room(5.0)}};

  MovingWall() {
    std::vector<sensors::OdometryReading> rows;
    for (int step = 0; step < 150; ++step) {
      const Pose2 pose{1.0 + 0.005 * step, 2.0, 0.01 * step};
      rows.push_back({step * kStep, pose});
      const double width = step >= 50 && step < 100 ? 3.02 : 5.02;
      scans.push_back(scan_of_room(rig.range_finders[0], pose, width, 4.0));
      scans.back().time = step * kStep;
    }
    path = sensors::MotionPath(std::move(rows));
  }
  [[nodiscard]] ChangeScore score(const mapping::MapRule& rule) const {
    return change_score(path, rig, scans, states, {}, rule);
  }
};

TEST(ChangeScore, ARuleForAWorldThatChangesFollowsAndASumDoesNot) {
  const MovingWall world;
  const ChangeScore changing = world.score(mapping::ChangingFold{});
  EXPECT_GT(changing.changed_5, 60);
  EXPECT_GT(changing.followed_5(), 0.95);
  EXPECT_LT(changing.wrong_share(), 0.03);
  EXPECT_LT(world.score(grids::ReadOut::kDempster).followed_5(), 0.6);
}

/// The same from one place: the score is of the map that map_along makes, where readings at rest count less and less.
TEST(ChangeScore, IsOfTheMapThatTheUserGets) {
  MovingWall world;
  const Pose2 here{1.0, 2.0, 0.0};
  std::vector<sensors::OdometryReading> rows = world.path.rows();
  for (sensors::OdometryReading& row : rows) row.T_odom_base = here;
  world.path = sensors::MotionPath(std::move(rows));
  for (std::size_t step = 0; step < world.scans.size(); ++step)
    world.scans[step].ranges_m =
        scan_of_room(world.rig.range_finders[0], here, step >= 50 && step < 100 ? 3.02 : 5.02, 4.0).ranges_m;
  for (const char* name : {"changing", "pcr2", "dsmh"})
    EXPECT_GT(world.score(mapping::map_rule(name).rule).followed_5(), 0.95) << name;

  mapping::TrajectoryMappingParams halves;
  halves.mapper.freshness.correlation = 0.5;  // in the end a sum sees nothing more, and no cell counts as seen
  const ChangeScore sum =
      change_score(world.path, world.rig, world.scans, world.states, halves, mapping::MapRule{mapping::DempsterFold{}});
  EXPECT_EQ(sum.changed_5, 0);
}

TEST(ChangeScore, WhereNothingChangedThereIsNoShareOfIt) {
  MovingWall world;
  world.states.resize(1);
  const ChangeScore score = world.score(mapping::Pcr2Fold{});
  EXPECT_EQ(score.changed_5, 0);
  EXPECT_TRUE(std::isnan(score.followed_3()));
  EXPECT_TRUE(std::isnan(score.followed_5()));
  EXPECT_GT(score.unchanged, 0);
  EXPECT_FALSE(std::isnan(score.wrong_share()));
}

TEST(ChangeScore, TellsWhatIsSaidToHaveChangedAndHasNot) {
  MovingWall world;
  EXPECT_LT(world.score(mapping::ChangingFold{}).said_changed_share(), 0.05);
  world.states.resize(1);  // as if the wall had never moved
  const ChangeScore told = world.score(mapping::ChangingFold{});
  EXPECT_GT(told.said_changed, 60);
  EXPECT_LE(told.said_changed, told.unchanged);
  EXPECT_EQ(world.score(mapping::Pcr2Fold{}).said_changed, 0);  // keeps no account of changes
}

TEST(ChangeScore, WithoutAStateNothingCanBeSaid) {
  const MovingWall world;
  EXPECT_THROW(static_cast<void>(change_score(world.path, world.rig, world.scans, {}, {}, mapping::Pcr2Fold{})),
               std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
