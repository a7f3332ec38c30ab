// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace credo::datasets {

/// A folder that is filled beside its place, as .NAME.unfinished, and takes its name when it is whole: nothing
/// half-written is ever found, and a failure leaves what was there. What a process that died left unfinished, the next
/// one that writes to the same place removes.
class StagedFolder {
 public:
  /// Throws, with the reason, if a folder or file that is there may not be replaced.
  using RequireReplaceable = std::function<void(const std::filesystem::path&)>;

  /// Makes the folder to write into.
  /// \param require_replaceable  is asked where the target is there, and no empty folder, now and before it is replaced
  /// \throws std::runtime_error if the folder cannot be made, or another process is writing to the same place
  StagedFolder(std::filesystem::path target, RequireReplaceable require_replaceable);
  /// Removes what was not committed, and the folders above that were made for it.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& path() const { return working_; }

  /// Gives the folder its place.
  /// \throws std::runtime_error if that fails; the target is then as it was
  void commit();

 private:
  void check_target() const;
  void make_working_folder();
  void remove_made_above();

  std::filesystem::path target_, working_;
  std::vector<std::filesystem::path> made_above_;  ///< the innermost first
  RequireReplaceable require_replaceable_;
  int lock_ = -1;  ///< held on the working folder as long as this process lives
  bool committed_ = false;
};

}  // namespace credo::datasets
