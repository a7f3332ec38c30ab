// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>

namespace credo::testing {

/// Allocations by operator new in this program so far.
[[nodiscard]] int allocations();
/// Bytes that they asked for, those given back included.
[[nodiscard]] std::size_t allocated_bytes();

}  // namespace credo::testing
