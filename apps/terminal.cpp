// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace credo::apps {

void say_error(const std::string& message) { std::fprintf(stderr, "credo: error: %s\n", message.c_str()); }
void say_warning(const std::string& message) { std::fprintf(stderr, "credo: warning: %s\n", message.c_str()); }

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double share, const std::string& note) {
  if (!terminal_) return;
  const int permille = static_cast<int>(1000.0 * std::clamp(share, 0.0, 1.0));
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (permille == shown_permille_ || (!shown_ && elapsed < 0.5)) return;
  constexpr int kWidth = 30;
  const int full = permille * kWidth / 1000;
  const double left = share > 0.02 ? elapsed * (1.0 - share) / share : 0.0;
  std::fprintf(stderr, "\r%-22s [%s%s] %3d %%  %3.0f s left%s ", what_.c_str(),
               std::string(static_cast<std::size_t>(full), '=').c_str(),
               std::string(static_cast<std::size_t>(kWidth - full), ' ').c_str(), permille / 10, left,
               note.empty() ? "" : (", " + note).c_str());
  std::fflush(stderr);
  shown_ = true;
  shown_permille_ = permille;
}

}  // namespace credo::apps
