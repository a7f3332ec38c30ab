// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/grid_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "datasets/format_error.hpp"
#include "datasets/little_endian.hpp"
#include "datasets/packed_tile.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

using namespace std::string_view_literals;
using grids::CellBox;
using grids::EvidentialGrid;
using grids::Georeference;
using grids::Tile;
using grids::TileIndex;

// As PNG's: no text, and told from what a transfer as text makes of it.
constexpr std::string_view kSignature =
    "\x89"
    "CGRID\r\n"sv;
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 64, kEntryBytes = 16;
constexpr std::int32_t kLargestTileIndex = Georeference::kLargestIndex >> Tile::kShift;

struct Header {
  Georeference georeference;
  std::uint64_t tiles = 0;
  std::uint64_t file_bytes = 0;
  std::uint32_t index_checksum = 0;
};

std::string to_bytes(const Header& header) {
  std::string bytes(kSignature);
  put_little_endian(bytes, kVersion, 4);
  put_little_endian(bytes, Tile::kSide, 4);
  for (const double value :
       {header.georeference.resolution_m, header.georeference.origin_x_m, header.georeference.origin_y_m})
    put_little_endian(bytes, std::bit_cast<std::uint64_t>(value), 8);
  put_little_endian(bytes, header.tiles, 8);
  put_little_endian(bytes, header.file_bytes, 8);
  put_little_endian(bytes, header.index_checksum, 4);
  put_little_endian(bytes, checksum_of(bytes), 4);
  return bytes;
}

[[noreturn]] void fail_damaged(const std::filesystem::path& file, const std::string& part,
                               const char* how = "its checksum does not fit") {
  throw FormatError(file, 0, part + " is damaged (" + how + "); restore the file from a copy, or map again");
}

Header read_header(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.size() < kHeaderBytes || !bytes.starts_with(kSignature))
    throw FormatError(file, 0, "is no map file; expected the map.cgrid of `credo map` or `credo run`");
  const auto version = get_little_endian(bytes, 8, 4);
  if (version != kVersion)
    throw FormatError(file, 0,
                      "is a map file of version " + std::to_string(version) + "; expected version " +
                          std::to_string(kVersion) + ": read it with the Credo that wrote it");
  if (get_little_endian(bytes, kHeaderBytes - 4, 4) != checksum_of(bytes.substr(0, kHeaderBytes - 4)))
    fail_damaged(file, "the header");
  if (const auto side = get_little_endian(bytes, 12, 4); side != Tile::kSide)
    throw FormatError(file, 0,
                      "has tiles of " + std::to_string(side) + " x " + std::to_string(side) + " cells; expected " +
                          std::to_string(Tile::kSide) + " x " + std::to_string(Tile::kSide));
  const auto real = [&](std::size_t at) { return std::bit_cast<double>(get_little_endian(bytes, at, 8)); };
  return {.georeference = {.resolution_m = real(16), .origin_x_m = real(24), .origin_y_m = real(32)},
          .tiles = get_little_endian(bytes, 40, 8),
          .file_bytes = get_little_endian(bytes, 48, 8),
          .index_checksum = static_cast<std::uint32_t>(get_little_endian(bytes, 56, 4))};
}

void check_georeference(const std::filesystem::path& file, const Georeference& where) {
  try {
    (void)EvidentialGrid(where);
  } catch (const std::invalid_argument& error) {
    throw FormatError(file, 0, error.what());
  }
}

/// Against the true size, before anything is made room for.
void check_size(const std::filesystem::path& file, const Header& header, std::uint64_t file_bytes) {
  if (file_bytes != header.file_bytes)
    throw FormatError(file, 0,
                      (file_bytes < header.file_bytes ? "is cut short: has " : "has bytes behind its end: ") +
                          std::to_string(file_bytes) + " bytes; expected " + std::to_string(header.file_bytes));
  if (header.tiles > (file_bytes - kHeaderBytes) / kEntryBytes)
    throw FormatError(file, 0,
                      "says it has " + std::to_string(header.tiles) + " tiles; its " + std::to_string(file_bytes) +
                          " bytes have no room for them");
}

CellBox cells_of(TileIndex tile) { return {grids::cell_of(tile, 0), Tile::kSide, Tile::kSide}; }

bool meet(const CellBox& a, const CellBox& b) {
  const auto overlap = [](std::int64_t a_min, std::int64_t a_size, std::int64_t b_min, std::int64_t b_size) {
    return a_min < b_min + b_size && b_min < a_min + a_size;
  };
  return !a.empty() && !b.empty() && overlap(a.min.x, a.width, b.min.x, b.width) &&
         overlap(a.min.y, a.height, b.min.y, b.height);
}

std::string name_of(TileIndex tile) {
  return "the tile of the cells from (" + std::to_string(tile.x * Tile::kSide) + ", " +
         std::to_string(tile.y * Tile::kSide) + ")";
}

}  // namespace

void write_grid(const EvidentialGrid& grid, const std::filesystem::path& file) {
  std::uint64_t tiles = 0;
  for (const auto& entry : grid.tiles()) tiles += entry.second.is_vacuous() ? 0 : 1;
  write_file_whole(file, [&](std::ostream& out) {
    const std::uint64_t tiles_begin = kHeaderBytes + kEntryBytes * tiles;
    out.seekp(static_cast<std::streamoff>(tiles_begin));
    std::string index;
    std::uint64_t file_bytes = tiles_begin;
    for (const auto& [where, tile] : grid.tiles()) {
      if (tile.is_vacuous()) continue;
      const std::string packed = pack(tile);
      out.write(packed.data(), static_cast<std::streamsize>(packed.size()));
      put_little_endian(index, static_cast<std::uint32_t>(where.y), 4);
      put_little_endian(index, static_cast<std::uint32_t>(where.x), 4);
      put_little_endian(index, packed.size(), 4);
      put_little_endian(index, checksum_of(packed), 4);
      file_bytes += packed.size();
    }
    out.seekp(0);
    out << to_bytes({.georeference = grid.georeference(),
                     .tiles = tiles,
                     .file_bytes = file_bytes,
                     .index_checksum = checksum_of(index)})
        << index;
  });
}

GridFile::GridFile(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in = open_binary_file(file_);
  std::string bytes(kHeaderBytes, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  const Header header = read_header(file_, bytes);
  in.seekg(0, std::ios::end);
  const auto file_bytes = static_cast<std::uint64_t>(in.tellg());
  check_size(file_, header, file_bytes);
  check_georeference(file_, header.georeference);
  georeference_ = header.georeference;
  in.seekg(kHeaderBytes);
  read_index(in, header.tiles, header.index_checksum, file_bytes);
}

/// In pieces, each checked before the next is read: a file that says it has more tiles than it has gets no memory.
void GridFile::read_index(std::istream& in, std::uint64_t tiles, std::uint32_t checksum, std::uint64_t file_bytes) {
  constexpr std::uint64_t kPiece = 4096;  // tiles
  std::uint64_t place = kHeaderBytes + kEntryBytes * tiles;
  std::uint32_t found = 0;
  std::string bytes;
  for (std::uint64_t left = tiles; left > 0; left -= std::min(left, kPiece)) {
    bytes.resize(kEntryBytes * std::min(left, kPiece));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::size_t>(in.gcount()) != bytes.size()) fail_damaged(file_, "the index", "it cannot be read");
    found = checksum_of(bytes, found);
    for (std::size_t at = 0; at < bytes.size(); at += kEntryBytes) {
      entries_.push_back(entry_of(std::string_view(bytes).substr(at, kEntryBytes), place, file_bytes));
      place += entries_.back().bytes;
    }
  }
  if (found != checksum) fail_damaged(file_, "the index");
  if (place != file_bytes) fail_damaged(file_, "the index", "the file has bytes that belong to no tile");
}

GridFile::Entry GridFile::entry_of(std::string_view bytes, std::uint64_t place, std::uint64_t file_bytes) const {
  const auto number = [&](std::size_t field) {
    return static_cast<std::uint32_t>(get_little_endian(bytes, 4 * field, 4));
  };
  const auto require = [&](bool holds, const char* what) {
    if (!holds) fail_damaged(file_, "the index", what);
  };
  const Entry entry{.tile = {.y = static_cast<std::int32_t>(number(0)), .x = static_cast<std::int32_t>(number(1))},
                    .bytes = number(2),
                    .checksum = number(3),
                    .place = place};
  require(std::abs(std::int64_t{entry.tile.x}) <= kLargestTileIndex &&
              std::abs(std::int64_t{entry.tile.y}) <= kLargestTileIndex,
          "a tile lies farther off than a map reaches");
  require(entries_.empty() || entries_.back().tile < entry.tile, "its tiles are not in order, or one comes twice");
  require(entry.bytes >= kSmallestPackedTile, "a tile takes fewer bytes than a packed tile can");
  require(entry.bytes <= kLargestPackedTile, "a tile takes more bytes than a packed tile can");
  require(place + entry.bytes <= file_bytes, "its tiles take more bytes than the file has");
  return entry;
}

CellBox GridFile::box() const {
  CellBox box;
  for (const Entry& entry : entries_) box = box.united(cells_of(entry.tile));
  return box;
}

template <typename Wanted>
EvidentialGrid GridFile::read_if(Wanted wanted, std::size_t most_tiles) const {
  std::size_t count = 0;
  for (const Entry& entry : entries_) count += wanted(entry.tile) ? 1 : 0;
  if (count > most_tiles)
    throw std::length_error(file_.string() + ": " + std::to_string(count) + " tiles of " + std::to_string(Tile::kSide) +
                            " x " + std::to_string(Tile::kSide) + " cells are asked for, and " +
                            std::to_string(most_tiles) + " may be held at a time: ask for a smaller region");
  EvidentialGrid grid(georeference_, most_tiles);
  std::ifstream in = open_binary_file(file_);
  std::string packed;
  for (const Entry& entry : entries_) {
    if (!wanted(entry.tile)) continue;
    packed.resize(entry.bytes);
    in.seekg(static_cast<std::streamoff>(entry.place));
    in.read(packed.data(), static_cast<std::streamsize>(packed.size()));
    if (static_cast<std::size_t>(in.gcount()) != packed.size() || checksum_of(packed) != entry.checksum)
      fail_damaged(file_, name_of(entry.tile));
    if (!unpack(packed, grid.tile(entry.tile)))
      throw FormatError(file_, 0, name_of(entry.tile) + " holds no evidence that can be; was it written by Credo?");
  }
  return grid;
}

EvidentialGrid GridFile::read(std::size_t most_tiles) const {
  return read_if([](TileIndex) { return true; }, most_tiles);
}

EvidentialGrid GridFile::read(const CellBox& region, std::size_t most_tiles) const {
  return read_if([&](TileIndex tile) { return meet(region, cells_of(tile)); }, most_tiles);
}

}  // namespace credo::datasets
