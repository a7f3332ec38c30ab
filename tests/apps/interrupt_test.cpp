// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/interrupt.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace credo::apps {
namespace {

using testing::ExitedWithCode;
using testing::KilledBySignal;

constexpr int kRanOn = 3, kStopped = 4;

/// Ends the process with kStopped if a check says so.
void check() {
  try {
    Interruptible::check();
  } catch (const Interrupted& interrupted) {
    std::_Exit(interrupted.signal() == SIGINT ? kStopped : kRanOn);
  }
}

/// What a person needs at least to ask again.
void a_moment_passes() { std::this_thread::sleep_for(std::chrono::milliseconds(600)); }

TEST(InterruptDeathTest, TheFirstSignalWaitsForTheNextCheck) {
  const auto interrupted_once = [] {
    const Interruptible interruptible;
    check();
    std::raise(SIGINT);
    check();
    std::_Exit(kRanOn);
  };
  EXPECT_EXIT(interrupted_once(), ExitedWithCode(kStopped), "");
}

TEST(InterruptDeathTest, TheSecondOneWaitsForNothing) {
  for (const int second : {SIGINT, SIGTERM}) {
    const auto never_checks = [second] {
      const Interruptible interruptible;
      std::raise(SIGINT);
      a_moment_passes();
      std::raise(second);
      std::_Exit(kRanOn);
    };
    EXPECT_EXIT(never_checks(), KilledBySignal(second), "");
  }
}

TEST(InterruptDeathTest, AfterwardsSignalsAreWhatTheyWere) {
  const auto interrupted_later = [] {
    { const Interruptible interruptible; }
    std::raise(SIGINT);
    std::_Exit(kRanOn);
  };
  EXPECT_EXIT(interrupted_later(), KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace credo::apps
