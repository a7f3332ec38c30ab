// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/map_accuracy.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace credo::evaluation {
namespace {

using evidence::FixedLogCommonality;
using grids::EvidentialGrid;

constexpr grids::Georeference kReference{.resolution_m = 0.1, .origin_x_m = 0.0, .origin_y_m = 0.0};

FixedLogCommonality seen(double empty, double occupied) {
  return evidence::quantise(evidence::log_commonality({empty, occupied, 0.0, 1.0 - empty - occupied}, 0.95));
}
const FixedLogCommonality kEmpty = seen(0.9, 0.05), kOccupied = seen(0.05, 0.9);

/// 10 x 6 cells, a wall in column `wall`, free left of it, unknown right of it.
EvidentialGrid room(int wall) {
  EvidentialGrid grid(kReference);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x <= wall; ++x) grid.add({x, y}, x == wall ? kOccupied : kEmpty);
  return grid;
}

datasets::OccupancyMap truth_with_wall(int wall) {
  datasets::OccupancyMap truth{.width = 10, .height = 6, .resolution_m = 0.1, .cells = {}};
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 10; ++x) truth.cells.push_back(x == wall ? 100 : x < wall ? 0 : -1);
  return truth;
}

TEST(MapAccuracy, APerfectMapIsRight) {
  const MapAccuracy a = map_accuracy(room(7), truth_with_wall(7));
  EXPECT_EQ(a.observed, 48);
  EXPECT_EQ(a.correct, 48);
  EXPECT_EQ(a.accuracy(), 1.0);
  EXPECT_EQ(a.undecided, 0);
  EXPECT_EQ(a.withheld, 0);
  EXPECT_EQ(a.surface, 6);
  EXPECT_EQ(a.surface_recall(), 1.0);
}

TEST(MapAccuracy, AWallMayBeACellAway) {
  const MapAccuracy near = map_accuracy(room(6), truth_with_wall(7));
  EXPECT_EQ(near.accuracy(), 1.0);
  EXPECT_EQ(near.surface_recall(), 1.0);
  const MapAccuracy far = map_accuracy(room(5), truth_with_wall(7));
  EXPECT_EQ(far.wrongly_occupied, 6);
  EXPECT_EQ(far.correct, 30);
  const MapAccuracy strict = map_accuracy(room(6), truth_with_wall(7), {.tolerance_cells = 0, .decision = {}});
  EXPECT_EQ(strict.wrongly_occupied, 6);
  const MapAccuracy generous = map_accuracy(room(5), truth_with_wall(7), {.tolerance_cells = 2, .decision = {}});
  EXPECT_EQ(generous.accuracy(), 1.0);
}

TEST(MapAccuracy, AWallThatWasSeenThroughIsWrong) {
  EvidentialGrid grid(kReference);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x <= 7; ++x) grid.add({x, y}, kEmpty);  // no wall found
  const MapAccuracy a = map_accuracy(grid, truth_with_wall(7));
  EXPECT_EQ(a.wrongly_empty, 6);
  EXPECT_EQ(a.correct, 42);
  EXPECT_EQ(a.surface_found, 0);
  EXPECT_EQ(a.surface, 6);
}

TEST(MapAccuracy, OnlyObservedCellsOfKnownTruthCount) {
  EvidentialGrid grid = room(3);
  grid.add({9, 3}, kOccupied);   // unknown to the truth
  grid.add({50, 3}, kOccupied);  // outside the truth
  const MapAccuracy a = map_accuracy(grid, truth_with_wall(7));
  EXPECT_EQ(a.observed, 24);
  EXPECT_EQ(a.wrongly_occupied, 6);
}

TEST(MapAccuracy, BalancedCellsAreUndecidedAndNeverRight) {
  EvidentialGrid grid = room(7);
  grid.add({2, 2}, kOccupied);
  FixedLogCommonality weak = seen(0.2, 0.0);
  grid.add({8, 2}, weak);
  datasets::OccupancyMap truth = truth_with_wall(7);
  truth.cells[2 * 10 + 8] = 0;
  const MapAccuracy a = map_accuracy(grid, truth);
  EXPECT_EQ(a.observed, 49);
  EXPECT_EQ(a.undecided, 1);  // empty once, occupied once
  EXPECT_EQ(a.correct, 48);   // the weak one is right
  EXPECT_EQ(a.withheld, 2);   // but both are withheld
  EXPECT_EQ(a.correct + a.undecided + a.wrongly_empty + a.wrongly_occupied, a.observed);
}

TEST(MapAccuracy, TheTruthMayBeFinerMovedAndTurned) {
  // The same room in a frame that is turned by 90 degrees and moved, in cells of 2 cm with a wall of one cell.
  datasets::OccupancyMap truth{.width = 30, .height = 40, .resolution_m = 0.02, .cells = {}};
  truth.origin_x_m = 0.8;  // its x axis points along the map's y, its y axis along the map's -x
  truth.origin_yaw_rad = 1.5707963267948966;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 30; ++x) truth.cells.push_back(y == 3 ? 100 : 0);  // at the map's x = 0.73
  const MapAccuracy a = map_accuracy(room(7), truth);
  EXPECT_EQ(a.observed, 48);
  EXPECT_EQ(a.accuracy(), 1.0);
  EXPECT_EQ(a.surface, 6);
}

TEST(MapAccuracy, AFloorPlanIsATruthToo) {
  geometry::FloorPlan plan;
  plan.walls = {{{0.75, 0.0}, {0.75, 0.59}}, {{0.05, 0.0}, {0.75, 0.0}}};
  const MapAccuracy a = map_accuracy(room(7), plan);
  EXPECT_EQ(a.observed, 48);
  // The wall along x was not found, but for where the other one begins.
  EXPECT_EQ(a.wrongly_empty, 6);
  EXPECT_EQ(a.correct, 42);
}

TEST(MapAccuracy, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(static_cast<void>(map_accuracy(EvidentialGrid(kReference), truth_with_wall(7))), std::invalid_argument);
  datasets::OccupancyMap elsewhere = truth_with_wall(7);
  elsewhere.origin_x_m = 100.0;
  EXPECT_THROW(static_cast<void>(map_accuracy(room(7), elsewhere)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(map_accuracy(room(7), geometry::FloorPlan{})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(map_accuracy(room(7), truth_with_wall(7), {.tolerance_cells = -1, .decision = {}})),
               std::invalid_argument);
}

TEST(MapAccuracy, PrintsForAPerson) {
  std::ostringstream out;
  out << map_accuracy(room(7), truth_with_wall(7));
  EXPECT_NE(out.str().find("accuracy 1 of 48 observed cells"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace credo::evaluation
