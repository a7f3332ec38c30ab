// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <bitset>
#include <map>
#include <stdexcept>
#include <string>

#include "grids/evidential_grid.hpp"

namespace credo::grids {

/// A map of any cells, without an edge: tiles appear where something was seen. A cell that was not seen is a new one.
template <typename Cell>
class CellGrid {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{1} << 31;

  /// \param most_bytes  that its tiles may take
  /// \throws std::invalid_argument as EvidentialGrid.
  explicit CellGrid(const Georeference& georeference, std::size_t most_bytes = kMostBytes)
      : georeference_(EvidentialGrid(georeference).georeference()), most_tiles_(most_bytes / sizeof(Tile)) {}

  [[nodiscard]] const Georeference& georeference() const { return georeference_; }

  /// A cell to write to, seen from now on. The reference stays valid as long as the grid.
  /// \throws std::length_error if the grid may not hold another tile
  [[nodiscard]] Cell& see(CellIndex cell) {
    Tile& tile = tile_to_write(tile_of(cell));
    const auto place = static_cast<std::size_t>(place_in_tile(cell));
    tile.seen[place] = true;
    return tile.cells[place];
  }
  /// Null where the cell was not seen.
  [[nodiscard]] const Cell* find(CellIndex cell) const {
    const auto found = tiles_.find(tile_of(cell));
    if (found == tiles_.end()) return nullptr;
    const auto place = static_cast<std::size_t>(place_in_tile(cell));
    return found->second.seen[place] ? &found->second.cells[place] : nullptr;
  }
  /// visit(CellIndex, const Cell&) for each seen cell, tile by tile.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (const auto& [index, tile] : tiles_)
      for (int place = 0; place < grids::Tile::kCells; ++place)
        if (tile.seen[static_cast<std::size_t>(place)])
          visit(cell_of(index, place), tile.cells[static_cast<std::size_t>(place)]);
  }

 private:
  struct Tile {
    std::array<Cell, grids::Tile::kCells> cells{};
    std::bitset<grids::Tile::kCells> seen;
  };

  Tile& tile_to_write(TileIndex index) {
    const auto found = tiles_.find(index);
    if (found != tiles_.end()) return found->second;
    if (tiles_.size() >= most_tiles_)
      throw std::length_error("the map has grown to " + std::to_string(most_tiles_ * grids::Tile::kCells) +
                              " cells of " + std::to_string(sizeof(Cell)) +
                              " bytes, and larger it may not become: choose a coarser resolution, or look for a pose "
                              "that is far off");
    return tiles_[index];
  }

  Georeference georeference_;
  std::size_t most_tiles_;
  std::map<TileIndex, Tile> tiles_;
};

}  // namespace credo::grids
