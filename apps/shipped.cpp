// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/shipped.hpp"

#include <set>
#include <stdexcept>

namespace credo::apps {

std::filesystem::path find_shipped(const std::string& name, const ShippedFiles& files) {
  namespace fs = std::filesystem;
  // A folder may well have the name of the world that was simulated into it.
  if (fs::exists(name) && !fs::is_directory(name)) return name;
  std::error_code ignored;
  const fs::path binary = fs::read_symlink("/proc/self/exe", ignored);
  std::set<std::string> known;
  for (const fs::path& folder :
       {binary.parent_path() / ".." / "share" / "credo" / files.installed, fs::path(files.source)}) {
    if (fs::is_regular_file(folder / (name + ".yaml"))) return folder / (name + ".yaml");
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".yaml") known.insert(entry.path().stem().string());
  }
  if (fs::is_directory(name)) return name;
  const std::string what = files.what;
  std::string message = name + ": no such " + what + " file; " + what + "s that come with credo:";
  if (*files.besides != '\0') message += std::string(" ") + files.besides;
  for (const std::string& one : known) message += " " + one;
  throw std::runtime_error(message);
}

}  // namespace credo::apps
