// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/change_score.hpp"

#include <gtest/gtest.h>

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

TEST(ChangeScore, WithoutAStateNothingCanBeSaid) {
  const MovingWall world;
  EXPECT_THROW(static_cast<void>(change_score(world.path, world.rig, world.scans, {}, {}, mapping::Pcr2Fold{})),
               std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
