// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace credo::apps {

/// A number by the name under which --fail_above knows it; nothing where there is nothing to measure.
struct GatedValue {
  std::string name;
  std::optional<double> value;
};

/// `--fail_above NAME=VALUE` and `--fail_below NAME=VALUE`, as given.
struct Gates {
  std::vector<std::string> above, below;
};

/// \param names  of the figures that there are
/// \param example  of what may be given, e.g. "rmse=0.1"
void add_fail_above(CLI::App& command, Gates& gates, const std::vector<std::string>& names, const std::string& example);
void add_fail_below(CLI::App& command, Gates& gates, const std::vector<std::string>& names, const std::string& example);

/// \throws std::runtime_error naming the first figure that is beyond its limit or has no value
void require_passed(const Gates& gates, const std::vector<GatedValue>& figures);

}  // namespace credo::apps
