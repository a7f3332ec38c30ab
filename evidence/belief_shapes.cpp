// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/belief_shapes.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

[[noreturn]] void refuse(const char* name, const char* what) {
  throw std::invalid_argument(std::string(name) + ": " + what);
}

}  // namespace

void check(const RampBelief& shape, const char* name) {
  for (const double value : {shape.max_yes, shape.yes_full_until, shape.yes_zero_from, shape.max_no,
                             shape.no_zero_until, shape.no_full_from}) {
    if (!std::isfinite(value)) refuse(name, "every breakpoint must be a finite number");
  }
  if (shape.max_yes < 0.0 || shape.max_yes > 1.0 || shape.max_no < 0.0 || shape.max_no > 1.0) {
    refuse(name, "max_yes and max_no must be in [0, 1]");
  }
  if (shape.max_yes == 0.0 || shape.max_no == 0.0) return;
  const bool larger_is_worse = shape.yes_full_until <= shape.yes_zero_from && shape.no_zero_until <= shape.no_full_from;
  const bool larger_is_better =
      shape.yes_full_until >= shape.yes_zero_from && shape.no_zero_until >= shape.no_full_from;
  if (!larger_is_worse && !larger_is_better) refuse(name, "YES must fall in the direction in which NO rises");
  // yes + no is piecewise linear: largest at a breakpoint, or beside it where the other makes a step there.
  for (const double x : {shape.yes_full_until, shape.yes_zero_from, shape.no_zero_until, shape.no_full_from}) {
    for (const double near : {std::nextafter(x, -HUGE_VAL), x, std::nextafter(x, HUGE_VAL)}) {
      const double yes = shape.max_yes * falling(near, shape.yes_full_until, shape.yes_zero_from);
      const double no = shape.max_no * rising(near, shape.no_zero_until, shape.no_full_from);
      if (yes + no <= 1.0 + kMassTolerance) continue;
      refuse(name, "YES and NO together exceed 1; lower max_yes or max_no or move them apart");
    }
  }
}

}  // namespace credo::evidence
