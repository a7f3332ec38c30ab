// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::testing {

/// Allocations by operator new in this program so far.
[[nodiscard]] int allocations();

}  // namespace credo::testing
