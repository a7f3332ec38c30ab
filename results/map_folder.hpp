// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

#include "grids/evidential_grid.hpp"

namespace credo::results {

/// The map of a results folder, from map.yaml (where it lies) and map_belief.tiff (what is believed), which must hold
/// normalised masses. The commonality ratios are kept, so that decisions, masses and `contested` come out the same; the
/// raw conflict does not.
/// \throws std::runtime_error naming the file that is missing or does not fit
[[nodiscard]] grids::EvidentialGrid read_map_folder(const std::filesystem::path& folder);

}  // namespace credo::results
