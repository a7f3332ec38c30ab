// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace credo::apps {

/// The whole of a text as a number; false where it is none.
template <typename Number>
[[nodiscard]] bool parse(const std::string& text, Number& number) {
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(begin, end, number);
  return result.ec == std::errc{} && result.ptr == end;
}

/// A check of a numeric option: from `low` to `high`. CLI11 alone takes nan and inf for numbers, and -1 for a very
/// large unsigned one.
template <typename Number>
[[nodiscard]] CLI::Validator number_in(Number low, Number high) {
  const std::string range = fmt::format("from {} to {}", low, high);
  return CLI::Validator(
      [low, high, range](const std::string& text) -> std::string {
        Number number{};
        if (parse(text, number) && number >= low && number <= high) return "";
        return fmt::format("expected a {}number {}, found '{}'", std::is_integral_v<Number> ? "whole " : "", range,
                           text);
      },
      range);
}

/// A check of a path. CLI11 alone takes "" for one.
[[nodiscard]] inline CLI::Validator a_path() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        return text.empty() ? "expected a file or a folder, found an empty name" : "";
      },
      "");
}

/// Every seed is as good as any other.
[[nodiscard]] inline CLI::Validator any_seed() {
  return number_in<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max());
}

/// The side of a map cell [m]. What fits the sensors is narrower (mapping/resolution_fit.hpp).
[[nodiscard]] inline CLI::Validator any_resolution() { return number_in(0.001, 10.0); }

}  // namespace credo::apps
