// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <limits>

namespace credo::sensors {

/// Nanoseconds; a timestamp is the middle of the reading.
using Timestamp = std::int64_t;

/// Readers refuse times further than this from 0, in either direction: differences could overflow.
inline constexpr Timestamp kLatestTime = std::numeric_limits<Timestamp>::max() / 2;

[[nodiscard]] constexpr bool is_usable(Timestamp time) { return time >= -kLatestTime && time <= kLatestTime; }

/// `later - earlier` in seconds. Exact to a nanosecond for differences below 100 days.
[[nodiscard]] constexpr double seconds_between(Timestamp earlier, Timestamp later) {
  return static_cast<double>(later - earlier) * 1e-9;
}

[[nodiscard]] constexpr Timestamp from_seconds(double seconds) {
  return static_cast<Timestamp>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5));
}

}  // namespace credo::sensors
