// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "evidence/belief_shapes.hpp"
#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Checks parameters that a user has set, each under its name. What is not as expected throws std::invalid_argument:
/// "localizer: fit.scan.on_plan_m: found -1, expected a number above 0". nan and infinity are never expected.
class ParameterCheck {
 public:
  /// \param before  what each name is preceded by: "localizer: "
  explicit ParameterCheck(std::string before) : before_(std::move(before)) {}
  /// The same of what is inside of `part`: its names begin with "part.".
  [[nodiscard]] ParameterCheck in(std::string_view part) const;

  void finite(std::string_view name, double value) const;
  void positive(std::string_view name, double value) const;
  void not_negative(std::string_view name, double value) const;
  void within(std::string_view name, double value, double low, double high) const;   ///< the ends belong to it
  void between(std::string_view name, double value, double low, double high) const;  ///< and here they do not
  void share(std::string_view name, double value) const { within(name, value, 0.0, 1.0); }
  /// A count, in whatever integer it is kept.
  void at_least(std::string_view name, std::int64_t count, std::int64_t least) const;
  void mass(std::string_view name, const BinaryMass& mass) const;   ///< not negative, and 1 in sum
  void shape(std::string_view name, const RampBelief& ramp) const;  ///< as check(ramp, name)

  /// What no other function says. \param expected  a noun: "a number above map.min_corner_angle_rad"
  void require(bool holds, std::string_view name, double found, std::string_view expected) const;

 private:
  std::string before_;
};

}  // namespace credo::evidence
