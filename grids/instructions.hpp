// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>

namespace credo::grids {

/// What the loops over cells are compiled for. All give the same bits: cells are integers, and floating point is
/// contracted nowhere.
enum class Instructions { kBaseline, kAvx2 };

/// The best that this machine has.
[[nodiscard]] inline Instructions best_instructions() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return Instructions::kAvx2;
#endif
  return Instructions::kBaseline;
}

#if defined(__x86_64__)
template <typename Kernel>
[[gnu::target("avx2")]] void run_with_avx2(const Kernel& kernel) {
  kernel();
}
#endif

/// Runs a kernel compiled for these instructions. The kernel is a lambda with the attribute `always_inline`, so that it
/// is compiled anew for each, and what it calls is inline too. Precondition: the machine has them.
template <typename Kernel>
void run_with([[maybe_unused]] Instructions instructions, const Kernel& kernel) {
#if defined(__x86_64__)
  if (instructions == Instructions::kAvx2) return run_with_avx2(kernel);
#endif
  kernel();
}

/// Eight numbers of a channel, worked on at once: a register of AVX2, or two of the baseline.
using Lanes [[gnu::vector_size(32)]] = std::int32_t;
inline constexpr int kLanes = 8;

}  // namespace credo::grids
