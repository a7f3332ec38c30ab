// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <ranges>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "localization/localizer.hpp"
#include "results/fields.hpp"

namespace credo::localization {
namespace {

using perception::Method;
namespace fields = results::fields;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string complaint_about(const LocalizerParams& params) {
  try {
    check(params);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

template <typename T, typename Visit>
void each_number(const std::string& name, T& value, const Visit& visit);

template <typename T, typename Visit, std::size_t... I>
void each_number_inside(const std::string& before, T& value, const Visit& visit, std::index_sequence<I...>) {
  const auto all = fields::tie(value);
  (each_number(before + std::string(fields::name<T, I>()), std::get<I>(all), visit), ...);
}

/// visit("fit.scan.on_plan_m", number) for every number of the parameters.
template <typename T, typename Visit>
void each_number(const std::string& name, T& value, const Visit& visit) {
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
    return;
  } else if constexpr (std::is_arithmetic_v<T>) {
    visit(name, value);
  } else if constexpr (std::ranges::range<T>) {
    for (std::size_t i = 0; i < value.size(); ++i) each_number(name + "[" + std::to_string(i) + "]", value[i], visit);
  } else {
    each_number_inside(name.empty() ? "" : name + ".", value, visit, std::make_index_sequence<fields::count<T>()>{});
  }
}

TEST(LocalizerParams, TheDefaultsOfBothMethodsAreWithinTheirRanges) {
  EXPECT_EQ(complaint_about({}), "");
  EXPECT_EQ(complaint_about(LocalizerParams{}.with_method(Method::kPaper)), "");
}

TEST(LocalizerParams, WhateverIsNoNumberIsRefusedByItsName) {
  LocalizerParams params;
  int numbers = 0;
  const auto refused = [&](const std::string& name) {
    EXPECT_THAT(complaint_about(params), testing::StartsWith("localizer: " + name + ": found ")) << name;
    ++numbers;
  };
  each_number("", params, [&](const std::string& name, auto& number) {
    using Number = std::remove_reference_t<decltype(number)>;
    const Number good = number;
    if constexpr (std::is_floating_point_v<Number>) {
      for (const double none : {kNan, kInfinity, -kInfinity}) {
        number = none;
        refused(name);
      }
    } else {
      number = std::numeric_limits<Number>::lowest();
      refused(name);
    }
    number = good;
  });
  EXPECT_GT(numbers, 500);
  EXPECT_EQ(complaint_about(params), "");
}

struct Case {
  const char* name;
  std::function<void(LocalizerParams&)> spoil;
  const char* found_and_expected;
};

TEST(LocalizerParams, OutOfTheirRangeAreRefusedWithWhatIsExpected) {
  const std::array cases{
      Case{"tracker.prediction.observations", [](auto& p) { p.tracker.prediction.observations = 9; },
           "found 9, expected a number from 1 to 8"},
      Case{"tracker.association.min_margin", [](auto& p) { p.tracker.association.min_margin = 1.0; },
           "found 1, expected a number of at least 0 and below 1"},
      Case{"tracker.belief.miss", [](auto& p) { p.tracker.belief.miss.unknown = 0.5; },
           "found 0.7, expected masses that sum to 1"},
      Case{"map.max_corner_angle_rad", [](auto& p) { p.map.max_corner_angle_rad = 0.5; },
           "found 0.5, expected a number from 0.7854 to 3.141592653589793"},
      Case{"fit.matching.other_type.no", [](auto& p) { p.fit.matching.other_type.no = -0.1; },
           "found -0.1, expected a number from 0 to 1"},
      Case{"fit.matching.wall_angle.max_no", [](auto& p) { p.fit.matching.wall_angle.max_no = 1.5; },
           "found 1.5, expected a number from 0 to 1"},
      Case{"fit.observations.min_wall_sigma_m", [](auto& p) { p.fit.observations.min_wall_sigma_m = 0.0; },
           "found 0, expected a number above 0"},
      Case{"fit.solver.outlier_probability", [](auto& p) { p.fit.solver.outlier_probability = 1.0; },
           "found 1, expected a number above 0 and below 1"},
      Case{"fit.scan.search_step_m", [](auto& p) { p.fit.scan.search_step_m = 1e-6; },
           "found 1e-06, expected a number from 0.01 to 10"},
      Case{"fit.evidence.unmapped_weight", [](auto& p) { p.fit.evidence.unmapped_weight = 2.0; },
           "found 2, expected a number from 0 to 1"},
      Case{"fit.bearings.sight_m", [](auto& p) { p.fit.bearings.sight_m = 0.5; },
           "found 0.5, expected a number above nearest_m"},
      Case{"fit.matching_rounds", [](auto& p) { p.fit.matching_rounds = 0; },
           "found 0, expected a whole number of at least 1"},
      Case{"belief.wall_reliability", [](auto& p) { p.belief.wall_reliability = 1.1; },
           "found 1.1, expected a number from 0 to 1"},
      Case{"integrity.risk", [](auto& p) { p.integrity.risk = 0.0; }, "found 0, expected a number above 0 and below 1"},
      Case{"integrity.wall_fault.high",
           [](auto& p) {
             p.integrity.wall_fault = {0.2, 0.1};
           },
           "found 0.1, expected a number from 0.2 to 1"},
      Case{"integrity.point_faults[0].from_belief", [](auto& p) { p.integrity.point_faults[0].from_belief = 0.1; },
           "found 0.1, expected a number from 0 to 0"},
      Case{"integrity.point_faults[2].from_belief",
           [](auto& p) {
             p.integrity.point_faults[1].from_belief = 0.9;
             p.integrity.point_faults[2].from_belief = 0.5;
           },
           "found 0.5, expected a number from 0.9 to 1"},
      Case{"integrity.slip_m", [](auto& p) { p.integrity.slip_m = -1.0; }, "found -1, expected a number of at least 0"},
      Case{"search.plausibility.most_mapped_share", [](auto& p) { p.search.plausibility.most_mapped_share = 1.0; },
           "found 1, expected a number above 0 and below 1"},
      Case{"search.heading_step_rad", [](auto& p) { p.search.heading_step_rad = 0.0; },
           "found 0, expected a number from 0.001 to 3.141592653589793"},
      Case{"search.most_nodes[1]", [](auto& p) { p.search.most_nodes[1] = 0; },
           "found 0, expected a whole number of at least 1"},
      Case{"hypotheses.least_belief", [](auto& p) { p.hypotheses.least_belief = 1.01; },
           "found 1.01, expected a number from 0 to 1"},
      Case{"status.max_protection_m", [](auto& p) { p.status.max_protection_m = 0.0; },
           "found 0, expected a number above 0"},
      Case{"trust.checked_for", [](auto& p) { p.trust.checked_for = -1; },
           "found -1, expected a whole number of at least 0"},
      Case{"trust.blind_reliability", [](auto& p) { p.trust.blind_reliability = -0.1; },
           "found -0.1, expected a number from 0 to 1"},
      Case{"trust.returned_innovation", [](auto& p) { p.trust.returned_innovation = 30.0; },
           "found 30, expected at most status.max_innovation"},
      Case{"misfit.memory", [](auto& p) { p.misfit.memory = 1.5; }, "found 1.5, expected a number from 0 to 1"},
      Case{"continuity.least_tracks", [](auto& p) { p.continuity.least_tracks = 0; },
           "found 0, expected a whole number of at least 1"},
      Case{"constant_velocity.turn_bin_rad", [](auto& p) { p.constant_velocity.turn_bin_rad = 0.0; },
           "found 0, expected a number from 1e-04 to 3.141592653589793"},
      Case{"ego_motion.search_step_rad", [](auto& p) { p.ego_motion.search_step_rad = 0.0; },
           "found 0, expected a number from 0.001 to 3.141592653589793"},
      Case{"calibration_walk.harmonic_rad", [](auto& p) { p.calibration_walk.harmonic_rad = -1e-9; },
           "found -1e-09, expected a number of at least 0"},
      Case{"searched_sigma_m", [](auto& p) { p.searched_sigma_m = 0.0; }, "found 0, expected a number above 0"},
  };
  for (const Case& c : cases) {
    LocalizerParams params;
    c.spoil(params);
    EXPECT_EQ(complaint_about(params), "localizer: " + std::string(c.name) + ": " + c.found_and_expected);
  }
}

TEST(LocalizerParams, BreakpointsThatRunAgainstEachOtherAreRefused) {
  LocalizerParams params;
  params.belief.separation.yes_full_until = 3.0;  // YES would grow with what NO grows with
  EXPECT_THAT(complaint_about(params), testing::AllOf(testing::StartsWith("localizer: belief.separation: found "),
                                                      testing::HasSubstr("yes_full_until 3,")));
}

TEST(LocalizerParams, ALocalizerIsNotMadeOfWrongOnes) {
  LocalizerParams params;
  params.trust.max_instrument_separation = kNan;
  EXPECT_THROW(Localizer({}, {}, std::nullopt, params), std::invalid_argument);
}

}  // namespace
}  // namespace credo::localization
