// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/belief_shapes.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "evidence/number_text.hpp"
#include "evidence/parameter_check.hpp"

namespace credo::evidence {
namespace {

[[noreturn]] void refuse(const char* name, const RampBelief& shape, const char* expected) {
  std::string message = std::string(name) + ": found";
  const auto append = [&message](const char* field, double value) { append_number(message += field, value); };
  append(" max_yes ", shape.max_yes);
  append(", yes_full_until ", shape.yes_full_until);
  append(", yes_zero_from ", shape.yes_zero_from);
  append(", max_no ", shape.max_no);
  append(", no_zero_until ", shape.no_zero_until);
  append(", no_full_from ", shape.no_full_from);
  throw std::invalid_argument(message + "; expected " + expected);
}

}  // namespace

void check(const RampBelief& shape, const char* name) {
  const ParameterCheck field = ParameterCheck("").in(name);
  field.share("max_yes", shape.max_yes);
  field.finite("yes_full_until", shape.yes_full_until);
  field.finite("yes_zero_from", shape.yes_zero_from);
  field.share("max_no", shape.max_no);
  field.finite("no_zero_until", shape.no_zero_until);
  field.finite("no_full_from", shape.no_full_from);
  if (shape.max_yes == 0.0 || shape.max_no == 0.0) return;
  const bool larger_is_worse = shape.yes_full_until <= shape.yes_zero_from && shape.no_zero_until <= shape.no_full_from;
  const bool larger_is_better =
      shape.yes_full_until >= shape.yes_zero_from && shape.no_zero_until >= shape.no_full_from;
  if (!larger_is_worse && !larger_is_better)
    refuse(name, shape, "breakpoints between which YES falls in the direction in which NO rises");
  // yes + no is piecewise linear: largest at a breakpoint, or beside it where the other makes a step there.
  for (const double x : {shape.yes_full_until, shape.yes_zero_from, shape.no_zero_until, shape.no_full_from}) {
    for (const double near : {std::nextafter(x, -HUGE_VAL), x, std::nextafter(x, HUGE_VAL)}) {
      const double yes = shape.max_yes * falling(near, shape.yes_full_until, shape.yes_zero_from);
      const double no = shape.max_no * rising(near, shape.no_zero_until, shape.no_full_from);
      if (yes + no <= 1.0 + kMassTolerance) continue;
      refuse(name, shape,
             "YES and NO that are nowhere more than 1 together: lower max_yes or max_no, or move them apart");
    }
  }
}

}  // namespace credo::evidence
