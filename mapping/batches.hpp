// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cstddef>

namespace credo::mapping {

/// Calls work(begin, end) for one batch of `count` readings after the other, and done(end) after each: this is when a
/// person sees how far the work is, and can end it.
template <typename Work, typename Done>
void in_batches(std::size_t count, const Work& work, const Done& done) {
  constexpr std::size_t kBatch = 64;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, count);
    work(begin, end);
    done(end);
  }
}

}  // namespace credo::mapping
