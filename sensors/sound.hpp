// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::sensors {

/// Speed of sound in dry air at a temperature: 331.3 m/s sqrt(1 + T / 273.15). [m/s]
/// \throws std::invalid_argument unless the temperature is finite and above absolute zero
[[nodiscard]] double sound_speed(double celsius);

/// Distance from a time of flight, there and back (Zhu, eq. (1)). [m]
[[nodiscard]] constexpr double distance_of_flight(double sound_speed_mps, double time_s) {
  return 0.5 * sound_speed_mps * time_s;
}

}  // namespace credo::sensors
