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

/// Adds to all cells of a stretch. The cells that fill the last block up are written too, with what they hold.
[[gnu::always_inline]] inline void add_to_stretch(Tile& tile, const Stretch& stretch,
                                                  const FixedLogCommonality& increment) {
  const Lanes empty = increment.empty - Lanes{}, occupied = increment.occupied - Lanes{},
              unknown = increment.unknown - Lanes{};
  int place = stretch.place;
  const int end = place + stretch.count;
  for (; place + kLanes <= end; place += kLanes) add_to_cells(tile, place, empty, occupied, unknown);
  if (place == end) return;
  const int first = std::min(place, Tile::kCells - kLanes);
  const Lanes lane = kFirstLanes + first;
  const Lanes inside = (lane >= place) & (lane < end);
  add_to_cells(tile, first, Lanes(empty & inside), Lanes(occupied & inside), Lanes(unknown & inside));
}

/// Where in the table the cells of a stretch look, from the first on; those that fill the last block up look at the
/// vacuous entry.
[[gnu::always_inline]] inline void look_up(const FanStretch& stretch, const FanTable& table, std::int32_t* entry) {
  const std::int32_t vacuous = static_cast<std::int32_t>(table.entries.size()) - 1;
  const float last_row = static_cast<float>(vacuous / FanTable::kAngleBins - 1);
  const float last_angle = static_cast<float>(FanTable::kAngleBins - 1);
  const float y = stretch.y;
  for (std::int32_t begin = 0; begin < stretch.count; begin += kLanes) {
    for (std::int32_t lane = 0; lane < kLanes; ++lane) {
      const std::int32_t i = begin + lane;
      const float x = stretch.x + static_cast<float>(i);
      const float square = std::max(x * x + y * y, 1e-12F);
      const float across = table.axis_x * y - table.axis_y * x;
      const float distance = std::sqrt(square);
      const float row =
          std::max(distance * table.rows_per_cell, distance * table.fine_rows_per_cell + table.first_fine_row);
      const float angle = across * across / square * table.angle_bins;
      const std::int32_t found = static_cast<std::int32_t>(std::min(row, last_row)) * FanTable::kAngleBins +
                                 static_cast<std::int32_t>(std::min(angle, last_angle));
      entry[i] = i < stretch.count ? found : vacuous;
    }
  }
}

/// Adds four table entries to four neighbouring cells: their increments, side by side, become those of the channels.
[[gnu::always_inline]] inline void add_entries(Tile& tile, int place, const TableEntry* entries,
                                               const std::int32_t* entry) {
  std::array<Quad, 4> q;
  for (int i = 0; i < 4; ++i) load(&entries[entry[i]].increment.empty, q[i]);
  const Quad low_01 = __builtin_shufflevector(q[0], q[1], 0, 4, 1, 5);  // empty, empty, occupied, occupied
  const Quad low_23 = __builtin_shufflevector(q[2], q[3], 0, 4, 1, 5);
  const Quad high_01 = __builtin_shufflevector(q[0], q[1], 2, 6, 3, 7);  // unknown, unknown
  const Quad high_23 = __builtin_shufflevector(q[2], q[3], 2, 6, 3, 7);
  add_to_cells(tile, place, Quad(__builtin_shufflevector(low_01, low_23, 0, 1, 4, 5)),
               Quad(__builtin_shufflevector(low_01, low_23, 2, 3, 6, 7)),
               Quad(__builtin_shufflevector(high_01, high_23, 0, 1, 4, 5)));
}

}  // namespace

void add_by_class(Tile& tile, std::span<const Stretch> stretches, std::span<const FixedLogCommonality> increments,
                  grids::Instructions instructions) {
  grids::run_with(
      instructions, [&]() __attribute__((always_inline)) {
        for (const Stretch& stretch : stretches) add_to_stretch(tile, stretch, increments[stretch.region_class]);
      });
}

void add_from_table(std::span<const FanStretch> stretches, const FanTable& table, grids::Instructions instructions) {
  grids::run_with(
      instructions, [&]() __attribute__((always_inline)) {
        std::array<std::int32_t, Tile::kSide> entry;
        const TableEntry* const entries = table.entries.data();
        for (const FanStretch& stretch : stretches) {
          look_up(stretch, table, entry.data());
          const int room =
              Tile::kCells - stretch.place;  // the last four are filled up with vacuous entries where they fit
          int i = 0;
          for (; i < stretch.count && i + 4 <= room; i += 4)
            add_entries(*stretch.tile, stretch.place + i, entries, entry.data() + i);
          for (; i < stretch.count; ++i) {
            const FixedLogCommonality& increment = entries[entry[i]].increment;
            FixedLogCommonality::accumulate(stretch.tile->empty[stretch.place + i], increment.empty);
            FixedLogCommonality::accumulate(stretch.tile->occupied[stretch.place + i], increment.occupied);
            FixedLogCommonality::accumulate(stretch.tile->unknown[stretch.place + i], increment.unknown);
          }
        }
      });
}

}  // namespace credo::mapping
