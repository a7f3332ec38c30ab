// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/samples.hpp"
#include "results/localization_table.hpp"

// Several runs, each with its truth, as the sub-commands of evaluate that pool them are given.
namespace credo::apps {

/// `REF RESULT [REF RESULT ...]` and `--runs LIST`, as given.
struct RunPaths {
  std::vector<std::string> pairs;
  std::string list;
};

void add_run_options(CLI::App& command, RunPaths& paths);

/// One run, as read.
struct RunFiles {
  std::string reference, result;
};

/// Those of the command line, then those of the list: a file with a reference and a result in each line, separated by
/// blanks or a tab, relative to the file; # begins a comment.
/// \throws CLI::ValidationError if there is none or one lacks its result, std::runtime_error with file and line for a
///   list that cannot be read
[[nodiscard]] std::vector<RunFiles> run_files(const RunPaths& paths, const std::string& command);

}  // namespace credo::apps
