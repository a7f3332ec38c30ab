// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace credo::datasets {

/// Appends `value` with a fixed number of decimals; "nan", "inf" and "-inf" as such. The same bytes everywhere,
/// whatever the locale.
inline void append_fixed(std::string& text, double value, int decimals) {
  char buffer[400];
  if (value == 0.0) value = 0.0;  // no "-0"
  if (std::isnan(value)) value = std::abs(value);
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  text.append(buffer, result.ptr);
}

/// Appends the shortest text that reads back as `value`.
inline void append_shortest(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace credo::datasets
