// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <string>

#include "datasets/staged_folder.hpp"

namespace credo::results {

/// A folder of results to write into. What is not a folder that Credo wrote, or empty, is never replaced.
/// \param replace  a folder that Credo wrote may be replaced (--force)
/// \throws std::runtime_error if the target is there and may not be replaced, or the folder cannot be made
[[nodiscard]] datasets::StagedFolder stage_results(const std::filesystem::path& target, bool replace);

/// A text file, or nothing: \throws std::runtime_error if it could not be written whole.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace credo::results
