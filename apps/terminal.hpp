// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <chrono>
#include <string>

namespace credo::apps {

/// "credo: error: ..." on standard error.
void say_error(const std::string& message);
void say_warning(const std::string& message);

/// A bar on standard error, if that is a terminal and the work takes over a second; nothing otherwise.
class Progress {
 public:
  explicit Progress(std::string what);
  /// Takes the bar away.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// \param note  how it goes, in a few words
  void update(double share, const std::string& note = "");

 private:
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  int shown_permille_ = -1;
  std::chrono::steady_clock::time_point start_;
};

/// Seconds since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace credo::apps
