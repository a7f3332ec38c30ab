// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <string>

namespace credo::results {

/// A folder that is filled beside its place and takes its name when it is whole: nothing half-written is ever found, and a
/// failure leaves what was there.
class StagedFolder {
 public:
  /// Makes the folder to write into. What is not a folder that Credo wrote, or empty, is never replaced.
  /// \param replace  a folder that Credo wrote may be replaced (--force)
  /// \throws std::runtime_error if the target is there and may not be replaced, or the folder cannot be made
  StagedFolder(std::filesystem::path target, bool replace);
  /// Removes what was not committed.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& path() const { return working_; }

  /// Gives the folder its place.
  /// \throws std::runtime_error if that fails; the target is then as it was
  void commit();

 private:
  std::filesystem::path target_, working_;
  bool committed_ = false;
};

/// A text file, or nothing: \throws std::runtime_error if it could not be written whole.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace credo::results
