// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/sound.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::sensors {

double sound_speed(double celsius) {
  constexpr double kAbsoluteZero = -273.15;
  if (!std::isfinite(celsius) || celsius <= kAbsoluteZero)
    throw std::invalid_argument("speed of sound: expected a finite temperature above -273.15 degrees, found " +
                                std::to_string(celsius));
  return 331.3 * std::sqrt(1.0 - celsius / kAbsoluteZero);
}

}  // namespace credo::sensors
