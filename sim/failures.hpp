// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// How a sensor works at a moment: all that fails at once, taken together.
struct Condition {
  bool blind = false;
  bool frozen = false;
  double light = 1.0;  ///< factor
  double noise = 1.0;  ///< factor
  double scale = 1.0;
  double offset_m = 0.0;
  double turn_rad = 0.0;

  /// The 1-sigma, in usual ones, of what must be added to the usual noise to give the present one.
  [[nodiscard]] double noise_beyond_usual() const { return std::sqrt(std::max(0.0, noise * noise - 1.0)); }
};
[[nodiscard]] Condition condition_of(const World& world, const std::string& sensor, double seconds);

/// How far the wheels have turned for nothing up to a moment. [m]
[[nodiscard]] double slipped_m(const World& world, double seconds);

/// Names of the sensors that can fail: camera0, range0 ..., odometry0, where the world has them.
[[nodiscard]] std::vector<std::string> sensor_names(const World& world);

struct Event {
  double seconds = 0.0;  ///< from the start
  std::string name;
};
/// When which sensor begins to fail and works again, by time. A sensor is restored when all that ails it is over.
[[nodiscard]] std::vector<Event> failure_events(const World& world);

/// \throws std::invalid_argument  for a failure of a sensor that the robot does not have, of a kind that this sensor
///   does not know, or that ends before it begins
void check_failures(const World& world);

}  // namespace credo::sim
