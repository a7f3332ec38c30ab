// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/staged_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;

fs::path without_trailing_separator(fs::path path) {
  path = fs::absolute(path).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

fs::path hidden_sibling(const fs::path& target, const char* state) {
  return target.parent_path() / ("." + target.filename().string() + state);
}

/// Locks a folder for this process; the kernel lets go of it when the process ends, however it ends.
/// \returns a descriptor to close; negative if the folder cannot be locked
/// \throws std::runtime_error if another process holds the lock
int lock(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const bool busy = errno == EWOULDBLOCK;
  ::close(descriptor);
  if (busy)
    throw std::runtime_error(folder.string() +
                             ": another process is writing here: wait for it, or choose another folder");
  return -1;
}

void unlock(int descriptor) {
  if (descriptor >= 0) ::close(descriptor);
}

}  // namespace

StagedFolder::StagedFolder(fs::path target, RequireReplaceable require_replaceable)
    : target_(without_trailing_separator(std::move(target))),
      working_(hidden_sibling(target_, ".unfinished")),
      require_replaceable_(std::move(require_replaceable)) {
  check_target();
  make_working_folder();
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(working_, ignored);
  unlock(lock_);
  if (!committed_) remove_made_above();
}

/// Only what is empty: another one may have put something there.
void StagedFolder::remove_made_above() {
  std::error_code error;
  for (const fs::path& folder : made_above_)
    if (!fs::remove(folder, error) || error) return;
}

void StagedFolder::check_target() const {
  std::error_code error;
  if (!fs::exists(target_, error) || (fs::is_directory(target_) && fs::is_empty(target_))) return;
  require_replaceable_(target_);
}

void StagedFolder::make_working_folder() {
  std::error_code error;
  unlock(lock(working_));  // of a process that died: nobody else holds it
  fs::remove_all(working_, error);
  for (fs::path above = working_.parent_path(); !fs::exists(above, error) && above.has_relative_path();
       above = above.parent_path())
    made_above_.push_back(above);
  if (!fs::create_directories(working_, error) || error) {
    remove_made_above();
    throw std::runtime_error(target_.string() + ": cannot be made: " +
                             (error ? error.message() : "its place is taken") + ": check the path and its permissions");
  }
  lock_ = lock(working_);
}

void StagedFolder::commit() {
  check_target();
  std::error_code error;
  const fs::path old = hidden_sibling(target_, ".replaced");
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

}  // namespace credo::datasets
