// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/output.hpp"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace credo::apps {

void add_format_option(CLI::App& command, OutputFormat& format) {
  command.add_option("--format", format.name, "text for people, json for machines")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
}

void add_force_option(CLI::App& command, OutputFile& file, const std::string& what) {
  command.add_flag("-f,--force", file.force, "replace " + what + " that is already there");
}

void require_writable(const OutputFile& file) {
  namespace fs = std::filesystem;
  if (!file.wanted()) return;
  const fs::path path = file.path, folder = path.parent_path();
  if (fs::is_directory(path) || !path.has_filename())
    throw std::runtime_error(file.path + ": is a folder: expected a file of its own for --out");
  if (!folder.empty() && !fs::is_directory(folder))
    throw std::runtime_error(file.path + ": cannot be written: " + folder.string() + " is no folder: make it first");
  if (!file.force && fs::exists(path))
    throw std::runtime_error(file.path + ": is there already: choose another file with --out, or add --force");
}

void print(const nlohmann::ordered_json& value) {
  using nlohmann::ordered_json;
  std::printf("%s\n", value.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value && *value - *value == 0.0 ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace credo::apps
