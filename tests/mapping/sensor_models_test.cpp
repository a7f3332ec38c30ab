// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <limits>

#include "mapping/laser_model.hpp"
#include "mapping/sonar_model.hpp"
#include "tests/support/vectors.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;
using nlohmann::json;

json to_json(const GridMass& mass) {
  return {{"1", mass.empty}, {"2", mass.occupied}, {"1n2", mass.conflict}, {"1u2", mass.unknown}};
}

double number(const json& in, const char* key) { return in.at(key).get<double>(); }

TEST(SensorModelVectors, AgreeWithTheReference) {
  const testing::Operations operations{
      {"sonar001",
       [](const json& in) -> std::optional<json> {
         const Variant variant = in.at("variant") == "resolved" ? Variant::kResolved : Variant::kPrinted;
         return to_json(sonar_li2007(number(in, "rho"), number(in, "theta"), number(in, "R"), number(in, "eps"),
                                     number(in, "omega"), number(in, "rmin"), number(in, "rho_v"), variant));
       }},
      {"laser000",
       [](const json& in) -> std::optional<json> {
         return to_json(laser_li2006(number(in, "rho"), number(in, "R"), number(in, "eps")));
       }},
      {"lambda",
       [](const json& in) -> std::optional<json> { return beam_weight(number(in, "theta"), number(in, "omega")); }}};
  const auto tallies = testing::run_vectors(testing::vectors_path(), operations);
  for (const auto& [name, operation] : operations) {
    if (name == "lambda" && !tallies.contains(name)) continue;  // not in every file
    ASSERT_TRUE(tallies.contains(name)) << "no case of " << name;
    EXPECT_GT(tallies.at(name).run, 0) << name;
    EXPECT_EQ(tallies.at(name).failed, 0) << name << ": " << tallies.at(name).first_failure;
    EXPECT_EQ(tallies.at(name).not_covered, 0) << name;
  }
}

RC_GTEST_PROP(SonarModelLaws, IsAMassEverywhere, (bool printed, std::uint32_t a, std::uint32_t b, std::uint32_t c)) {
  const auto share = [](std::uint32_t bits) { return (bits % 10'000) / 9'999.0; };
  const double rho = 4.0 * share(a), theta = 0.6 * (share(b) - 0.5), reading = 0.2 + 2.8 * share(c);
  const GridMass mass =
      sonar_li2007(rho, theta, reading, 0.05, 0.436, 0.2, 100.0, printed ? Variant::kPrinted : Variant::kResolved);
  RC_ASSERT(mass.empty >= 0.0 && mass.occupied >= 0.0 && mass.conflict >= 0.0 && mass.unknown >= 0.0);
  RC_ASSERT(std::abs(mass.empty + mass.occupied + mass.conflict + mass.unknown - 1.0) < 1e-12);
}

TEST(Li2007, IsOccupiedAtTheReadingAndEmptyBefore) {
  const Li2007 model(sensors::SonarRing{});
  const GridMass at = model.mass(1.5, 0.0, 1.5), before = model.mass(0.4, 0.0, 1.5), behind = model.mass(1.7, 0.0, 1.5);
  EXPECT_GT(at.occupied, 0.5);
  EXPECT_EQ(at.empty, 0.0);
  EXPECT_GT(before.empty, 0.4);
  EXPECT_LT(before.occupied, 0.01);
  EXPECT_EQ(behind, GridMass::vacuous());
  EXPECT_EQ(model.mass(1.5, 0.3, 1.5), GridMass::vacuous());  // outside the cone
}

TEST(Li2007, NoEchoIsEvidenceOfFreeSpaceUpToItsRange) {
  const Li2007 model(sensors::SonarRing{}, {.no_echo_range_m = 1.0});
  EXPECT_GT(model.no_echo_mass(0.5, 0.0).empty, 0.3);
  EXPECT_EQ(model.no_echo_mass(0.5, 0.0).occupied, 0.0);
  EXPECT_EQ(model.no_echo_mass(1.1, 0.0), GridMass::vacuous());
  EXPECT_EQ(model.reach(std::numeric_limits<double>::infinity()), 1.0);
}

TEST(Li2007, RefusesParametersThatCannotBe) {
  const sensors::SonarRing ring;
  EXPECT_THROW(Li2007(ring, {.epsilon_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.rho_v_per_m2 = -1.0}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.reliability = 1.0}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.no_echo_reliability = std::nan("")}), std::invalid_argument);
  sensors::SonarRing all_round;
  all_round.beam_width_rad = 3.2;
  EXPECT_THROW(Li2007{all_round}, std::invalid_argument);
  sensors::SonarRing no_range;
  no_range.range_max_m = 0.1;
  EXPECT_THROW(Li2007{no_range}, std::invalid_argument);
}

TEST(Li2006Laser, KeepsThePapersWidthForTimeOfFlightAndWidensForTriangulation) {
  const Li2006Laser model;
  const sensors::RangeNoise flight{.sigma_0_m = 0.01, .k_per_m = 0.0},
      triangulation{.sigma_0_m = 0.005, .k_per_m = 0.0045};
  EXPECT_DOUBLE_EQ(model.half_width(8.0, flight), 0.05);
  EXPECT_DOUBLE_EQ(model.hit_share(8.0, flight), 1.0);
  EXPECT_DOUBLE_EQ(model.free_margin(8.0, flight), 0.05);
  EXPECT_NEAR(model.free_margin(4.0, triangulation), 3.0 * triangulation.sigma(4.0), 1e-12);
  EXPECT_NEAR(model.half_width(4.0, triangulation), triangulation.sigma(4.0), 1e-12);
  EXPECT_NEAR(model.hit_share(4.0, triangulation) * model.half_width(4.0, triangulation), 0.05, 1e-12);
}

TEST(Li2006Laser, RefusesParametersThatCannotBe) {
  EXPECT_THROW(Li2006Laser({.epsilon_m = -0.05}), std::invalid_argument);
  EXPECT_THROW(Li2006Laser({.free_sigmas = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(Li2006Laser({.free_sigmas = 1.0, .hit_sigmas = 2.0}), std::invalid_argument);
  EXPECT_THROW(Li2006Laser({.reliability = 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::mapping
