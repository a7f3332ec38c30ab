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

/// The tile in fewer bytes, to the last bit: deflate of its byte planes. Of the three logarithms the third is nearly
/// the sum of the others, as most readings speak for one side only; what is kept is the difference.
[[nodiscard]] std::string pack(const grids::Tile& tile);

/// \returns whether the bytes are those of a tile: of its size, and no logarithm above zero. If not, `tile` is undefined.
[[nodiscard]] bool unpack(std::string_view packed, grids::Tile& tile);

/// CRC-32, as of gzip and PNG.
[[nodiscard]] std::uint32_t checksum_of(std::string_view bytes);

}  // namespace credo::datasets
