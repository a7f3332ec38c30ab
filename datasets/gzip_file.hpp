// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace credo::datasets {

/// The first bytes of a file, at least `limit` where there are that many, unpacked where it is gzipped.
/// \throws FormatError: missing, not readable, truncated or damaged
[[nodiscard]] std::string read_unpacked(const std::filesystem::path& file, std::size_t limit);

}  // namespace credo::datasets
