// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <rapidcheck.h>

namespace credo::geometry {

/// Of a random property, in steps of 1e-4.
inline double any_number(int low = -10, int high = 10) { return 1e-4 * *rc::gen::inRange(low * 10'000, high * 10'000); }

}  // namespace credo::geometry
