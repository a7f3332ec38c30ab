// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <numbers>

namespace credo::geometry {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< a full one [rad]

/// The angle in (-pi, pi] that is equal to `angle` modulo 2 pi. [rad]
[[nodiscard]] inline double wrap_angle(double angle) {
  constexpr double kPi = std::numbers::pi;
  // The remainder is slow; within a turn and a half it is this difference, which is exact (Sterbenz).
  if (angle > -kPi && angle <= kPi) return angle;
  if (std::abs(angle) < 3.0 * kPi) return angle > 0.0 ? angle - kTurn : angle + kTurn;
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// a - b, wrapped to (-pi, pi]. [rad]
[[nodiscard]] inline double angle_difference(double a, double b) { return wrap_angle(a - b); }

/// An angle between lines, which have no direction: wrapped to (-pi/2, pi/2]. [rad]
[[nodiscard]] inline double wrap_line_angle(double angle) { return 0.5 * wrap_angle(2.0 * angle); }

[[nodiscard]] constexpr double to_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
[[nodiscard]] constexpr double to_degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace credo::geometry
