// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/picture_folder.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

/// The way from one folder to another below it; empty where it is not below.
fs::path way_down(const fs::path& from, const fs::path& to) {
  const fs::path way =
      fs::absolute(to).lexically_normal().lexically_relative(fs::absolute(from / "").lexically_normal());
  return !way.empty() && *way.begin() == ".." ? fs::path() : way;
}

void check(const fs::path& folder, bool force) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() + ": is a file: choose a folder for the pictures");
  if (!force && !fs::is_empty(folder))
    throw std::runtime_error(folder.string() +
                             ": is there already: choose another folder for the pictures, or add --force");
}

}  // namespace

PictureFolder::PictureFolder(fs::path wanted, const fs::path& results, const fs::path& working, bool force)
    : wanted_(std::move(wanted)) {
  const fs::path way = way_down(results, wanted_);
  inside_ = !way.empty();
  drawn_ = working / (inside_ ? way : fs::path(".pictures"));
  if (!inside_) check(wanted_, force);
  fs::create_directories(drawn_);
}

void PictureFolder::publish() const {
  if (inside_) return;
  std::error_code error, ignored;
  const bool made = fs::create_directories(wanted_, error);
  if (!error) fs::copy(drawn_, wanted_, fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
  if (error) {
    if (made) fs::remove_all(wanted_, ignored);
    throw std::runtime_error(wanted_.string() + ": the pictures cannot be written: " + error.message());
  }
  fs::remove_all(drawn_);
}

}  // namespace credo::apps
