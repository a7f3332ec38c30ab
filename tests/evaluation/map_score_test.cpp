// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace credo::evaluation {
namespace {

using evidence::GridMass;

constexpr GridMass kEmpty{.empty = 0.9, .occupied = 0.05, .conflict = 0.0, .unknown = 0.05};
constexpr GridMass kOccupied{.empty = 0.05, .occupied = 0.9, .conflict = 0.0, .unknown = 0.05};

/// 10 x 6 cells of 10 cm, a solid from column 7 on.
datasets::OccupancyMap truth() {
  datasets::OccupancyMap truth{.width = 10, .height = 6, .resolution_m = 0.1, .cells = {}};
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 10; ++x) truth.cells.push_back(x >= 7 ? 100 : 0);
  return truth;
}

/// Free up to a wall of one cell.
grids::MassMap map_with_wall(int wall) {
  grids::MassMap map = grids::vacuous_map({.resolution_m = 0.1}, {{0, 0}, 10, 6});
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x <= wall; ++x) {
      map.masses[map.place({x, y})] = x == wall ? kOccupied : kEmpty;
      map.seen[map.place({x, y})] = 1;
    }
  return map;
}

TEST(MapScore, ARightMapIsRight) {
  const MapScore score = map_score(map_with_wall(7), truth());
  EXPECT_EQ(score.cells, 48);
  EXPECT_EQ(score.accuracy(), 1.0);
  EXPECT_EQ(score.decided_share(), 1.0);
  EXPECT_EQ(score.contour_m, 0.0);
  EXPECT_EQ(score.missed_m, 0.0);
  EXPECT_NEAR(score.brier, 0.075 * 0.075, 1e-12);
  EXPECT_NEAR(score.log_loss, -std::log(0.925), 1e-12);
  EXPECT_NEAR(score.ignorance, 0.05, 1e-12);
}

TEST(MapScore, AWallMayBeACellAwayAndNotTwo) {
  const MapScore near = map_score(map_with_wall(6), truth());
  EXPECT_EQ(near.accuracy(), 1.0);
  EXPECT_NEAR(near.contour_m, 0.1, 1e-12);
  EXPECT_EQ(map_score(map_with_wall(5), truth()).right, 30);
}

TEST(MapScore, DeepInsideOfASolidNothingCounts) {
  EXPECT_EQ(map_score(map_with_wall(9), truth()).cells, 48);  // columns 8 and 9 do not
}

TEST(MapScore, UndecidedIsWrong) {
  grids::MassMap map = map_with_wall(7);
  map.masses[map.place({2, 2})] = {.empty = 0.4, .occupied = 0.4, .conflict = 0.0, .unknown = 0.2};
  const MapScore score = map_score(map, truth());
  EXPECT_EQ(score.decided, 47);
  EXPECT_EQ(score.accuracy_of_decided(), 1.0);
  EXPECT_NEAR(score.accuracy(), 47.0 / 48.0, 1e-12);
}

TEST(MapScore, TotalConflictIsACoinToss) {
  grids::MassMap map = map_with_wall(7);
  for (GridMass& mass : map.masses) mass = {.empty = 0.0, .occupied = 0.0, .conflict = 1.0, .unknown = 0.0};
  EXPECT_NEAR(map_score(map, truth()).brier, 0.25, 1e-12);
}

TEST(MapScore, AMapOfAnotherPlaceIsRefused) {
  grids::MassMap map = map_with_wall(7);
  map.georeference.origin_x_m = 100.0;
  EXPECT_THROW(static_cast<void>(map_score(map, truth())), std::invalid_argument);
}

TEST(TrueCells, ATruthOfKilometresIsRefusedBeforeRoomIsMadeForIt) {
  datasets::OccupancyMap wide = truth();
  wide.resolution_m = 100.0;  // not 0.1
  const grids::Georeference georeference{.resolution_m = 0.05};
  EXPECT_THAT([&] { TrueCells(wide, georeference, box_of(wide, georeference)); },
              ::testing::ThrowsMessage<std::length_error>(
                  ::testing::HasSubstr("over 1000 m x 600 m, 240032001 cells; expected at most 67108864")));
}

}  // namespace
}  // namespace credo::evaluation
