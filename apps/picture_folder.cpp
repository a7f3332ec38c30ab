// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/picture_folder.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

constexpr std::string_view kOfMoments[] = {"omni_", "scan_", "plan_"};  // and a number
constexpr std::string_view kOfTheWhole[] = {"errors",
                                            "beliefs",
                                            "map",
                                            "map_empty",
                                            "map_occupied",
                                            "map_contested",
                                            "map_unknown",
                                            "map_conflict",
                                            "map_plausibility",
                                            "map_pignistic",
                                            "map_dsmp",
                                            "map_relief",
                                            "map_since",
                                            "map_changes",
                                            "positions_paper",
                                            "positions_default",
                                            "edge_life",
                                            "wall_between"};

/// Whether results have pictures of this name, which tells older ones from what else a person keeps beside them.
bool is_drawn_here(std::string_view name) {
  constexpr std::string_view kSuffix = ".png";
  if (!name.ends_with(kSuffix)) return false;
  name.remove_suffix(kSuffix.size());
  if (std::ranges::find(kOfTheWhole, name) != std::ranges::end(kOfTheWhole)) return true;
  return std::ranges::any_of(kOfMoments, [&](std::string_view start) {
    return name.starts_with(start) && name.size() > start.size() &&
           name.find_first_not_of("0123456789", start.size()) == std::string_view::npos;
  });
}

/// Pictures in `folder` that are not among the new ones.
void remove_older(const fs::path& folder, const fs::path& newer) {
  std::vector<fs::path> older;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_drawn_here(entry.path().filename().string()) && !fs::exists(newer / entry.path().filename()))
      older.push_back(entry.path());
  for (const fs::path& picture : older) fs::remove(picture);
}

}  // namespace

void refuse_older_pictures(const fs::path& there) {
  throw std::runtime_error(there.string() + ": is there already: choose another folder for the pictures");
}

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
  remove_older(wanted_, drawn_);
  fs::remove_all(drawn_);
}

}  // namespace credo::apps
