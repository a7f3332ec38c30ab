// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "evidence/log_commonality.hpp"
#include "grids/georeference.hpp"

namespace credo::grids {

/// A tile by its column and row; tile (0, 0) starts with cell (0, 0). Ordered by row, then column.
struct TileIndex {
  std::int32_t y = 0;
  std::int32_t x = 0;

  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

/// A square of cells, one array per channel of evidence::FixedLogCommonality, row after row from the lowest; all zero
/// is vacuous.
struct Tile {
  static constexpr int kShift = 6;
  static constexpr int kSide = 1 << kShift;  // cells
  static constexpr int kCells = kSide * kSide;

  alignas(64) std::array<std::int32_t, kCells> empty{};     ///< ln q(empty)
  alignas(64) std::array<std::int32_t, kCells> occupied{};  ///< ln q(occupied)
  alignas(64) std::array<std::int32_t, kCells> unknown{};   ///< ln q(empty or occupied)

  [[nodiscard]] bool is_vacuous() const;
  [[nodiscard]] bool is_saturated() const;  ///< a cell has reached the end of its range: it has lost evidence
  friend bool operator==(const Tile&, const Tile&) = default;
};

/// The tile that holds a cell, and the place of the cell in the tile's arrays.
[[nodiscard]] constexpr TileIndex tile_of(CellIndex cell) { return {cell.y >> Tile::kShift, cell.x >> Tile::kShift}; }
[[nodiscard]] constexpr int place_in_tile(CellIndex cell) {
  return ((cell.y & (Tile::kSide - 1)) << Tile::kShift) | (cell.x & (Tile::kSide - 1));
}

/// The cell at a place of a tile's arrays.
[[nodiscard]] constexpr CellIndex cell_of(TileIndex tile, int place) {
  return {(tile.x << Tile::kShift) + (place & (Tile::kSide - 1)), (tile.y << Tile::kShift) + (place >> Tile::kShift)};
}

/// An evidential grid map: every cell is a product of commonalities, kept as a fixed-point logarithm. An update is
/// three integer additions, so is a merge, and the sum is the same to the last bit whatever the order, the thread or
/// the robot. The grid has no edge: tiles appear where there is evidence, and an absent tile is vacuous. A cell that
/// has taken in so much that it reaches the floor of its range (evidence::FixedLogCommonality) stays there; its tile is
/// reported.
class EvidentialGrid {
 public:
  /// 1.6 GB (12 bytes per cell of a tile, and 64 per tile): with cells of 5 cm a third of the tiles of a square
  /// kilometre, or a square of 580 m that was seen all over.
  static constexpr std::size_t kMostTiles = std::size_t{1} << 15;

  EvidentialGrid() : EvidentialGrid(Georeference{}) {}
  /// \param most_tiles  that it may hold; a map that needs more has too fine a resolution, or a pose that is far off
  /// \throws std::invalid_argument unless the resolution is finite and above zero and the origin finite.
  explicit EvidentialGrid(const Georeference& georeference, std::size_t most_tiles = kMostTiles);

  [[nodiscard]] const Georeference& georeference() const { return georeference_; }

  /// What is known of a cell; vacuous where nothing was added.
  [[nodiscard]] evidence::FixedLogCommonality at(CellIndex cell) const;
  /// Combines one more piece of evidence into a cell (unnormalised conjunctive rule).
  void add(CellIndex cell, const evidence::FixedLogCommonality& increment);

  /// The tile to write to; made when absent. The reference stays valid until the tile is pruned or the grid dies.
  /// \throws std::length_error if the grid may not hold another tile; so do `add` and `merge`
  [[nodiscard]] Tile& tile(TileIndex index);
  /// How many tiles it may still be given.
  [[nodiscard]] std::size_t room() const { return most_tiles_ - tiles_.size(); }
  /// The tile to read from; null when absent.
  [[nodiscard]] const Tile* find_tile(TileIndex index) const;
  /// All tiles, by row and column.
  [[nodiscard]] const std::map<TileIndex, Tile>& tiles() const { return tiles_; }

  /// Combines another robot's, or another sensor's, map of the same georeference: commutative and associative to the
  /// bit. Evidence that both maps hold is counted twice: merge maps of disjoint readings.
  /// \throws std::invalid_argument if the georeferences differ.
  void merge(const EvidentialGrid& other);
  /// Takes back what `merge` added: the grid is as if `other` had never been merged, but for cells at the floor, which
  /// stay.
  /// \throws std::invalid_argument if the georeferences differ, or a cell holds less evidence than is to be taken out,
  ///         so that `other` cannot have been merged; the grid is unchanged then.
  void remove(const EvidentialGrid& other);
  /// Drops the tiles that hold no evidence.
  void prune();

  /// The tiles in which a cell has reached the end of its range; ordered.
  [[nodiscard]] std::vector<TileIndex> saturated_tiles() const;

  /// The smallest box that holds all evidence; empty for a vacuous grid.
  [[nodiscard]] CellBox bounding_box() const;

  /// Same georeference and same evidence in every cell; a vacuous tile equals an absent one.
  friend bool operator==(const EvidentialGrid& a, const EvidentialGrid& b);

 private:
  Georeference georeference_;
  std::size_t most_tiles_;
  std::map<TileIndex, Tile> tiles_;
};

}  // namespace credo::grids
