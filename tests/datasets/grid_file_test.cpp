// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/grid_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "datasets/format_error.hpp"
#include "datasets/little_endian.hpp"
#include "datasets/packed_tile.hpp"
#include "tests/datasets/temporary_folder.hpp"
#include "tests/support/seeded.hpp"

namespace credo::datasets {
namespace {

using evidence::FixedLogCommonality;
using grids::CellBox;
using grids::EvidentialGrid;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr grids::Georeference kWhere{.resolution_m = 0.05, .origin_x_m = -3.1, .origin_y_m = 1e-3};

/// A map of a few tiles, also left of and below the origin.
EvidentialGrid small_grid() {
  EvidentialGrid grid(kWhere);
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&](std::uint32_t below) { return static_cast<std::int32_t>(random() % below); };
    grid.add({number(300) - 150, number(300) - 150}, {-number(1000), -number(4'000'000), -number(4'100'000)});
  }
  return grid;
}

/// The checksums of header and index are those of what stands there: damage that only a forger makes.
std::string with_checksums(std::string bytes) {
  const auto put = [&bytes](std::size_t at, std::uint32_t value) {
    std::string four;
    put_little_endian(four, value, 4);
    bytes.replace(at, 4, four);
  };
  const auto tiles = static_cast<std::size_t>(get_little_endian(bytes, 40, 8));
  if (tiles <= (bytes.size() - 64) / 16) put(56, checksum_of(std::string_view(bytes).substr(64, 16 * tiles)));
  put(60, checksum_of(std::string_view(bytes).substr(0, 60)));
  return bytes;
}

std::string with_number(std::string bytes, std::size_t at, std::uint64_t value, int count) {
  std::string number;
  put_little_endian(number, value, count);
  return bytes.replace(at, number.size(), number);
}

TEST(GridFile, BringsAMapBackToTheBit) {
  const TemporaryFolder folder;
  const EvidentialGrid grid = small_grid();
  write_grid(grid, folder / "map.cgrid");
  const GridFile file(folder / "map.cgrid");
  EXPECT_EQ(file.read(), grid);
  EXPECT_EQ(file.georeference(), kWhere);
  EXPECT_EQ(file.tile_count(), grid.tiles().size());
  EXPECT_EQ(file.box(), (CellBox{{-192, -192}, 384, 384}));
}

RC_GTEST_PROP(
    GridFile, AnyEvidenceComesBack,
    (const std::vector<std::tuple<std::int16_t, std::int16_t, std::uint32_t, std::uint32_t, std::uint32_t>>& cells)) {
  const TemporaryFolder folder;
  EvidentialGrid grid(kWhere);
  const auto at_most_zero = [](std::uint32_t bits) { return static_cast<std::int32_t>(bits | 0x8000'0000U); };
  for (const auto& [x, y, empty, occupied, unknown] : cells)
    grid.add({x, y}, {at_most_zero(empty), at_most_zero(occupied), at_most_zero(unknown)});
  write_grid(grid, folder / "map.cgrid");
  RC_ASSERT(GridFile(folder / "map.cgrid").read() == grid);
}

TEST(GridFile, AMapThatHoldsNothingComesBack) {
  const TemporaryFolder folder;
  EvidentialGrid grid(kWhere);
  static_cast<void>(grid.tile({3, 4}));  // vacuous
  write_grid(grid, folder / "map.cgrid");
  EXPECT_EQ(std::filesystem::file_size(folder / "map.cgrid"), 64u);
  const GridFile file(folder / "map.cgrid");
  EXPECT_TRUE(file.read().tiles().empty());
  EXPECT_EQ(file.read(), grid);
  EXPECT_TRUE(file.box().empty());
}

TEST(GridFile, TheSameMapGivesTheSameBytesAndNothingBesideThem) {
  const TemporaryFolder folder;
  EvidentialGrid forwards(kWhere), backwards(kWhere);
  for (int i = 0; i < 400; ++i) {
    forwards.add({i, -i}, {-i, -2 * i, -3 * i});
    backwards.add({399 - i, i - 399}, {i - 399, 2 * (i - 399), 3 * (i - 399)});
  }
  write_grid(forwards, folder / "a.cgrid");
  write_grid(backwards, folder / "b.cgrid");
  EXPECT_EQ(read_all(folder / "a.cgrid"), read_all(folder / "b.cgrid"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(GridFile, LoadsTheTilesOfARegion) {
  const TemporaryFolder folder;
  const EvidentialGrid grid = small_grid();
  write_grid(grid, folder / "map.cgrid");
  const GridFile file(folder / "map.cgrid");
  const EvidentialGrid part = file.read(CellBox{{-1, 0}, 2, 64});  // touches two tiles
  ASSERT_EQ(part.tiles().size(), 2u);
  for (const grids::TileIndex tile : {grids::TileIndex{0, -1}, grids::TileIndex{0, 0}})
    EXPECT_EQ(*part.find_tile(tile), *grid.find_tile(tile));
  EXPECT_TRUE(file.read(CellBox{{100'000, 0}, 10, 10}).tiles().empty());
  EXPECT_TRUE(file.read(CellBox{}).tiles().empty());
  EXPECT_EQ(file.read(CellBox{{-(1 << 30), -(1 << 30)}, 2'147'483'647, 2'147'483'647}), grid);
}

TEST(GridFile, ARegionIsReadThoughTheRestIsDamaged) {
  const TemporaryFolder folder;
  const EvidentialGrid grid = small_grid();
  write_grid(grid, folder / "map.cgrid");
  std::string bytes = read_all(folder / "map.cgrid");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);  // of the last tile
  folder.write("map.cgrid", bytes);
  const GridFile file(folder / "map.cgrid");
  EXPECT_EQ(file.read(CellBox{{0, 0}, 1, 1}).at({5, 5}), grid.at({5, 5}));
  EXPECT_THAT([&] { (void)file.read(); },
              ThrowsMessage<FormatError>(
                  AllOf(HasSubstr("map.cgrid"), HasSubstr("the tile of the cells from (128, 128) is damaged"))));
}

TEST(GridFile, NoDamageIsOverlooked) {
  const TemporaryFolder folder;
  EvidentialGrid grid(kWhere);
  grid.add({1, 2}, {-3, -4, -7});
  grid.add({100, 2}, {0, -5, -5});
  write_grid(grid, folder / "map.cgrid");
  const std::string whole = read_all(folder / "map.cgrid");
  const auto refuses = [&](const std::string& bytes) {
    folder.write("map.cgrid", bytes);
    EXPECT_THROW((void)GridFile(folder / "map.cgrid").read(), FormatError);
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    SCOPED_TRACE(i);
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    refuses(flipped);
    refuses(whole.substr(0, i));
  }
  refuses(whole + '\0');
}

TEST(GridFile, SaysWhatIsWrongAndWhatToDo) {
  const TemporaryFolder folder;
  write_grid(small_grid(), folder / "map.cgrid");
  const std::string whole = read_all(folder / "map.cgrid");
  const auto expect_error = [&](const std::string& bytes, const std::string& words) {
    folder.write("map.cgrid", bytes);
    EXPECT_THAT([&] { (void)GridFile(folder / "map.cgrid").read(); },
                ThrowsMessage<FormatError>(AllOf(HasSubstr("map.cgrid: "), HasSubstr(words))));
  };
  expect_error("", "is no map file; expected the map.cgrid of `credo map`");
  expect_error("P5\n2 2\n255\n" + std::string(100, 'x'), "is no map file");
  expect_error(with_number(whole, 8, 7, 4), "of version 7; expected version 1");
  expect_error(whole.substr(0, whole.size() - 5), "is cut short: has ");
  expect_error(with_number(whole, 24, 1, 8), "the header is damaged");
  expect_error(with_number(whole, 70, 1, 1), "the index is damaged");
  expect_error(with_checksums(with_number(whole, 16, 0, 8)), "the resolution of a map must be");
  expect_error(with_checksums(with_number(whole, 12, 32, 4)), "has tiles of 32 x 32 cells; expected 64 x 64");
  EXPECT_THAT([&] { (void)GridFile(folder / "none.cgrid"); }, ThrowsMessage<FormatError>(HasSubstr("no such file")));
  EXPECT_THAT([&] { (void)GridFile(folder.path()); }, ThrowsMessage<FormatError>(HasSubstr("is a folder")));
}

/// Files whose checksums fit, and that lie about everything else: they are refused before room is made for what they
/// say.
TEST(GridFile, AForgedFileGetsNoMemory) {
  const TemporaryFolder folder;
  write_grid(small_grid(), folder / "map.cgrid");
  const std::string whole = read_all(folder / "map.cgrid");
  const auto expect_error = [&](const std::string& bytes, const std::string& words) {
    folder.write("map.cgrid", with_checksums(bytes));
    EXPECT_THAT([&] { (void)GridFile(folder / "map.cgrid").read(); }, ThrowsMessage<FormatError>(HasSubstr(words)));
  };
  expect_error(with_number(whole, 40, std::uint64_t{1} << 60, 8), "have no room for them");
  expect_error(with_number(whole, 40, 1, 8), "bytes that belong to no tile");
  expect_error(with_number(whole, 64, 1U << 30, 4), "lies farther off than a map reaches");
  expect_error(with_number(whole, 64, 0, 4), "not in order");
  expect_error(with_number(whole, 64 + 8, 1U << 30, 4), "more bytes than a packed tile can");
  const std::size_t last = 64 + 16 * (get_little_endian(whole, 40, 8) - 1);
  expect_error(with_number(whole, last + 8, 50'000, 4), "more bytes than the file has");
}

/// One whose index alone would take 64 GiB, were it as long as it says; on disk it takes a block.
TEST(GridFile, AFileOfHolesGetsNoMemory) {
  const TemporaryFolder folder;
  write_grid(small_grid(), folder / "map.cgrid");
  constexpr std::uint64_t kTerabyte = std::uint64_t{1} << 40;
  std::string header = read_all(folder / "map.cgrid").substr(0, 64);
  header = with_number(with_number(header, 40, std::uint64_t{1} << 32, 8), 48, kTerabyte, 8);
  folder.write("map.cgrid", with_checksums(header));
  std::error_code error;
  std::filesystem::resize_file(folder / "map.cgrid", kTerabyte, error);
  if (error) GTEST_SKIP() << "no file of holes can be made here: " << error.message();
  EXPECT_THAT([&] { (void)GridFile(folder / "map.cgrid"); },
              ThrowsMessage<FormatError>(HasSubstr("a tile takes fewer bytes than a packed tile can")));
}

TEST(GridFile, ATileOfForgedEvidenceIsRefused) {
  grids::Tile tile, read;
  tile.empty[17] = 1;  // a logarithm above zero
  EXPECT_FALSE(unpack(pack(tile), read));
  tile.empty[17] = -1;
  const std::string packed = pack(tile);
  EXPECT_TRUE(unpack(packed, read));
  EXPECT_EQ(read, tile);
  EXPECT_FALSE(unpack(packed + "x", read));
  EXPECT_FALSE(unpack(packed.substr(1), read));
  EXPECT_FALSE(unpack("", read));
}

TEST(GridFile, ReadsNoMoreTilesThanItMay) {
  const TemporaryFolder folder;
  write_grid(small_grid(), folder / "map.cgrid");
  const GridFile file(folder / "map.cgrid");
  EXPECT_THAT([&] { (void)file.read(3); }, ThrowsMessage<std::length_error>(HasSubstr("ask for a smaller region")));
  EXPECT_EQ(file.read(CellBox{{0, 0}, 1, 1}, 1).tiles().size(), 1u);
}

TEST(GridFile, WhatWasThereStaysWhereTheNewCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_grid(small_grid(), folder / "missing" / "map.cgrid"), std::runtime_error);
  std::filesystem::create_directory(folder / "map.cgrid");
  folder.write("map.cgrid/keep", "me");
  EXPECT_THROW(write_grid(small_grid(), folder / "map.cgrid"), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace credo::datasets
