// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/results_folder.hpp"

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace credo::results {
namespace {

constexpr const char* kResultsFormat = "format: credo-results/1";

namespace fs = std::filesystem;

/// Credo's own folders say so in the config.yaml at their top, and that is what allows them to be replaced.
bool is_ours(const fs::path& folder) {
  std::ifstream config(folder / "config.yaml");
  for (std::string line; std::getline(config, line);)
    if (line == kResultsFormat) return true;
  return false;
}

}  // namespace

datasets::StagedFolder stage_results(const fs::path& target, bool replace) {
  return {target, [replace](const fs::path& there) {
            if (!replace)
              throw std::runtime_error(there.string() +
                                       ": is there already: choose another folder, or replace it with --force");
            if (!is_ours(there))
              throw std::runtime_error(there.string() +
                                       ": was not written by credo (its config.yaml does not say so), and will not be "
                                       "replaced: choose another folder");
          }};
}

void write_text(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (out) return;
  const std::string reason = errno == 0 ? "for a reason unknown" : std::generic_category().message(errno);
  throw std::runtime_error(file.string() + ": cannot be written: " + reason);
}

}  // namespace credo::results
