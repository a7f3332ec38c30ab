// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/format_error.hpp"

#include <utility>

namespace credo::datasets {

FormatError::FormatError(std::filesystem::path file, int line, const std::string& message)
    : std::runtime_error(file.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": " + message),
      file_(std::move(file)),
      line_(line) {}

}  // namespace credo::datasets
