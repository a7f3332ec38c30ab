// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/interrupt.hpp"

#include <atomic>
#include <cstdint>
#include <ctime>
#include <iterator>

namespace credo::apps {
namespace {

/// Signals that come so close together are one wish: wrappers like timeout(1) send theirs to the process and to its
/// group.
constexpr std::int64_t kTogether_ns = 500'000'000;

// The first signal, and when it came; 0 before. A handler may use what is free of locks.
std::atomic<int> arrived = 0;
std::atomic<std::int64_t> arrived_ns = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

extern "C" void remember(int signal) {
  const std::int64_t now = now_ns();
  std::int64_t first = 0;
  if (arrived_ns.compare_exchange_strong(first, now)) {
    arrived = signal;
    return;
  }
  if (now - first < kTogether_ns) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

Interruptible::Interruptible() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    const bool ignored = before_[i].sa_handler == SIG_IGN;  // as nohup asks for
    if (!ignored) sigaction(kSignals[i], &action, nullptr);
  }
}

Interruptible::~Interruptible() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

void Interruptible::check() {
  if (arrived != 0) throw Interrupted(arrived);
}

}  // namespace credo::apps
