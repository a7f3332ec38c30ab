// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using grids::Instructions;
using grids::Tile;

/// A tile whose cells hold some evidence, some of them next to the floor.
std::unique_ptr<Tile> random_tile(std::mt19937& random) {
  auto tile = std::make_unique<Tile>();
  for (int i = 0; i < Tile::kCells; ++i) {
    const auto held = [&] {
      const auto evidence = static_cast<std::int32_t>(random() % 20'000'000);
      return random() % 5 == 0 ? FixedLogCommonality::kFloor + evidence / 8 : -evidence;
    };
    tile->empty[i] = held();
    tile->occupied[i] = held();
    tile->unknown[i] = held();
  }
  return tile;
}

FixedLogCommonality random_increment(std::mt19937& random) {
  const auto part = [&] { return -static_cast<std::int32_t>(random() % 5'000'000); };
  return {part(), part(), part()};
}

void add(Tile& tile, int place, const FixedLogCommonality& increment) {
  FixedLogCommonality::accumulate(tile.empty[place], increment.empty);
  FixedLogCommonality::accumulate(tile.occupied[place], increment.occupied);
  FixedLogCommonality::accumulate(tile.unknown[place], increment.unknown);
}

TEST(CellKernels, ATileTakesInTheRegionsThatItsColumnsCross) {
  std::mt19937 random(1);
  const grids::TileIndex index{-2, 5};
  grids::EvidentialGrid before;
  before.tile(index) = *random_tile(random);
  auto changes = std::make_unique<TileChanges>();
  RowEvidence below;  // of regions that come up from the tile below
  Tile expected = *before.find_tile(index);
  const auto fill = [&](int column, int from, int to, const FixedLogCommonality& increment) {
    for (int row = from; row < to; ++row) add(expected, row * Tile::kSide + column, increment);
  };
  for (int i = 0; i < 300; ++i) {
    const int column = static_cast<int>(random() % Tile::kSide), first = static_cast<int>(random() % 80) - 16;
    const int last = std::max(first, 0) + 1 + static_cast<int>(random() % Tile::kSide);
    const PaddedIncrement evidence{random_increment(random)};
    fill(column, std::max(first, 0), std::min(last, Tile::kSide), evidence.increment);
    if (first >= 0) {
      changes->change(grids::place_in_tile({column, first}), evidence.quad());
    } else {
      Channels& cells = below.cells[static_cast<std::size_t>(column / grids::kLanes)];
      cells.empty[column % grids::kLanes] += evidence.increment.empty;
      cells.occupied[column % grids::kLanes] += evidence.increment.occupied;
      cells.unknown[column % grids::kLanes] += evidence.increment.unknown;
      below.held |= 1U << column / grids::kLanes;
    }
    if (last < Tile::kSide) changes->change(grids::place_in_tile({column, last}), -evidence.quad());
  }
  for (const Instructions instructions : {Instructions::kBaseline, grids::best_instructions()}) {
    grids::EvidentialGrid grid = before;
    TileChanges taken = *changes;
    RowEvidence evidence = below;
    settle_tile(grid, index, &taken, evidence, instructions);
    EXPECT_TRUE(*grid.find_tile(index) == expected);
    EXPECT_EQ(std::ranges::count(taken.rows, true), 0);
  }
  EXPECT_TRUE(expected.is_saturated());
}

TEST(CellKernels, ARegionThatEndsBelowATileMakesNone) {
  grids::EvidentialGrid grid;
  TileChanges changes;
  RowEvidence evidence;
  evidence.cells[0].empty[3] = -7;
  evidence.held = 1;
  changes.change(3, Quad{7, 0, 0, 0});
  settle_tile(grid, {0, 0}, &changes, evidence);
  EXPECT_TRUE(grid.tiles().empty());
  EXPECT_EQ(evidence.held, 0U);
}

/// Fans in all directions over one tile, from apexes in it and around it.
class FanKernel : public ::testing::Test {
 protected:
  static constexpr int kRows = 100;

  FanKernel() {
    for (int i = 0; i < kRows * FanTable::kAngleBins; ++i) entries_.push_back({random_increment(random_)});
    entries_.emplace_back();
  }

  std::vector<FanBlock> blocks(Tile& tile, float apex_x, float apex_y) {
    std::vector<FanBlock> result;
    for (int k = 0; k < 300; ++k) {
      const int row = static_cast<int>(random_() % Tile::kSide), column = static_cast<int>(random_() % Tile::kSide);
      const int count = std::min(1 + static_cast<int>(random_() % grids::kLanes), Tile::kSide - column);
      result.push_back({&tile, static_cast<std::int16_t>(row * Tile::kSide + column), static_cast<std::int16_t>(count),
                        static_cast<float>(column) + 0.5F - apex_x, static_cast<float>(row) + 0.5F - apex_y});
    }
    return result;
  }

  FanTable table(float heading) const {
    return {.entries = entries_,
            .axis_x = std::cos(heading),
            .axis_y = std::sin(heading),
            .rows_per_cell = 1.0F,
            .fine_rows_per_cell = 4.0F,
            .first_fine_row = -120.0F,
            .angle_bins = 16.0F / 0.05F};
  }

  std::mt19937 random_{2};
  std::vector<PaddedIncrement> entries_;
};

TEST_F(FanKernel, GivesTheSameBitsWithAllInstructions) {
  for (int k = 0; k < 40; ++k) {
    const float heading = 0.17F * static_cast<float>(k), apex_x = 3.3F * static_cast<float>(k) - 30.0F;
    const auto before = random_tile(random_);
    Tile baseline = *before, best = *before;
    std::vector<FanBlock> fan = blocks(baseline, apex_x, 20.7F);
    add_from_table(fan, table(heading), Instructions::kBaseline);
    for (FanBlock& block : fan) block.tile = &best;
    add_from_table(fan, table(heading), grids::best_instructions());
    ASSERT_TRUE(best == baseline) << k;
    ASSERT_FALSE(best == *before);
  }
}

TEST_F(FanKernel, CellsGetTheEntryOfTheirDistanceAndAngle) {
  const auto tile = std::make_unique<Tile>();
  const FanTable looked_up = table(0.3F);
  for (int row = 0; row < Tile::kSide; ++row) {  // every cell once, also the last of the tile
    for (int column = 0; column < Tile::kSide; column += 5) {
      const FanBlock block{tile.get(), static_cast<std::int16_t>(row * Tile::kSide + column),
                           static_cast<std::int16_t>(std::min(5, Tile::kSide - column)),
                           static_cast<float>(column) + 0.5F - 7.25F, static_cast<float>(row) + 0.5F - 9.75F};
      add_from_table(std::span(&block, 1), looked_up);
    }
  }
  int at_border = 0;
  for (int i = 0; i < Tile::kCells; ++i) {
    const double x = i % Tile::kSide + 0.5 - 7.25, y = i / Tile::kSide + 0.5 - 9.75;
    const double distance = std::hypot(x, y), sine = std::sin(std::atan2(y, x) - 0.3);
    const double row = std::min(std::max(distance, 4.0 * distance - 120.0), kRows - 1.0);
    const double angle = std::min(sine * sine * 16.0 / 0.05, 15.0);
    const int entry = static_cast<int>(row) * FanTable::kAngleBins + static_cast<int>(angle);
    const FixedLogCommonality& expected = entries_[entry].increment;
    at_border += expected != FixedLogCommonality{tile->empty[i], tile->occupied[i], tile->unknown[i]};
  }
  EXPECT_LE(at_border, 4);  // within rounding of a border between two entries
}

}  // namespace
}  // namespace credo::mapping
