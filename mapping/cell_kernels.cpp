// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_kernels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using grids::kLanes;
using grids::Lanes;
using grids::Tile;

template <typename Vector>
[[gnu::always_inline]] inline void load(const std::int32_t* cells, Vector& numbers) {
  std::memcpy(&numbers, cells, sizeof(numbers));
}

template <typename Vector>
[[gnu::always_inline]] inline void store(const Vector& numbers, std::int32_t* cells) {
  std::memcpy(cells, &numbers, sizeof(numbers));
}

/// FixedLogCommonality::accumulate for as many cells as the vector has numbers.
template <typename Vector>
[[gnu::always_inline]] inline void accumulate(Vector& channel, const Vector& increment) {
  const Vector least = FixedLogCommonality::kFloor - increment;
  channel = (channel > least ? channel : least) + increment;
}

/// Adds to the three channels of neighbouring cells. All are loaded before the first is stored: the channels lie a
/// multiple of 4 KB apart, and a load after a store to such an address would wait for it.
template <typename Vector>
[[gnu::always_inline]] inline void add_to_cells(Tile& tile, std::size_t place, const Vector& empty,
                                                const Vector& occupied, const Vector& unknown) {
  Vector e, o, u;
  load(tile.empty.data() + place, e);
  load(tile.occupied.data() + place, o);
  load(tile.unknown.data() + place, u);
  accumulate(e, empty);
  accumulate(o, occupied);
  accumulate(u, unknown);
  store(e, tile.empty.data() + place);
  store(o, tile.occupied.data() + place);
  store(u, tile.unknown.data() + place);
}

[[gnu::always_inline]] inline void add_to_cells(Tile& tile, std::size_t place, const Channels& increments) {
  add_to_cells(tile, place, increments.empty, increments.occupied, increments.unknown);
}

[[nodiscard, gnu::always_inline]] inline bool is_zero(const Channels& increments) {
  const Lanes bits = increments.empty | increments.occupied | increments.unknown;
  const auto half = [&](int i) { return bits[i] | bits[i + 1] | bits[i + 2] | bits[i + 3]; };
  return (half(0) | half(4)) == 0;
}

/// From eight increments side by side: pairs[i] holds those of the cells i and i + 4.
[[nodiscard, gnu::always_inline]] inline Channels by_channel(const std::array<Lanes, 4>& pairs) {
  // empty, empty, occupied, occupied; then unknown, unknown
  const Lanes low_01 = __builtin_shufflevector(pairs[0], pairs[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes low_23 = __builtin_shufflevector(pairs[2], pairs[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high_01 = __builtin_shufflevector(pairs[0], pairs[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes high_23 = __builtin_shufflevector(pairs[2], pairs[3], 2, 10, 3, 11, 6, 14, 7, 15);
  return {Lanes(__builtin_shufflevector(low_01, low_23, 0, 1, 8, 9, 4, 5, 12, 13)),
          Lanes(__builtin_shufflevector(low_01, low_23, 2, 3, 10, 11, 6, 7, 14, 15)),
          Lanes(__builtin_shufflevector(high_01, high_23, 0, 1, 8, 9, 4, 5, 12, 13))};
}

/// Of eight neighbouring cells, what changes; zero there afterwards.
[[nodiscard, gnu::always_inline]] inline Channels take_changes(TileChanges::Change* changes) {
  std::array<Lanes, 4> pairs;
  for (int i = 0; i < 4; ++i) {
    pairs[i] = __builtin_shufflevector(changes[i].by, changes[i + 4].by, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  for (int i = 0; i < kLanes; ++i) changes[i].by = Quad{};
  return by_channel(pairs);
}

/// The evidence of the next row up.
[[gnu::always_inline]] inline void climb(RowEvidence& evidence, TileChanges::Change* changes) {
  evidence.held = 0;
  for (std::size_t i = 0; i < evidence.cells.size(); ++i) {
    const Channels change = take_changes(changes + i * kLanes);
    Channels& cells = evidence.cells[i];
    cells = {cells.empty + change.empty, cells.occupied + change.occupied, cells.unknown + change.unknown};
    evidence.held |= unsigned{!is_zero(cells)} << i;
  }
}

/// Adds the same evidence to the rows [begin, end).
[[gnu::always_inline]] inline void add_to_rows(Tile& tile, int begin, int end, const RowEvidence& evidence) {
  constexpr std::size_t kBlocks = Tile::kSide / kLanes;
  const auto first_place = static_cast<std::size_t>(begin) << Tile::kShift;
  const auto end_place = static_cast<std::size_t>(end) << Tile::kShift;
  if (evidence.held == (1U << kBlocks) - 1) {
    for (std::size_t place = first_place; place < end_place; place += Tile::kSide)
      for (std::size_t i = 0; i < kBlocks; ++i) add_to_cells(tile, place + i * kLanes, evidence.cells[i]);
    return;
  }
  for (std::size_t place = first_place; place < end_place; place += Tile::kSide)
    for (unsigned rest = evidence.held; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      add_to_cells(tile, place + i * kLanes, evidence.cells[i]);
    }
}

/// Bit y: something changes in row y. No longer so afterwards.
[[gnu::always_inline]] inline std::uint64_t take_rows(TileChanges* changes) {
  std::uint64_t rows = 0;
  if (changes == nullptr) return rows;
  for (std::size_t row = 0; row < changes->rows.size(); ++row) rows |= std::uint64_t{changes->rows[row]} << row;
  changes->rows = {};
  return rows;
}

[[gnu::always_inline]] inline void settle(grids::EvidentialGrid& grid, grids::TileIndex index, TileChanges* changes,
                                          RowEvidence& evidence) {
  const std::uint64_t rows = take_rows(changes);
  Tile* tile = nullptr;
  for (int row = 0, next = 0; row < Tile::kSide; row = next) {
    const std::uint64_t rest = rows >> row;
    if ((rest & 1) != 0) climb(evidence, &changes->cells[static_cast<std::size_t>(row) << Tile::kShift]);
    next = std::min(row + 1 + std::countr_zero(rest >> 1), Tile::kSide);
    if (evidence.held == 0) continue;
    if (tile == nullptr) tile = &grid.tile(index);
    add_to_rows(*tile, row, next, evidence);
  }
}

/// Where in the table the cells of a block look; those that fill it up look at the vacuous entry.
[[gnu::always_inline]] inline void look_up(const FanBlock& block, const FanTable& table, std::int32_t* entry) {
  const std::int32_t vacuous = static_cast<std::int32_t>(table.entries.size()) - 1;
  const float last_row = static_cast<float>(vacuous / FanTable::kAngleBins - 1);
  const float last_angle = static_cast<float>(FanTable::kAngleBins - 1);
  for (std::int32_t i = 0; i < kLanes; ++i) {
    const float x = block.x + static_cast<float>(i), y = block.y;
    const float square = std::max(x * x + y * y, 1e-12F);
    const float across = table.axis_x * y - table.axis_y * x;
    const float distance = std::sqrt(square);
    const float row =
        std::max(distance * table.rows_per_cell, distance * table.fine_rows_per_cell + table.first_fine_row);
    const float angle = across * across / square * table.angle_bins;
    const std::int32_t found = static_cast<std::int32_t>(std::min(row, last_row)) * FanTable::kAngleBins +
                               static_cast<std::int32_t>(std::min(angle, last_angle));
    entry[i] = i < block.count ? found : vacuous;
  }
}

/// Adds eight table entries to eight neighbouring cells: their increments, side by side, become those of the channels.
[[gnu::always_inline]] inline void add_entries(Tile& tile, std::size_t place, const PaddedIncrement* entries,
                                               const std::int32_t* entry) {
  std::array<Lanes, 4> pairs;
  for (int i = 0; i < 4; ++i) {
    Quad low, high;
    load(&entries[entry[i]].increment.empty, low);
    load(&entries[entry[i + 4]].increment.empty, high);
    pairs[i] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  add_to_cells(tile, place, by_channel(pairs));
}

/// Adds to the cells of a block what look_up has found for them.
[[gnu::always_inline]] inline void add_to_block(const FanBlock& block, const PaddedIncrement* entries,
                                                const std::int32_t* entry) {
  Tile& tile = *block.tile;
  if (block.place + kLanes <= Tile::kCells)
    return add_entries(tile, static_cast<std::size_t>(block.place), entries, entry);
  for (int i = 0; i < block.count; ++i) {  // at the end of the tile there is no room for eight
    const FixedLogCommonality& increment = entries[entry[i]].increment;
    FixedLogCommonality::accumulate(tile.empty[block.place + i], increment.empty);
    FixedLogCommonality::accumulate(tile.occupied[block.place + i], increment.occupied);
    FixedLogCommonality::accumulate(tile.unknown[block.place + i], increment.unknown);
  }
}

}  // namespace

void settle_tile(grids::EvidentialGrid& grid, grids::TileIndex index, TileChanges* changes, RowEvidence& evidence,
                 grids::Instructions instructions) {
  grids::run_with(
      instructions, [&]() __attribute__((always_inline)) { settle(grid, index, changes, evidence); });
}

void add_from_table(std::span<const FanBlock> blocks, const FanTable& table, grids::Instructions instructions) {
  grids::run_with(
      instructions, [&]() __attribute__((always_inline)) {
        // Looked up many at a time, so that no place in the table is waited for.
        constexpr std::size_t kBatch = 64;
        std::array<std::int32_t, kBatch * kLanes> entry;
        for (std::size_t begin = 0; begin < blocks.size(); begin += kBatch) {
          const std::size_t count = std::min(kBatch, blocks.size() - begin);
          for (std::size_t i = 0; i < count; ++i) look_up(blocks[begin + i], table, entry.data() + i * kLanes);
          for (std::size_t i = 0; i < count; ++i)
            add_to_block(blocks[begin + i], table.entries.data(), entry.data() + i * kLanes);
        }
      });
}

}  // namespace credo::mapping
