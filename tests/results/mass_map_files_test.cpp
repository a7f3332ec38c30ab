// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/mass_map_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::results {
namespace {

using datasets::OccupancyMap;
using evidence::GridMass;

/// Lower row: empty, occupied; upper row: torn, and in total conflict.
grids::MassMap small_map() {
  grids::MassMap map = grids::vacuous_map({.resolution_m = 0.1, .origin_x_m = 1.0}, {{4, -3}, 2, 2});
  map.masses = {GridMass{.empty = 0.9, .occupied = 0.05, .conflict = 0.0, .unknown = 0.05},
                GridMass{.empty = 0.1, .occupied = 0.4, .conflict = 0.5, .unknown = 0.0},
                GridMass{.empty = 0.45, .occupied = 0.45, .conflict = 0.0, .unknown = 0.1},
                GridMass{.empty = 0.0, .occupied = 0.0, .conflict = 1.0, .unknown = 0.0}};
  map.seen.assign(4, 1);
  return map;
}

TEST(MassMapFiles, CellsAreCalledByTheirProbability) {
  const OccupancyMap map = to_occupancy(small_map());
  EXPECT_THAT(map.cells, testing::ElementsAre(OccupancyMap::kFree, OccupancyMap::kOccupied, OccupancyMap::kUnknown,
                                              OccupancyMap::kUnknown));
  EXPECT_THAT(to_probabilities(small_map()).cells, testing::ElementsAre(8, 80, 50, OccupancyMap::kUnknown));
  EXPECT_NEAR(map.origin_x_m, 1.4, 1e-12);
  EXPECT_NEAR(map.origin_y_m, -0.3, 1e-12);
}

TEST(MassMapFiles, ThePictureHoldsTheMassesTopRowFirst) {
  const BeliefImage image = belief_image(small_map());
  ASSERT_EQ(image.pixels.size(), 4u);
  EXPECT_THAT(image.pixels[0], testing::ElementsAre(0.45F, 0.45F, 0.0F, 0.1F));
  EXPECT_THAT(image.pixels[3], testing::ElementsAre(0.1F, 0.4F, 0.5F, 0.0F));
}

TEST(MassMapFiles, AMapOfNothingIsOneUnknownCell) {
  const grids::MassMap nothing = grids::vacuous_map({}, {});
  EXPECT_THAT(to_occupancy(nothing).cells, testing::ElementsAre(OccupancyMap::kUnknown));
  EXPECT_THAT(belief_image(nothing).pixels[0], testing::ElementsAre(0.0F, 0.0F, 0.0F, 1.0F));
}

}  // namespace
}  // namespace credo::results
