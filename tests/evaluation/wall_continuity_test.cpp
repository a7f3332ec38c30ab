// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/wall_continuity.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace credo::evaluation {
namespace {

using grids::CellIndex;

/// A truth and a map of it by the same drawing, the top row first: '#' wall, '.' free, ' ' unknown.
using Rows = std::vector<std::string>;

const Rows kTwoRooms{
    "####################",  //
    "#.........#........#",  //
    "#.........#........#",  //
    "#.........#........#",  //
    "#..................#",  //
    "#..................#",  //
    "#..................#",  //
    "#..................#",  //
    "#.........#........#",  //
    "#.........#........#",  //
    "#.........#........#",  //
    "####################",
};

datasets::OccupancyMap truth_of(const Rows& rows) {
  datasets::OccupancyMap map{.width = static_cast<int>(rows[0].size()),
                             .height = static_cast<int>(rows.size()),
                             .resolution_m = 0.1,
                             .cells = {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char c : *row)
      map.cells.push_back(c == '#'   ? datasets::OccupancyMap::kOccupied
                          : c == '.' ? datasets::OccupancyMap::kFree
                                     : datasets::OccupancyMap::kUnknown);
  return map;
}

grids::MassMap map_of(const Rows& rows) {
  grids::MassMap map = grids::vacuous_map({.resolution_m = 0.1},
                                          {{0, 0}, static_cast<int>(rows[0].size()), static_cast<int>(rows.size())});
  for (int y = 0; y < map.box.height; ++y)
    for (int x = 0; x < map.box.width; ++x) {
      const char c = rows[rows.size() - 1 - static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      if (c == ' ') continue;
      map.seen[map.place({x, y})] = 1;
      map.masses[map.place({x, y})] =
          c == '#' ? evidence::GridMass::from(0.1, 0.8) : evidence::GridMass::from(0.8, 0.1);
    }
  return map;
}

/// `kTwoRooms` with some cells drawn over; rows from the top.
Rows with(char what, int row, int column, int rows, int columns) {
  Rows drawn = kTwoRooms;
  for (int y = row; y < row + rows; ++y)
    for (int x = column; x < column + columns; ++x)
      drawn[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = what;
  return drawn;
}

WallContinuity score(const Rows& map) { return wall_continuity(map_of(map), truth_of(kTwoRooms)); }

TEST(WallContinuity, ATrueMapIsWhole) {
  const WallContinuity whole = score(kTwoRooms);
  EXPECT_EQ(whole.torn, 0);
  EXPECT_EQ(whole.joined, 0);
  EXPECT_NEAR(whole.surface_m, 0.1 * 66, 1e-9);
}

TEST(WallContinuity, AWallThatWasReachedAndIsLeftOpenIsTorn) {
  const WallContinuity torn = score(with('.', 0, 3, 1, 7));  // 7 cells open, 5 of them with no wall beside them
  EXPECT_EQ(torn.torn, 1);
  EXPECT_NEAR(torn.torn_m, 0.5, 1e-9);
  EXPECT_EQ(torn.joined, 0);
}

TEST(WallContinuity, AFewCellsAreNoTear) {
  EXPECT_EQ(score(with('.', 0, 4, 1, 5)).torn, 0);  // 3 cells with no wall beside them
  EXPECT_EQ(score(with('.', 0, 4, 1, 6)).torn, 1);
}

TEST(WallContinuity, WhatNoBeamReachedIsNotTorn) {
  Rows unseen = with(' ', 0, 0, 12, 8);
  EXPECT_EQ(score(unseen).torn, 0);
  EXPECT_LT(score(unseen).surface_m, 0.1 * 66);
}

TEST(WallContinuity, AWallOneCellOffIsWhole) {
  Rows shifted = kTwoRooms;
  shifted[0] = std::string(20, '.');
  shifted[1] = std::string(20, '#');
  EXPECT_EQ(score(shifted).torn, 0);
  EXPECT_EQ(score(shifted).joined, 0);
}

TEST(WallContinuity, ADoorThatIsClosedIsJoined) {
  const WallContinuity closed = score(with('#', 4, 10, 4, 1));
  EXPECT_EQ(closed.joined, 1);
  EXPECT_EQ(closed.torn, 0);
}

TEST(WallContinuity, ADoorThatIsHalfClosedIsOpen) { EXPECT_EQ(score(with('#', 4, 10, 2, 1)).joined, 0); }

TEST(WallContinuity, ABlotInTheOpenOrOnAWallJoinsNothing) {
  EXPECT_EQ(score(with('#', 5, 4, 2, 2)).joined, 0);
  EXPECT_EQ(score(with('#', 1, 4, 3, 2)).joined, 0);
}

TEST(WallContinuity, RefusesAMapOfAnotherPlace) {
  grids::MassMap elsewhere = map_of(kTwoRooms);
  elsewhere.box.min = {500, 500};
  EXPECT_THROW((void)wall_continuity(elsewhere, truth_of(kTwoRooms)), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
