// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "grids/evidential_grid.hpp"

namespace credo::results {

/// What the four channels of map_belief.tiff are.
enum class BeliefChannels {
  kNormalized,  ///< m(empty), m(occupied), contested, m(unknown), after Dempster's normalisation
  kRaw,         ///< m(empty), m(occupied), m(conflict), m(unknown), unnormalised
};

/// Four floats per cell; the top row of the map first, as pictures have it.
struct BeliefImage {
  int width = 0;
  int height = 0;
  std::vector<std::array<float, 4>> pixels;

  friend bool operator==(const BeliefImage&, const BeliefImage&) = default;
};

/// The grid's bounding box as a picture: the same rectangle as the map_server picture of the same grid. A vacuous grid
/// gives one vacuous pixel.
[[nodiscard]] BeliefImage belief_image(const grids::EvidentialGrid& grid,
                                       BeliefChannels channels = BeliefChannels::kNormalized);

/// Writes a baseline TIFF: little endian, one strip, uncompressed, four interleaved 32-bit IEEE floats per pixel.
/// Written beside its place first, then renamed.
/// \throws std::runtime_error if it cannot be written; the message names the file.
void write_belief_tiff(const BeliefImage& image, const std::filesystem::path& file);

/// Reads what `write_belief_tiff` writes.
/// \throws std::runtime_error if it is another kind of file; the message names the file and what was expected.
[[nodiscard]] BeliefImage read_belief_tiff(const std::filesystem::path& file);

}  // namespace credo::results
