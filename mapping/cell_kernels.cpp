// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using grids::kLanes;
using grids::Lanes;
using grids::Tile;

/// Four numbers of a channel; a table entry.
using Quad [[gnu::vector_size(16)]] = std::int32_t;

constexpr Lanes kFirstLanes{0, 1, 2, 3, 4, 5, 6, 7};

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
[[gnu::always_inline]] inline void add_to_cells(Tile& tile, int place, const Vector& empty, const Vector& occupied,
                                                const Vector& unknown) {
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

/// Adds to all cells of a stretch, by blocks that lie in one line of the cache each. What else is in the first and in
/// the last block is written too, with what it holds.
[[gnu::always_inline]] inline void add_to_stretch(Tile& tile, const Stretch& stretch,
                                                  const FixedLogCommonality& increment) {
  const Lanes empty = increment.empty - Lanes{}, occupied = increment.occupied - Lanes{},
              unknown = increment.unknown - Lanes{};
  const int end = stretch.place + stretch.count;
  int place = stretch.place / kLanes * kLanes;
  if ((stretch.place | stretch.count) % kLanes == 0) {
    for (; place < end; place += kLanes) add_to_cells(tile, place, empty, occupied, unknown);
    return;
  }
  Lanes inside = kFirstLanes + place >= Lanes{} + stretch.place;
  for (; place + kLanes < end; place += kLanes) {
    add_to_cells(tile, place, Lanes(empty & inside), Lanes(occupied & inside), Lanes(unknown & inside));
    inside = Lanes{} - 1;
  }
  inside &= kFirstLanes + place < Lanes{} + end;
  add_to_cells(tile, place, Lanes(empty & inside), Lanes(occupied & inside), Lanes(unknown & inside));
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
[[gnu::always_inline]] inline void add_entries(Tile& tile, int place, const TableEntry* entries,
                                               const std::int32_t* entry) {
  std::array<Lanes, 4> pair;  // entries i and i + 4
  for (int i = 0; i < 4; ++i) {
    Quad low, high;
    load(&entries[entry[i]].increment.empty, low);
    load(&entries[entry[i + 4]].increment.empty, high);
    pair[i] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  // empty, empty, occupied, occupied; then unknown, unknown
  const Lanes low_01 = __builtin_shufflevector(pair[0], pair[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes low_23 = __builtin_shufflevector(pair[2], pair[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high_01 = __builtin_shufflevector(pair[0], pair[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes high_23 = __builtin_shufflevector(pair[2], pair[3], 2, 10, 3, 11, 6, 14, 7, 15);
  add_to_cells(tile, place, Lanes(__builtin_shufflevector(low_01, low_23, 0, 1, 8, 9, 4, 5, 12, 13)),
               Lanes(__builtin_shufflevector(low_01, low_23, 2, 3, 10, 11, 6, 7, 14, 15)),
               Lanes(__builtin_shufflevector(high_01, high_23, 0, 1, 8, 9, 4, 5, 12, 13)));
}

/// Adds to the cells of a block what look_up has found for them.
[[gnu::always_inline]] inline void add_to_block(const FanBlock& block, const TableEntry* entries,
                                                const std::int32_t* entry) {
  Tile& tile = *block.tile;
  if (block.place + kLanes <= Tile::kCells) return add_entries(tile, block.place, entries, entry);
  for (int i = 0; i < block.count; ++i) {  // at the end of the tile there is no room for eight
    const FixedLogCommonality& increment = entries[entry[i]].increment;
    FixedLogCommonality::accumulate(tile.empty[block.place + i], increment.empty);
    FixedLogCommonality::accumulate(tile.occupied[block.place + i], increment.occupied);
    FixedLogCommonality::accumulate(tile.unknown[block.place + i], increment.unknown);
  }
}

}  // namespace

void add_by_class(Tile& tile, std::span<const Stretch> stretches, std::span<const FixedLogCommonality> increments,
                  grids::Instructions instructions) {
  grids::run_with(
      instructions, [&]() __attribute__((always_inline)) {
        for (const Stretch& stretch : stretches) add_to_stretch(tile, stretch, increments[stretch.region_class]);
      });
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
