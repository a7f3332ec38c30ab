// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/output.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace credo::apps {

void add_format_option(CLI::App& command, OutputFormat& format) {
  command.add_option("--format", format.name, "text for people, json for machines")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
}

void print(const nlohmann::ordered_json& value) {
  using nlohmann::ordered_json;
  std::printf("%s\n", value.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value && *value - *value == 0.0 ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace credo::apps
