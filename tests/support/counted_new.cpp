// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/support/counted_new.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<int> count = 0;
std::atomic<std::size_t> bytes = 0;

void take_down(std::size_t size) {
  ++count;
  bytes += size;
}
}  // namespace

// In a file of its own: where the compiler saw these bodies inlined, it would take new and free for a mismatch.
void* operator new(std::size_t size) {
  take_down(size);
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  take_down(size);
  return std::malloc(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  take_down(size);
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace credo::testing {

int allocations() { return count; }
std::size_t allocated_bytes() { return bytes; }

}  // namespace credo::testing
