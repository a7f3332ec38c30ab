// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "sensors/time.hpp"

namespace credo::sensors {

inline constexpr Timestamp kSecond = 1'000'000'000;

}  // namespace credo::sensors
