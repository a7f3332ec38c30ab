// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/wall_extraction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace credo::grids {
namespace {

using Point = Eigen::Vector2d;

/// A map that is painted by hand, free or occupied cell by cell.
class Drawing {
 public:
  explicit Drawing(double resolution_m = 0.05) : grid(Georeference{.resolution_m = resolution_m}) {}

  void free(const Point& low, const Point& high) { fill(low, high, kFree); }
  void solid(const Point& low, const Point& high) { fill(low, high, kOccupied); }
  /// A wall as a sensor leaves it: a blur of some cells along a line, occupied where it outweighs the free space.
  void blur(const Point& from, const Point& to, double sigma_m) {
    const Point along = (to - from).normalized(), across(-along.y(), along.x());
    const double step = 0.5 * grid.georeference().resolution_m;
    for (double s = 0.0; s <= (to - from).norm(); s += step)
      for (double t = -3.0 * sigma_m; t <= 3.0 * sigma_m; t += step) {
        const double weight = std::exp(-0.5 * t * t / (sigma_m * sigma_m));
        for (int n = 0; n < std::lround(6.0 * weight); ++n)
          grid.add(grid.georeference().cell_at(from + s * along + t * across), kOccupied);
      }
  }

  EvidentialGrid grid;

 private:
  static evidence::FixedLogCommonality seen(double empty, double occupied) {
    return evidence::quantise(evidence::log_commonality({empty, occupied, 0.0, 1.0 - empty - occupied}, 0.95));
  }
  void fill(const Point& low, const Point& high, const evidence::FixedLogCommonality& what) {
    const CellIndex first = grid.georeference().cell_at(low + Point(1e-6, 1e-6)),
                    last = grid.georeference().cell_at(high - Point(1e-6, 1e-6));
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) grid.add({x, y}, what);
  }
  const evidence::FixedLogCommonality kFree = seen(0.9, 0.02), kOccupied = seen(0.02, 0.9);
};

bool has_wall(const geometry::FloorPlan& plan, const Point& a, const Point& b, double tolerance_m) {
  return std::any_of(plan.walls.begin(), plan.walls.end(), [&](const geometry::Segment& wall) {
    return std::max((wall.a - a).norm(), (wall.b - b).norm()) <= tolerance_m ||
           std::max((wall.a - b).norm(), (wall.b - a).norm()) <= tolerance_m;
  });
}

TEST(WallExtraction, ARoomIsFourWallsThatMeet) {
  Drawing room;
  room.free({0.0, 0.0}, {4.0, 3.0});
  room.solid({-0.5, -0.5}, {4.5, 0.0});
  room.solid({-0.5, 3.0}, {4.5, 3.5});
  room.solid({-0.5, 0.0}, {0.0, 3.0});
  room.solid({4.0, 0.0}, {4.5, 3.0});
  const geometry::FloorPlan plan = extract_walls(room.grid);
  ASSERT_EQ(plan.walls.size(), 4u) << ::testing::PrintToString(plan.walls);
  EXPECT_TRUE(has_wall(plan, {0.0, 0.0}, {4.0, 0.0}, 1e-6));
  EXPECT_TRUE(has_wall(plan, {4.0, 0.0}, {4.0, 3.0}, 1e-6));
  EXPECT_TRUE(has_wall(plan, {4.0, 3.0}, {0.0, 3.0}, 1e-6));
  EXPECT_TRUE(has_wall(plan, {0.0, 3.0}, {0.0, 0.0}, 1e-6));
}

TEST(WallExtraction, ABlurredWallRunsAlongItsMiddle) {
  Drawing drawing;
  drawing.free({0.0, 0.0}, {5.0, 2.0});
  drawing.blur({0.2, 1.037}, {4.8, 1.037}, 0.03);
  const geometry::FloorPlan plan = extract_walls(drawing.grid);
  ASSERT_EQ(plan.walls.size(), 1u) << "both sides are one wall: " << ::testing::PrintToString(plan.walls);
  for (const Point& end : {plan.walls[0].a, plan.walls[0].b}) EXPECT_NEAR(end.y(), 1.037, 0.015);
  EXPECT_NEAR(plan.walls[0].length(), 4.6, 0.2);
}

TEST(WallExtraction, ASlantedWallIsStraight) {
  Drawing drawing;
  drawing.free({0.0, 0.0}, {4.0, 4.0});
  const Point a(0.5, 0.6), b(3.4, 2.9);
  drawing.blur(a, b, 0.03);
  const geometry::FloorPlan plan = extract_walls(drawing.grid);
  ASSERT_EQ(plan.walls.size(), 1u) << ::testing::PrintToString(plan.walls);
  EXPECT_TRUE(has_wall(plan, a, b, 0.1)) << plan.walls[0];
}

TEST(WallExtraction, ADoorStaysOpenAndAGapThatNobodySawThroughIsClosed) {
  Drawing drawing;
  drawing.free({0.0, 0.0}, {6.0, 1.0});
  drawing.solid({0.0, 1.0}, {2.0, 1.3});
  drawing.solid({2.5, 1.0}, {4.0, 1.3});  // 2.0 to 2.5 m: nothing is known
  drawing.solid({4.5, 1.0}, {6.0, 1.3});
  drawing.free({4.0, 1.0}, {4.5, 1.3});  // a door that was seen through
  const geometry::FloorPlan plan = extract_walls(drawing.grid);
  EXPECT_TRUE(has_wall(plan, {0.0, 1.0}, {4.0, 1.0}, 0.05)) << ::testing::PrintToString(plan.walls);
  EXPECT_TRUE(has_wall(plan, {4.5, 1.0}, {6.0, 1.0}, 0.05)) << ::testing::PrintToString(plan.walls);
}

TEST(WallExtraction, ClutterAndSpecksAreNoWalls) {
  Drawing drawing;
  drawing.free({0.0, 0.0}, {4.0, 4.0});
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    const Point at(0.05 * static_cast<double>(random() % 80), 0.05 * static_cast<double>(random() % 80));
    for (int k = 0; k < 3; ++k) drawing.solid(at, at + Point(0.05, 0.05));
  }
  EXPECT_TRUE(extract_walls(drawing.grid, {.shortest_m = 0.4}).walls.empty());
}

TEST(WallExtraction, WhatABeamSawBehindAWallByMistakeIsNoRoom) {
  Drawing drawing;
  drawing.free({0.0, 0.0}, {4.0, 2.0});
  drawing.solid({0.0, 2.0}, {4.0, 2.1});
  drawing.free({1.0, 2.1}, {1.2, 3.0});
  drawing.solid({1.2, 2.1}, {1.3, 3.0});
  const geometry::FloorPlan plan = extract_walls(drawing.grid);
  ASSERT_EQ(plan.walls.size(), 1u) << ::testing::PrintToString(plan.walls);
  EXPECT_TRUE(has_wall(plan, {0.0, 2.05}, {4.0, 2.05}, 0.06)) << plan.walls[0];
}

TEST(WallExtraction, DoesNotDependOnWhereTheGridStarts) {
  Drawing drawing;
  drawing.free({-1.0, -1.0}, {1.0, 1.0});
  for (int i = 0; i < 3; ++i) drawing.solid({-0.4, -0.3}, {0.4, 0.3});  // more than was said for free
  EvidentialGrid moved(Georeference{.origin_x_m = 3.2, .origin_y_m = -6.4});
  for (const auto& [index, tile] : drawing.grid.tiles())
    for (int place = 0; place < Tile::kCells; ++place) {
      const CellIndex cell = cell_of(index, place);
      moved.add({cell.x - 64, cell.y + 128}, drawing.grid.at(cell));
    }
  const geometry::FloorPlan here = extract_walls(drawing.grid), there = extract_walls(moved);
  ASSERT_EQ(here.walls.size(), 4u);
  ASSERT_EQ(there.walls.size(), 4u);
  for (const geometry::Segment& wall : here.walls) EXPECT_TRUE(has_wall(there, wall.a, wall.b, 1e-6)) << wall;
}

TEST(WallExtraction, AnEmptyMapHasNoWalls) { EXPECT_TRUE(extract_walls(EvidentialGrid{}).walls.empty()); }

}  // namespace
}  // namespace credo::grids
