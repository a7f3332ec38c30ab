// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/parameter_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace credo::evidence {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string complaint(const std::function<void(const ParameterCheck&)>& checked) {
  try {
    checked(ParameterCheck("robot: ").in("arm"));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ParameterCheck, SaysWhichWhatWasFoundAndWhatIsExpected) {
  EXPECT_EQ(complaint([](const auto& c) { c.finite("x", kInfinity); }),
            "robot: arm.x: found inf, expected a finite number");
  EXPECT_EQ(complaint([](const auto& c) { c.positive("x", 0.0); }), "robot: arm.x: found 0, expected a number above 0");
  EXPECT_EQ(complaint([](const auto& c) { c.not_negative("x", -0.5); }),
            "robot: arm.x: found -0.5, expected a number of at least 0");
  EXPECT_EQ(complaint([](const auto& c) { c.within("x", 3.5, -1, 3); }),
            "robot: arm.x: found 3.5, expected a number from -1 to 3");
  EXPECT_EQ(complaint([](const auto& c) { c.between("x", 1, 0, 1); }),
            "robot: arm.x: found 1, expected a number above 0 and below 1");
  EXPECT_EQ(complaint([](const auto& c) { c.at_least("n", 0, 1); }),
            "robot: arm.n: found 0, expected a whole number of at least 1");
  EXPECT_EQ(complaint([](const auto& c) { c.mass("m", {.yes = 0.5, .no = 0.25, .unknown = 0.5}); }),
            "robot: arm.m: found 1.25, expected masses that sum to 1");
  EXPECT_EQ(complaint([](const auto& c) { c.mass("m", {.yes = 1.5, .no = 0.0, .unknown = -0.5}); }),
            "robot: arm.m.yes: found 1.5, expected a number from 0 to 1");
  EXPECT_EQ(complaint([](const auto& c) { c.shape("s", {.max_yes = 2.0}); }),
            "robot: arm.s.max_yes: found 2, expected a number from 0 to 1");
}

TEST(ParameterCheck, TakesWhatIsWithinTheRange) {
  EXPECT_EQ(complaint([](const auto& c) {
              c.finite("x", -7.0);
              c.positive("x", 1e-300);
              c.not_negative("x", 0.0);
              c.within("x", 3.0, -1.0, 3.0);
              c.within("x", -1.0, -1.0, 3.0);
              c.between("x", 0.5, 0.0, 1.0);
              c.at_least("n", 1, 1);
              c.mass("m", {.yes = 0.5, .no = 0.25, .unknown = 0.25});
              c.shape("s", {.max_yes = 1.0, .yes_full_until = 0.0, .yes_zero_from = 1.0});
            }),
            "");
}

TEST(ParameterCheck, NoNumberIsWithinNoRange) {
  for (const double none : {kNan, kInfinity, -kInfinity}) {
    EXPECT_NE(complaint([none](const auto& c) { c.finite("x", none); }), "");
    EXPECT_NE(complaint([none](const auto& c) { c.positive("x", none); }), "");
    EXPECT_NE(complaint([none](const auto& c) { c.not_negative("x", none); }), "");
    EXPECT_NE(complaint([none](const auto& c) { c.within("x", none, 0.0, 1.0); }), "");
    EXPECT_NE(complaint([none](const auto& c) { c.between("x", none, 0.0, 1.0); }), "");
    EXPECT_NE(complaint([none](const auto& c) { c.mass("m", {.yes = none, .no = 0.0, .unknown = 1.0}); }), "");
  }
}

}  // namespace
}  // namespace credo::evidence
