// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/pending_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "mapping/region_filler.hpp"

namespace credo::mapping {
namespace {

using Square = std::vector<RegionFiller::Corner>;
using grids::EvidentialGrid;

RegionFiller::Increments strongest() {
  RegionFiller::Increments increments;
  increments[0].increment = evidence::fixed_increment({0.9, 0.05, 0.0, 0.05}, 1.0);
  return increments;
}

Square square(float x, float y, float side) { return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}; }

void fill(EvidentialGrid& grid, PendingRegions& pending, const Square& region) {
  RegionFiller filler;
  filler.add_contour(region, 0);
  filler.fill(grid, pending, strongest());
}

/// Near and far, small and large, again and again: the box of what is pending grows, and starts anew.
TEST(PendingRegions, AreInTheMapAsIfEachHadBeenTakenInWhenItCame) {
  std::mt19937 random(3);
  std::vector<Square> regions(300, square(-20.0F, 7.0F, 90.0F));  // one place, more often than sums may wait
  for (int k = 0; k < 60; ++k) {
    const float far = k % 7 == 0 ? 1e5F : 400.0F;
    const auto place = [&] { return far * (static_cast<float>(random() % 65'536) / 65'536.0F - 0.5F); };
    const float x = place(), y = place();
    regions.push_back(square(x, y, k % 11 == 0 ? 2500.0F : 1.0F + static_cast<float>(random() % 200)));
  }
  std::ranges::shuffle(regions, random);
  EvidentialGrid together, one_by_one;
  PendingRegions pending;
  for (const Square& region : regions) {
    fill(together, pending, region);
    PendingRegions alone;
    fill(one_by_one, alone, region);
    alone.settle(one_by_one);
  }
  pending.settle(together);
  EXPECT_EQ(together, one_by_one);
  EXPECT_EQ(together.tiles().size(), one_by_one.tiles().size());
  pending.settle(together);  // nothing is left
  EXPECT_EQ(together, one_by_one);
}

TEST(PendingRegions, ARegionThatTheMapHasNoRoomForIsRefusedAndTheOthersStay) {
  EvidentialGrid grid({}, 9), expected({}, 9);
  PendingRegions pending, alone;
  fill(grid, pending, square(1.0F, 1.0F, 180.0F));  // 3 x 3 tiles
  fill(expected, alone, square(1.0F, 1.0F, 180.0F));
  alone.settle(expected);
  EXPECT_THROW(fill(grid, pending, square(1.0F, 1.0F, 200.0F)), std::length_error);
  fill(grid, pending, square(-1.0F, -1.0F, 0.2F));  // holds no centre of a cell
  pending.settle(grid);
  EXPECT_EQ(grid, expected);
  EXPECT_EQ(grid.room(), 0U);
  fill(grid, pending, square(10.0F, 10.0F, 100.0F));  // what the map has it goes on to fill
  pending.settle(grid);
  EXPECT_LT(grid.at({50, 50}).unknown, expected.at({50, 50}).unknown);
}

}  // namespace
}  // namespace credo::mapping
