// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "mapping/cell_rules.hpp"
#include "mapping/laser_model.hpp"
#include "mapping/sonar_li.hpp"
#include "mapping/sonar_regions.hpp"
#include "sensors/sound.hpp"
#include "tests/support/vectors.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;
using nlohmann::json;

json to_json(const GridMass& mass) {
  return {{"1", mass.empty}, {"2", mass.occupied}, {"1n2", mass.conflict}, {"1u2", mass.unknown}};
}

double number(const json& in, const char* key) { return in.at(key).get<double>(); }

Variant variant_of(const json& in) { return in.at("variant") == "resolved" ? Variant::kResolved : Variant::kPrinted; }

/// With what the case says of it.
sensors::SonarRing ring_of(const json& in) {
  sensors::SonarRing ring;
  ring.beam_width_rad = number(in, "omega");
  ring.range_min_m = number(in, "rmin");
  if (in.contains("rmax")) ring.range_max_m = number(in, "rmax");
  return ring;
}

std::optional<json> run_sonar_li2006(const json& in) {
  return to_json(sonar_li2006(number(in, "rho"), number(in, "theta"), number(in, "R"), ring_of(in), number(in, "eps"),
                              in.value("rho_v", 1.0), variant_of(in)));
}

std::optional<json> run_sonar_li2007(const json& in) {
  return to_json(sonar_li2007(number(in, "rho"), number(in, "theta"), number(in, "R"), ring_of(in), number(in, "eps"),
                              in.value("rho_v", 1.0), variant_of(in)));
}

std::optional<json> run_sonar_lip(const json& in) {
  LiPParams params{.epsilon_m = number(in, "eps"), .variant = variant_of(in)};
  params.rho_e = in.value("rE", params.rho_e);
  params.rho_o = in.value("rO", params.rho_o);
  params.rho_c = in.value("rC", params.rho_c);
  params.rho_i = in.value("rI", params.rho_i);
  return to_json(sonar_lip(number(in, "d"), number(in, "theta"), number(in, "R"), ring_of(in), params));
}

std::optional<json> run_sonar_su(const json& in) {
  json mass = to_json(
      sonar_su(number(in, "rho"), number(in, "theta"), number(in, "R"), number(in, "beta"), number(in, "unit")));
  mass.erase("1n2");
  return mass;
}

/// Zhu's names: full, empty, ignorance.
json to_zhu(const GridMass& mass) { return {{"F", mass.occupied}, {"E", mass.empty}, {"T", mass.unknown}}; }
GridMass from_zhu(const json& mass) {
  return {.empty = mass.value("E", 0.0),
          .occupied = mass.value("F", 0.0),
          .conflict = 0.0,
          .unknown = mass.value("T", 0.0)};
}
ArcRegion region_of(const json& in) { return static_cast<ArcRegion>(in.at("region").get<int>() - 1); }

std::optional<json> run_zhu(const json& in) {
  return to_zhu(sonar_zhu(region_of(in), number(in, "rho"), number(in, "n")));
}

std::optional<json> run_zhu_approximated(const json& in) {
  const GridMass reading = sonar_zhu(region_of(in), number(in, "rho"), number(in, "n"));
  const auto adaptive = in.at("variant") == "face" ? Approximation::kFaceValue : Approximation::kAdaptive;
  return to_zhu(approximated(
      reading, in.at("n_empty").get<int>(), in.at("n_full").get<int>(),
      {.e1 = number(in, "e1"), .e2 = number(in, "e2"), .e3 = number(in, "e3"), .approximation = adaptive}));
}

std::optional<json> run_zhu_dempster(const json& in) {
  GridMass cell = from_zhu(in.at("m1"));
  if (!DempsterFold{}.update(cell, from_zhu(in.at("m2")))) throw testing::TotalConflict();
  return to_zhu(cell);
}

std::optional<json> run_zhu_decision(const json& in) {
  switch (decide_zhu(from_zhu(in.at("m")), {.least_margin = number(in, "e4"), .most_ignorance = number(in, "e5")})) {
    case ZhuState::kOccupied: return "F";
    case ZhuState::kEmpty: return "E";
    case ZhuState::kUnknown: break;
  }
  return "U";
}

TEST(SensorModelVectors, AgreeWithTheReference) {
  const testing::Operations operations{
      {"sonar000", run_sonar_li2006},
      {"sonar001", run_sonar_li2007},
      {"sonar002", run_sonar_lip},
      {"dst001", run_sonar_su},
      {"laser000",
       [](const json& in) -> std::optional<json> {
         return to_json(laser_li2006(number(in, "rho"), number(in, "R"), number(in, "eps")));
       }},
      {"sonar003", run_zhu},
      {"region003",
       [](const json& in) -> std::optional<json> {
         return static_cast<int>(arc_region(number(in, "d"), number(in, "R"), number(in, "eps"))) + 1;
       }},
      {"sonar003a", run_zhu_approximated},
      {"dempster003", run_zhu_dempster},
      {"decide003", run_zhu_decision},
      {"tof",
       [](const json& in) -> std::optional<json> {
         return sensors::distance_of_flight(number(in, "V"), number(in, "T"));
       }},
      {"lambda",
       [](const json& in) -> std::optional<json> { return beam_weight(number(in, "theta"), number(in, "omega")); }}};
  const auto tallies = testing::run_vectors(testing::vectors_path(), operations);
  for (const auto& [name, operation] : operations) {
    ASSERT_TRUE(tallies.contains(name)) << "no case of " << name;
    EXPECT_GT(tallies.at(name).run, 0) << name;
    EXPECT_EQ(tallies.at(name).failed, 0) << name << ": " << tallies.at(name).first_failure;
    EXPECT_EQ(tallies.at(name).not_covered, 0) << name;
  }
}

/// Shares of a range, from any bits.
double share_of(std::uint32_t bits) { return (bits % 10'000) / 9'999.0; }

RC_GTEST_PROP(SonarModelLaws, AreMassesEverywhere, (bool printed, std::uint32_t a, std::uint32_t b, std::uint32_t c)) {
  const double rho = 4.0 * share_of(a), theta = 0.6 * (share_of(b) - 0.5), reading = 0.2 + 2.8 * share_of(c);
  const Variant variant = printed ? Variant::kPrinted : Variant::kResolved;
  const sensors::SonarRing ring;
  const LiPParams lip{.variant = variant};
  for (const GridMass& mass :
       {sonar_li2006(rho, theta, reading, ring, 0.05, 100.0, variant),
        sonar_li2007(rho, theta, reading, ring, 0.05, 100.0, variant), sonar_lip(rho, theta, reading, ring, lip),
        sonar_su(rho, theta, reading, 0.218, 0.05), ZhuSonar(ring).mass(rho, theta, reading)}) {
    RC_ASSERT(mass.empty >= 0.0 && mass.occupied >= 0.0 && mass.conflict >= 0.0 && mass.unknown >= 0.0);
    RC_ASSERT(std::abs(mass.empty + mass.occupied + mass.conflict + mass.unknown - 1.0) < 1e-12);
  }
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
  const Li2007 model(sensors::SonarRing{}, {.no_echo = {.range_m = 1.0}});
  EXPECT_GT(model.no_echo().mass(0.5, 0.0).empty, 0.3);
  EXPECT_EQ(model.no_echo().mass(0.5, 0.0).occupied, 0.0);
  EXPECT_EQ(model.no_echo().mass(1.1, 0.0), GridMass::vacuous());
  EXPECT_EQ(model.no_echo().reach(), 1.0);
}

TEST(Li2007, RefusesParametersThatCannotBe) {
  const sensors::SonarRing ring;
  EXPECT_THROW(Li2007(ring, {.epsilon_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.rho_v_per_m2 = -1.0}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.reliability = 1.1}), std::invalid_argument);
  EXPECT_THROW(Li2007(ring, {.no_echo = {.reliability = std::nan("")}}), std::invalid_argument);
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
