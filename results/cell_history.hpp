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

}  // namespace credo::results
