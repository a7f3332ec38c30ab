// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/cell_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace credo::grids {
namespace {

using Large = std::array<double, 12>;

/// As many tiles of its cells as fit into 1 MB.
template <typename Cell>
int tiles_in_a_megabyte() {
  CellGrid<Cell> grid({}, 1'000'000);
  int tiles = 0;
  EXPECT_THAT(
      [&] {
        for (;; ++tiles) static_cast<void>(grid.see({tiles * Tile::kSide, 0}));
      },
      testing::ThrowsMessage<std::length_error>(
          testing::AllOf(testing::HasSubstr("coarser resolution"), testing::HasSubstr(std::to_string(sizeof(Cell))))));
  EXPECT_EQ(grid.find({tiles * Tile::kSide, 0}), nullptr);
  return tiles;
}

TEST(CellGrid, IsBoundInBytesHoweverLargeItsCellsAre) {
  EXPECT_LE(tiles_in_a_megabyte<Large>() * Tile::kCells * 96, 1'000'000);
  EXPECT_LE(tiles_in_a_megabyte<double>() * Tile::kCells * 8, 1'000'000);
  EXPECT_GT(tiles_in_a_megabyte<double>(), 10 * tiles_in_a_megabyte<Large>());
}

}  // namespace
}  // namespace credo::grids
