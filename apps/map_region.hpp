// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "grids/evidential_grid.hpp"

namespace credo::apps {

/// --region: X Y X Y of two corners [m]; empty is the whole map.
void add_region_option(CLI::App& command, std::vector<double>& region);

/// A map, or of it the tiles that a region touches: of no others is a byte read.
/// \param source  a map.cgrid, or a folder that holds one
/// \throws std::runtime_error if it is neither, or by a rule, which is no sum; as datasets::GridFile
[[nodiscard]] grids::EvidentialGrid read_map_region(const std::string& source, const std::vector<double>& region);

/// Its cells within a region, one on the edge included.
[[nodiscard]] grids::EvidentialGrid cut_out(const grids::EvidentialGrid& grid, const std::vector<double>& region);

}  // namespace credo::apps
