// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/interrupt.hpp"

#include <iterator>

namespace credo::apps {
namespace {

constexpr int kAtOnce = 3;

volatile std::sig_atomic_t arrived = 0, times = 0;

/// Not already at the second: wrappers like timeout(1) send one signal to the process and to its group.
extern "C" void remember(int signal) {
  arrived = signal;
  times = times + 1;
  if (times < kAtOnce) return;
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
