// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/evidential_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "grids/instructions.hpp"

namespace credo::grids {
namespace {

using evidence::FixedLogCommonality;
using Channel = std::array<std::int32_t, Tile::kCells>;

bool all_zero(const Channel& channel) {
  std::int32_t bits = 0;
  for (const std::int32_t value : channel) bits |= value;
  return bits == 0;
}

bool at_floor(const Channel& channel) {
  return std::ranges::find(channel, FixedLogCommonality::kFloor) != channel.end();
}

void add_channel(Channel& to, const Channel& from) {
  run_with(
      best_instructions(), [&]() __attribute__((always_inline)) {
        for (int i = 0; i < Tile::kCells; ++i) FixedLogCommonality::accumulate(to[i], from[i]);
      });
}

void subtract_channel(Channel& from, const Channel& what) {
  for (int i = 0; i < Tile::kCells; ++i) {
    if (from[i] != FixedLogCommonality::kFloor) from[i] -= what[i];
  }
}

/// No logarithm may come out above zero.
bool holds_as_much(const Channel& channel, const Channel& what) {
  bool holds = true;
  for (int i = 0; i < Tile::kCells; ++i) holds &= channel[i] <= what[i];
  return holds;
}

std::string describe(const Georeference& g) {
  return std::to_string(g.resolution_m) + " m from (" + std::to_string(g.origin_x_m) + ", " +
         std::to_string(g.origin_y_m) + ")";
}

void require_same(const Georeference& a, const Georeference& b) {
  if (!(a == b))
    throw std::invalid_argument("maps of different cells cannot be merged exactly: one has cells of " + describe(a) +
                                ", the other of " + describe(b) + "; make both with the same resolution and origin");
}

/// The box of the cells of a tile that hold evidence, in cells from the tile's corner.
CellBox evidence_box(const Tile& tile) {
  CellIndex low{Tile::kSide, Tile::kSide}, high{-1, -1};
  for (std::int32_t y = 0; y < Tile::kSide; ++y) {
    for (std::int32_t x = 0; x < Tile::kSide; ++x) {
      const int i = y * Tile::kSide + x;
      if ((tile.empty[i] | tile.occupied[i] | tile.unknown[i]) == 0) continue;
      low = {std::min(low.x, x), std::min(low.y, y)};
      high = {std::max(high.x, x), std::max(high.y, y)};
    }
  }
  return {low, high.x - low.x + 1, high.y - low.y + 1};
}

}  // namespace

bool Tile::is_saturated() const { return at_floor(empty) || at_floor(occupied) || at_floor(unknown); }

bool Tile::is_vacuous() const { return all_zero(empty) && all_zero(occupied) && all_zero(unknown); }

EvidentialGrid::EvidentialGrid(const Georeference& georeference, std::size_t most_tiles)
    : georeference_(georeference), most_tiles_(most_tiles) {
  if (!(georeference.resolution_m > 0.0 && std::isfinite(georeference.resolution_m)))
    throw std::invalid_argument("the resolution of a map must be a finite number of metres above 0, not " +
                                std::to_string(georeference.resolution_m));
  if (!std::isfinite(georeference.origin_x_m) || !std::isfinite(georeference.origin_y_m))
    throw std::invalid_argument("the origin of a map must be finite");
}

FixedLogCommonality EvidentialGrid::at(CellIndex cell) const {
  const Tile* tile = find_tile(tile_of(cell));
  if (tile == nullptr) return {};
  const int i = place_in_tile(cell);
  return {tile->empty[i], tile->occupied[i], tile->unknown[i]};
}

void EvidentialGrid::add(CellIndex cell, const FixedLogCommonality& increment) {
  Tile& to = tile(tile_of(cell));
  const int i = place_in_tile(cell);
  const FixedLogCommonality sum = FixedLogCommonality{to.empty[i], to.occupied[i], to.unknown[i]} + increment;
  to.empty[i] = sum.empty;
  to.occupied[i] = sum.occupied;
  to.unknown[i] = sum.unknown;
}

Tile& EvidentialGrid::tile(TileIndex index) {
  const auto found = tiles_.lower_bound(index);
  if (found != tiles_.end() && found->first == index) return found->second;
  if (tiles_.size() >= most_tiles_)
    throw std::length_error("the map has grown to " + std::to_string(most_tiles_ * Tile::kCells) + " cells of " +
                            std::to_string(georeference_.resolution_m) +
                            " m, and larger it may not become: choose a coarser resolution, or look for a pose that is "
                            "far off");
  return tiles_.try_emplace(found, index)->second;
}

const Tile* EvidentialGrid::find_tile(TileIndex index) const {
  const auto found = tiles_.find(index);
  return found == tiles_.end() ? nullptr : &found->second;
}

void EvidentialGrid::merge(const EvidentialGrid& other) {
  require_same(georeference_, other.georeference_);
  for (const auto& entry : other.tiles_) static_cast<void>(tile(entry.first));  // all the room before the first change
  for (const auto& [index, from] : other.tiles_) {
    Tile& to = tile(index);
    add_channel(to.empty, from.empty);
    add_channel(to.occupied, from.occupied);
    add_channel(to.unknown, from.unknown);
  }
}

void EvidentialGrid::remove(const EvidentialGrid& other) {
  require_same(georeference_, other.georeference_);
  for (const auto& [index, what] : other.tiles_) {
    const Tile* tile = find_tile(index);
    const bool holds = tile == nullptr
                           ? what.is_vacuous()
                           : holds_as_much(tile->empty, what.empty) && holds_as_much(tile->occupied, what.occupied) &&
                                 holds_as_much(tile->unknown, what.unknown);
    if (!holds)
      throw std::invalid_argument("the map that is to be taken out was not merged into this one: this one holds less");
  }
  for (const auto& [index, what] : other.tiles_) {
    const auto found = tiles_.find(index);
    if (found == tiles_.end()) continue;
    subtract_channel(found->second.empty, what.empty);
    subtract_channel(found->second.occupied, what.occupied);
    subtract_channel(found->second.unknown, what.unknown);
  }
  prune();
}

std::vector<TileIndex> EvidentialGrid::saturated_tiles() const {
  std::vector<TileIndex> result;
  for (const auto& [index, tile] : tiles_) {
    if (tile.is_saturated()) result.push_back(index);
  }
  return result;
}

void EvidentialGrid::prune() {
  std::erase_if(tiles_, [](const auto& entry) { return entry.second.is_vacuous(); });
}

CellBox EvidentialGrid::bounding_box() const {
  CellBox box;
  for (const auto& [index, tile] : tiles_) {
    CellBox part = evidence_box(tile);
    part.min.x += index.x * Tile::kSide;
    part.min.y += index.y * Tile::kSide;
    box = box.united(part);
  }
  return box;
}

bool operator==(const EvidentialGrid& a, const EvidentialGrid& b) {
  const auto held = [](const EvidentialGrid& one, const EvidentialGrid& other) {
    return std::all_of(one.tiles_.begin(), one.tiles_.end(), [&](const auto& entry) {
      const Tile* tile = other.find_tile(entry.first);
      return tile != nullptr ? *tile == entry.second : entry.second.is_vacuous();
    });
  };
  return a.georeference_ == b.georeference_ && held(a, b) && held(b, a);
}

}  // namespace credo::grids
