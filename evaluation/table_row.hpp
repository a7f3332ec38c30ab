// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <string>

namespace credo::evaluation {

/// A line of a table of results: name, value, and what the word means.
[[nodiscard]] std::string table_row(const std::string& name, const std::string& value, const std::string& meaning);

/// "97.1 %"; "-" where there is no share.
[[nodiscard]] std::string percent(const std::optional<double>& share);

}  // namespace credo::evaluation
