// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string_view>
#include <vector>

#include "grids/evidential_grid.hpp"

namespace credo::datasets {

/// Writes a map to the last bit, tile by tile: packed and with a checksum each, behind an index, so that a region can
/// be read without the rest (docs/map-files.md). The same map gives the same bytes. Vacuous tiles are left out. Written
/// beside its place first, then renamed.
/// \throws std::runtime_error if it cannot be written; the file that was there is then as it was
void write_grid(const grids::EvidentialGrid& grid, const std::filesystem::path& file);

/// A map file of which header and index are read and checked, and no tile yet: it takes as much memory as its index,
/// 16 bytes for each tile that truly is in the file.
class GridFile {
 public:
  /// \throws FormatError: missing, of another kind or version, cut short, or damaged in header or index
  explicit GridFile(std::filesystem::path file);

  [[nodiscard]] const grids::Georeference& georeference() const { return georeference_; }
  [[nodiscard]] std::size_t tile_count() const { return entries_.size(); }
  /// The cells of all its tiles; empty without any.
  [[nodiscard]] grids::CellBox box() const;

  /// The whole map. \throws FormatError if a tile is damaged; std::length_error if it has more than `most_tiles`
  [[nodiscard]] grids::EvidentialGrid read(std::size_t most_tiles = grids::EvidentialGrid::kMostTiles) const;
  /// The tiles that a region touches, each as a whole; of no other tile a byte is read.
  /// \throws as the whole map does, for these tiles
  [[nodiscard]] grids::EvidentialGrid read(const grids::CellBox& region,
                                           std::size_t most_tiles = grids::EvidentialGrid::kMostTiles) const;

 private:
  struct Entry {
    grids::TileIndex tile;
    std::uint32_t bytes = 0;
    std::uint32_t checksum = 0;
    std::uint64_t place = 0;  ///< in the file
  };

  void read_index(std::istream& in, std::uint64_t tiles, std::uint32_t checksum, std::uint64_t file_bytes);
  [[nodiscard]] Entry entry_of(std::string_view bytes, std::uint64_t place, std::uint64_t file_bytes) const;
  template <typename Wanted>
  [[nodiscard]] grids::EvidentialGrid read_if(Wanted wanted, std::size_t most_tiles) const;

  std::filesystem::path file_;
  grids::Georeference georeference_;
  std::vector<Entry> entries_;
};

}  // namespace credo::datasets
