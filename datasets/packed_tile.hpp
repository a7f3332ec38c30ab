// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "grids/evidential_grid.hpp"

namespace credo::datasets {

/// No packed tile is longer: what does not shrink grows by a few bytes. [bytes]
inline constexpr std::size_t kLargestPackedTile = sizeof(grids::Tile) + 1024;

/// And none is shorter: deflate makes at most 1032 bytes of one. [bytes]
inline constexpr std::size_t kSmallestPackedTile = sizeof(grids::Tile) / 1032;

/// The tile in fewer bytes, to the last bit: deflate of its byte planes. Of the three logarithms the third is nearly
/// the sum of the others, as most readings speak for one side only; what is kept is the difference.
[[nodiscard]] std::string pack(const grids::Tile& tile);

/// \returns whether the bytes are those of a tile: of its size, and no logarithm above zero. If not, `tile` is undefined.
[[nodiscard]] bool unpack(std::string_view packed, grids::Tile& tile);

/// CRC-32, as of gzip and PNG. \param before  that of the bytes before them
[[nodiscard]] std::uint32_t checksum_of(std::string_view bytes, std::uint32_t before = 0);

}  // namespace credo::datasets
