// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace credo::apps {

/// `--format text|json`, as chosen.
struct OutputFormat {
  std::string name = "text";
  [[nodiscard]] bool json() const { return name == "json"; }
};

void add_format_option(CLI::App& command, OutputFormat& format);

/// `--out` names one file, and `--force` lets it replace an older one.
struct OutputFile {
  std::string path;  ///< empty: none
  bool force = false;

  [[nodiscard]] bool wanted() const { return !path.empty(); }
};

/// \param what  "the table", as the help calls what is written
void add_force_option(CLI::App& command, OutputFile& file, const std::string& what);

/// To be called before work that takes long.
/// \throws std::runtime_error if the file is there already and may not be replaced, is a folder, or would be in none
void require_writable(const OutputFile& file);

/// To standard output, indented; numbers that are not finite become null, bytes that are no UTF-8 a replacement.
void print(const nlohmann::ordered_json& value);

/// A number, or null where there is none or it is not finite: JSON has no other.
[[nodiscard]] nlohmann::ordered_json number_or_null(const std::optional<double>& value);

}  // namespace credo::apps
