// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>

namespace credo::apps {

/// For a datasets::StagedFolder of pictures that replaces none. \throws std::runtime_error always
[[noreturn]] void refuse_older_pictures(const std::filesystem::path& there);

/// Where the pictures of some results are drawn: always with the results that are being written, so that a failure
/// leaves none. Those that belong elsewhere are brought there at the end.
class PictureFolder {
 public:
  /// \param wanted   where the pictures are to be found in the end
  /// \param results  where the results are to be found; \param working  where they are being written
  /// \param force    pictures may be put into a folder that is not empty, where they replace those of older results
  /// \throws std::runtime_error if `wanted` may not be written to
  PictureFolder(std::filesystem::path wanted, const std::filesystem::path& results,
                const std::filesystem::path& working, bool force);

  /// Where to draw.
  [[nodiscard]] const std::filesystem::path& path() const { return drawn_; }

  /// Puts the pictures into their place, if that is not in the results. To be called before the results are finished.
  void publish() const;

 private:
  std::filesystem::path wanted_, drawn_;
  bool inside_;  ///< the results
};

}  // namespace credo::apps
