// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace credo::sim {

/// Hands out 0, 1, ... below a count, each once, to whoever asks; nothing more once `stop` was called.
class NextIndex {
 public:
  explicit NextIndex(std::size_t count) : count_(count) {}
  [[nodiscard]] std::optional<std::size_t> operator()() {
    const std::size_t index = stopped_ ? count_ : next_++;
    return index < count_ ? std::optional(index) : std::nullopt;
  }
  void stop() { stopped_ = true; }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// Calls work(NextIndex&) on `threads` threads, this one among them, and waits for all. The first exception of any of
/// them stops the others and comes out here.
template <typename Work>
void run_together(int threads, std::size_t count, const Work& work) {
  NextIndex next(count);
  std::mutex mutex;
  std::exception_ptr failure;
  const auto guarded = [&] {
    try {
      work(next);
    } catch (...) {
      next.stop();
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(guarded);
    guarded();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace credo::sim
