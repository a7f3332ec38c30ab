// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "grids/georeference.hpp"
#include "mapping/map_rule.hpp"

namespace credo::results {

/// Writes history.csv: a row for each settled cell, with its centre [m], its state, since when it is in it [s], and how
/// often it changed.
/// \throws std::runtime_error if it cannot be written
void write_cell_history(std::span<const mapping::CellHistory> history, const grids::Georeference& georeference,
                        const std::filesystem::path& file);

/// Reads it.
/// \throws datasets::FormatError with file and line where a row is none
[[nodiscard]] std::vector<mapping::CellHistory> read_cell_history(const std::filesystem::path& file,
                                                                  const grids::Georeference& georeference);

/// map_since.png: the later a cell came into its state, the bluer; and map_changes.png: the oftener it changed, the
/// redder. With the scale beside them; grey is what is in no state, or was not seen.
/// \param where  the cells that are drawn
/// \throws std::runtime_error if a file cannot be written
void write_cell_history_pictures(std::span<const mapping::CellHistory> history, const grids::CellBox& where,
                                 const std::filesystem::path& folder);

}  // namespace credo::results
