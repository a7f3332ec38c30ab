// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/staged_folder.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace credo::results {
namespace {

constexpr const char* kResultsFormat = "format: credo-results/1";

namespace fs = std::filesystem;

/// Credo's own folders say so in the config.yaml at their top, and that is what allows them to be replaced.
bool may_be_replaced(const fs::path& folder) {
  if (!fs::is_directory(folder)) return false;
  if (fs::is_empty(folder)) return true;
  std::ifstream config(folder / "config.yaml");
  for (std::string line; std::getline(config, line);)
    if (line == kResultsFormat) return true;
  return false;
}

void check_target(const fs::path& target, bool replace) {
  if (!fs::exists(target) || (fs::is_directory(target) && fs::is_empty(target))) return;
  if (!replace) {
    throw std::runtime_error(target.string() + ": is there already: choose another folder, or replace it with --force");
  }
  if (!may_be_replaced(target)) {
    throw std::runtime_error(target.string() +
                             ": was not written by credo (its config.yaml does not say so), and will not be replaced: "
                             "choose another folder");
  }
}

fs::path without_trailing_separator(fs::path path) {
  path = fs::absolute(path).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

StagedFolder::StagedFolder(fs::path target, bool replace) : target_(without_trailing_separator(std::move(target))) {
  check_target(target_, replace);
  working_ = target_.parent_path() / ("." + target_.filename().string() + ".unfinished");
  std::error_code error;
  fs::remove_all(working_, error);
  if (!fs::create_directories(working_, error) || error) {
    throw std::runtime_error(working_.string() + ": the folder cannot be made: " + error.message());
  }
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(working_, ignored);
}

void StagedFolder::commit() {
  std::error_code error;
  const fs::path old = target_.parent_path() / ("." + target_.filename().string() + ".replaced");
  fs::remove_all(old, error);
  const bool was_there = fs::exists(target_);
  if (was_there) fs::rename(target_, old);
  fs::rename(working_, target_, error);
  if (error) {
    if (was_there) fs::rename(old, target_);
    throw std::runtime_error(target_.string() + ": cannot be written: " + error.message());
  }
  committed_ = true;
  fs::remove_all(old, error);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written: is the disk full?");
}

}  // namespace credo::results
