// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

#include "datasets/map_server.hpp"
#include "grids/evidential_grid.hpp"
#include "grids/readout.hpp"
#include "results/belief_tiff.hpp"

namespace credo::results {

struct MapFolderParams {
  grids::DecisionParams decision = {};                    ///< of map.yaml
  datasets::MapMode mode = datasets::MapMode::kTrinary;   ///< of map.yaml
  BeliefChannels channels = BeliefChannels::kNormalized;  ///< of map_belief.tiff
};

/// Writes a map into a folder: map.cgrid, the map itself, and the pictures of it, map.yaml with its PGM or PNG and
/// map_belief.tiff.
/// \returns whether it has pictures: one of more than grids::kLargestPicture cells has none
/// \throws std::runtime_error if a file cannot be written
[[nodiscard]] bool write_map_folder(const grids::EvidentialGrid& grid, const std::filesystem::path& folder,
                                    const MapFolderParams& params = {});

/// What is believed, cell by cell, and where it lies.
struct BeliefPicture {
  grids::Georeference georeference;  ///< whose cell (0, 0) is the lower left one of the image
  BeliefImage image;
};

/// map_belief.tiff of a results folder, where map.yaml says.
/// \throws std::runtime_error if one is missing, they are not of one size, or the map is turned
[[nodiscard]] BeliefPicture read_belief_picture(const std::filesystem::path& folder);

/// Whether a folder holds a map of a rule that takes readings in one after the other: config.yaml says so.
[[nodiscard]] bool is_rule_map(const std::filesystem::path& folder);

/// The map of a results folder: that of map.cgrid, to the bit. Of a map of a rule, its masses: their conflict divided
/// out, and with as much ignorance as a single reading leaves at least, as commonalities have no certainty. Where there
/// is none, from map.yaml (where it lies) and map_belief.tiff (what is believed), which must hold normalised masses;
/// the commonality ratios are kept then, so that decisions, masses and `contested` come out the same, and the raw
/// conflict does not. \throws std::runtime_error naming the file that is missing or does not fit
[[nodiscard]] grids::EvidentialGrid read_map_folder(const std::filesystem::path& folder);

}  // namespace credo::results
