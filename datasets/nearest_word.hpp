// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace credo::datasets {

/// The word nearest to `word` by edit distance, if it is near enough to be what was meant.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace credo::datasets
