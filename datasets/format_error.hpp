// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace credo::datasets {

/// A file that cannot be used. what() is "FILE:LINE: what was found, what was expected"; a person can act on it.
class FormatError : public std::runtime_error {
 public:
  /// \param line  counted from 1; 0 where the file as a whole is meant (missing, empty, not readable)
  FormatError(std::filesystem::path file, int line, const std::string& message);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] int line() const { return line_; }

 private:
  std::filesystem::path file_;
  int line_;
};

}  // namespace credo::datasets
