// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

#include "geometry/floor_plan.hpp"

namespace credo::datasets {

/// Reads a floor_plan.yaml (docs/dataset-format.md).
/// \throws FormatError with file and line: no walls, a wall without length, a value that is not finite, an unknown key,
/// ...
[[nodiscard]] geometry::FloorPlan read_floor_plan(const std::filesystem::path& file);

/// Writes a floor_plan.yaml, with 6 decimals, by way of a temporary file beside it.
/// \throws std::invalid_argument if the plan has no walls or a value that is not finite; std::runtime_error if the file
/// cannot be written.
void write_floor_plan(const std::filesystem::path& file, const geometry::FloorPlan& plan);

}  // namespace credo::datasets
