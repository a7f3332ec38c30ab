// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <charconv>
#include <string>

namespace credo::evidence {

/// Appends the shortest text that reads back as the same double.
inline void append_number(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace credo::evidence
