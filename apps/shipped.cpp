// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/shipped.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <stdexcept>
#include <vector>

#include "datasets/nearest_word.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

/// Where they are looked for: beside the installed program, then in the source tree.
std::vector<fs::path> folders_of(const ShippedFiles& files) {
  std::error_code ignored;
  const fs::path binary = fs::read_symlink("/proc/self/exe", ignored);
  return {binary.parent_path() / ".." / "share" / "credo" / files.installed, files.source};
}

std::vector<std::string> known_names(const ShippedFiles& files) {
  std::set<std::string> names;
  for (const fs::path& folder : folders_of(files)) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  }
  std::vector<std::string> known(names.begin(), names.end());
  if (*files.besides != '\0') known.insert(known.begin(), files.besides);
  return known;
}

}  // namespace

fs::path find_shipped(const std::string& name, const ShippedFiles& files) {
  // A folder may well have the name of the world that was simulated into it.
  if (fs::exists(name) && !fs::is_directory(name)) return name;
  for (const fs::path& folder : folders_of(files))
    if (fs::is_regular_file(folder / (name + ".yaml"))) return folder / (name + ".yaml");
  if (fs::is_directory(name)) return name;
  const std::vector<std::string> known = known_names(files);
  const auto nearest = datasets::nearest_word(name, known);
  throw std::runtime_error(fmt::format("{}: no such {} file{}; {}s that come with credo: {}", name, files.what,
                                       nearest ? "; did you mean '" + *nearest + "'?" : "", files.what,
                                       fmt::join(known, " ")));
}

}  // namespace credo::apps
