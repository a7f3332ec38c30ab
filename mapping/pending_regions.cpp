// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/pending_regions.hpp"

#include <algorithm>
#include <utility>

namespace credo::mapping {
namespace {

using grids::EvidentialGrid;
using grids::TileIndex;

constexpr int kMostSets = 256;            // of at most ln 0.01 to a cell each: half of what it may hold
constexpr std::size_t kMostTiles = 1024;  // 64 MB, if all of them had an outline in them

using TileBox = PendingRegions::TileBox;

std::size_t columns_of(const TileBox& box) { return static_cast<std::size_t>(box.high.x - box.low.x) + 1; }
std::size_t rows_of(const TileBox& box) { return static_cast<std::size_t>(box.high.y - box.low.y) + 1; }
std::size_t tiles_in(const TileBox& box) { return columns_of(box) * rows_of(box); }

TileBox united(const TileBox& a, const TileBox& b) {
  return {{std::min(a.low.y, b.low.y), std::min(a.low.x, b.low.x)},
          {std::max(a.high.y, b.high.y), std::max(a.high.x, b.high.x)}};
}

bool holds(const TileBox& outer, const TileBox& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.high.x >= inner.high.x &&
         outer.high.y >= inner.high.y;
}

}  // namespace

/// Lets the box reach as far; what is pending stays where it is in the map.
void PendingRegions::reach(const TileBox& box) {
  std::vector<std::unique_ptr<TileChanges>> before = std::exchange(tiles_, {});
  const TileBox old = std::exchange(box_, box);
  const std::size_t old_rows = rows_of(old);
  rows_ = static_cast<std::int32_t>(rows_of(box));
  tiles_.resize(tiles_in(box));
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == nullptr) continue;
    const TileIndex index{old.low.y + static_cast<std::int32_t>(i % old_rows),
                          old.low.x + static_cast<std::int32_t>(i / old_rows)};
    const bool kept = holds(box, {index, index});
    (kept ? tiles_[place_of(index)] : unused_.emplace_back()) = std::move(before[i]);
  }
}

std::unique_ptr<TileChanges> PendingRegions::fresh_tile() {
  if (unused_.empty()) return std::make_unique<TileChanges>();
  std::unique_ptr<TileChanges> tile = std::move(unused_.back());
  unused_.pop_back();
  return tile;
}

void PendingRegions::begin_set(EvidentialGrid& grid, const TileBox& box) {
  const std::size_t claimed = tiles_in(box);
  if (sets_ >= kMostSets || tiles_claimed_ + claimed > grid.room()) settle(grid);
  if (!holds(box_, box) || tiles_.empty()) {
    const TileBox both = tiles_.empty() ? box : united(box_, box);
    const bool too_large = tiles_in(both) > kMostTiles;
    if (too_large) settle(grid);
    reach(too_large ? box : both);
  }
  ++sets_;
  tiles_claimed_ += claimed;
}

void PendingRegions::end_set(EvidentialGrid& grid) {
  if (tiles_claimed_ > grid.room()) settle(grid);
}

void PendingRegions::settle_into(EvidentialGrid& grid) {
  for (std::int32_t x = box_.low.x; x <= box_.high.x; ++x) {
    RowEvidence evidence;
    for (std::int32_t y = box_.low.y; y <= box_.high.y; ++y)
      settle_tile(grid, {y, x}, tiles_[place_of({y, x})].get(), evidence);
  }
}

void PendingRegions::settle(EvidentialGrid& grid) {
  if (sets_ == 0) return;
  sets_ = 0;
  if (std::exchange(tiles_claimed_, 0) <= grid.room()) return settle_into(grid);
  EvidentialGrid aside(grid.georeference());
  settle_into(aside);
  grid.merge(aside);  // all of it, or nothing
}

}  // namespace credo::mapping
