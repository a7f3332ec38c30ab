// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/packed_tile.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

namespace credo::datasets {
namespace {

using grids::Tile;

constexpr int kPlanes = 4, kChannels = 3;
constexpr std::size_t kPlaneBytes = Tile::kCells;
constexpr int kLevel = 4;  // of zlib: on laser maps 4 % smaller than level 1, and 1.5 % larger than level 6
using Planes = std::array<std::uint8_t, kChannels * kPlanes * kPlaneBytes>;

/// Small numbers of either sign become small ones without: 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
constexpr std::uint32_t folded(std::uint32_t value) { return (value << 1) ^ (0U - (value >> 31)); }
constexpr std::uint32_t unfolded(std::uint32_t value) { return (value >> 1) ^ (0U - (value & 1U)); }

/// What is kept of a cell, modulo 2^32 so that nothing is lost at the floor.
std::array<std::uint32_t, kChannels> kept(std::int32_t empty, std::int32_t occupied, std::int32_t unknown) {
  const auto e = static_cast<std::uint32_t>(empty), o = static_cast<std::uint32_t>(occupied);
  return {0U - e, 0U - o, folded(static_cast<std::uint32_t>(unknown) - e - o)};
}

void put_in_planes(Planes& planes, int channel, int cell, std::uint32_t value) {
  for (int plane = 0; plane < kPlanes; ++plane)
    planes[static_cast<std::size_t>(channel * kPlanes + plane) * kPlaneBytes + static_cast<std::size_t>(cell)] =
        static_cast<std::uint8_t>(value >> (8 * plane));
}

std::uint32_t from_planes(const Planes& planes, int channel, int cell) {
  std::uint32_t value = 0;
  for (int plane = 0; plane < kPlanes; ++plane)
    value |=
        std::uint32_t{
            planes[static_cast<std::size_t>(channel * kPlanes + plane) * kPlaneBytes + static_cast<std::size_t>(cell)]}
        << (8 * plane);
  return value;
}

}  // namespace

std::string pack(const Tile& tile) {
  Planes planes;
  for (int cell = 0; cell < Tile::kCells; ++cell) {
    const auto values = kept(tile.empty[cell], tile.occupied[cell], tile.unknown[cell]);
    for (int channel = 0; channel < kChannels; ++channel) put_in_planes(planes, channel, cell, values[channel]);
  }
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, planes.data(), planes.size(), kLevel) != Z_OK)
    throw std::bad_alloc();  // the only way to fail with room for the bound
  packed.resize(size);
  return packed;
}

bool unpack(std::string_view packed, Tile& tile) {
  Planes planes;
  uLongf size = planes.size();
  uLong used = packed.size();
  const int code = uncompress2(planes.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), &used);
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  if (code != Z_OK || size != planes.size() || used != packed.size()) return false;
  std::int32_t highest = 0;
  for (int cell = 0; cell < Tile::kCells; ++cell) {
    const std::uint32_t empty = 0U - from_planes(planes, 0, cell), occupied = 0U - from_planes(planes, 1, cell);
    tile.empty[cell] = static_cast<std::int32_t>(empty);
    tile.occupied[cell] = static_cast<std::int32_t>(occupied);
    tile.unknown[cell] = static_cast<std::int32_t>(unfolded(from_planes(planes, 2, cell)) + empty + occupied);
    highest = std::max({highest, tile.empty[cell], tile.occupied[cell], tile.unknown[cell]});
  }
  return highest == 0;
}

std::uint32_t checksum_of(std::string_view bytes, std::uint32_t before) {
  const auto* const data = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(crc32_z(before, data, bytes.size()));
}

}  // namespace credo::datasets
