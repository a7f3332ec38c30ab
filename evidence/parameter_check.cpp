// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/parameter_check.hpp"

#include <cmath>
#include <stdexcept>

#include "evidence/number_text.hpp"

namespace credo::evidence {

ParameterCheck ParameterCheck::in(std::string_view part) const {
  return ParameterCheck(before_ + std::string(part) + ".");
}

void ParameterCheck::require(bool holds, std::string_view name, double found, std::string_view expected) const {
  if (holds) return;
  std::string message = before_ + std::string(name) + ": found ";
  append_number(message, found);
  throw std::invalid_argument(message + ", expected " + std::string(expected));
}

void ParameterCheck::finite(std::string_view name, double value) const {
  require(std::isfinite(value), name, value, "a finite number");
}

void ParameterCheck::positive(std::string_view name, double value) const {
  require(std::isfinite(value) && value > 0.0, name, value, "a number above 0");
}

void ParameterCheck::not_negative(std::string_view name, double value) const {
  require(std::isfinite(value) && value >= 0.0, name, value, "a number of at least 0");
}

void ParameterCheck::within(std::string_view name, double value, double low, double high) const {
  if (value >= low && value <= high) return;
  std::string expected = "a number from ";
  append_number(expected, low);
  append_number(expected += " to ", high);
  require(false, name, value, expected);
}

void ParameterCheck::between(std::string_view name, double value, double low, double high) const {
  if (value > low && value < high) return;
  std::string expected = "a number above ";
  append_number(expected, low);
  append_number(expected += " and below ", high);
  require(false, name, value, expected);
}

void ParameterCheck::at_least(std::string_view name, std::int64_t count, std::int64_t least) const {
  require(count >= least, name, static_cast<double>(count), "a whole number of at least " + std::to_string(least));
}

void ParameterCheck::mass(std::string_view name, const BinaryMass& mass) const {
  const ParameterCheck member = in(name);
  member.share("yes", mass.yes);
  member.share("no", mass.no);
  member.share("unknown", mass.unknown);
  const double sum = mass.yes + mass.no + mass.unknown;
  require(std::abs(sum - 1.0) <= kMassTolerance, name, sum, "masses that sum to 1");
}

void ParameterCheck::shape(std::string_view name, const RampBelief& ramp) const {
  check(ramp, (before_ + std::string(name)).c_str());
}

}  // namespace credo::evidence
