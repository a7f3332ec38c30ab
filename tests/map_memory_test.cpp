// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// The memory of a map, by operator new (docs/map-files.md gives the same numbers).

#include <gtest/gtest.h>

#include <cmath>

#include "grids/evidential_grid.hpp"
#include "tests/support/counted_new.hpp"

namespace credo::grids {
namespace {

constexpr evidence::FixedLogCommonality kSeenEmpty{0, -1'000'000, -1'000'000};

/// What a function leaves allocated and asks for.
template <typename Make>
std::size_t bytes_of(Make make) {
  const std::size_t before = testing::allocated_bytes();
  make();
  return testing::allocated_bytes() - before;
}

/// Corridors of a width, every so often, across a square: seen as a drive sees them, none of its rooms.
struct Site {
  EvidentialGrid grid;
  double seen_cells = 0.0, share = 0.0;

  Site(double side_m, double corridor_m, double spacing_m) {
    const auto side = static_cast<std::int32_t>(side_m / 0.05), width = static_cast<std::int32_t>(corridor_m / 0.05),
               spacing = static_cast<std::int32_t>(spacing_m / 0.05);
    for (std::int32_t y = spacing / 2; y + width <= side; y += spacing)
      for (std::int32_t row = y; row < y + width; ++row)
        for (std::int32_t x = 0; x < side; ++x) grid.add({x, row}, kSeenEmpty);
    for (const auto& entry : grid.tiles())
      for (const std::int32_t unknown : entry.second.unknown) seen_cells += unknown != 0;
    share = seen_cells / (static_cast<double>(side) * side);
  }
};

TEST(MapMemory, ATileTakesTwelveBytesPerCell) {
  EvidentialGrid grid;
  const std::size_t one = bytes_of([&] { grid.add({5, 5}, kSeenEmpty); });
  EXPECT_GE(one, 12U * Tile::kCells);
  EXPECT_LE(one, 12U * Tile::kCells + 128U);
  EXPECT_EQ(bytes_of([&] {
              for (int i = 0; i < Tile::kCells; ++i) grid.add(cell_of({0, 0}, i), kSeenEmpty);
            }),
            0U);
}

TEST(MapMemory, WhatWasNotSeenCostsNothing) {
  EvidentialGrid grid;
  const std::size_t near = bytes_of([&] { grid.add({0, 0}, kSeenEmpty); });
  EXPECT_EQ(bytes_of([&] { grid.add({200'000'000, -200'000'000}, kSeenEmpty); }), near);
}

/// A tenth of the side of a square kilometre, so a hundredth of its memory.
TEST(MapMemory, ASiteOfCorridorsTakesUnderFortyBytesPerSeenCell) {
  double per_cell = 0.0, share = 0.0;
  std::size_t seen = 0;
  const std::size_t bytes = bytes_of([&] {
    const Site site(100.0, 2.5, 50.0);
    per_cell = 1.0 / site.seen_cells;
    share = site.share;
    seen = static_cast<std::size_t>(site.seen_cells);
  });
  per_cell *= static_cast<double>(bytes);
  EXPECT_NEAR(share, 0.05, 0.001);
  EXPECT_LT(per_cell, 40.0) << bytes << " bytes for " << seen << " cells";
  EXPECT_LT(100.0 * static_cast<double>(bytes), 2e9);
}

}  // namespace
}  // namespace credo::grids
