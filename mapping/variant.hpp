// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::mapping {

/// The formulas as printed, brought to sum 1 by division; or as resolved (docs/equations.md).
enum class Variant { kResolved, kPrinted };

}  // namespace credo::mapping
