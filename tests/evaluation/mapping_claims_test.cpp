// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// What is said of the maps (docs/mapping.md, docs/reproduce.md), each once, at random seed 1.

#include <gtest/gtest.h>

#include "evaluation/change_score.hpp"
#include "evaluation/map_experiment.hpp"
#include "evaluation/settings_sweep.hpp"
#include "evaluation/simulated_drive.hpp"

namespace credo::evaluation {
namespace {

sim::World shipped(const char* name) {
  return sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/" + std::string(name) + ".yaml");
}

TEST(MappingClaims, TheCalibratedSonarIsRightInTheRoomOfLi2007) {
  const MapDrive drive = play_for_mapping(shipped("li2007"), 1);
  MapMethod method{"", {}, grids::ReadOut::kDempster};
  method.params.mapper.sonar = mapping::CalibratedSonarParams{};
  EXPECT_GE(map_score(map_by(method, drive).map, drive.truth).accuracy(), 0.96);
}

TEST(MappingClaims, DsmcAndDempsterDecideAlikeFromTheSameLogCommonalities) {
  const MapDrive drive = play_for_mapping(shipped("li2007"), 1);
  mapping::TrajectoryMappingParams params;
  params.mapper.sonar = mapping::Li2007Params{.rho_v_per_m2 = 1.0, .variant = mapping::Variant::kResolved};
  params.mapper.freshness.correlation = 0.0;
  const auto map = [&](const mapping::MapRule& rule) { return map_by({"", params, rule}, drive).map; };
  EXPECT_EQ(decided_differently(map(grids::ReadOut::kDsmc), map(grids::ReadOut::kDempster)).cells, 0);
}

/// In linear masses they do until those of DSmC underflow.
TEST(MappingClaims, DsmcAndDempsterDecideAlikeReadingByReadingButForUnderflow) {
  for (const char* world : {"li2007", "li2007_slow"}) {
    const MapDrive drive = play_for_mapping(shipped(world), 1);
    for (const mapping::Variant variant : {mapping::Variant::kPrinted, mapping::Variant::kResolved}) {
      mapping::TrajectoryMappingParams params;
      params.mapper.sonar = mapping::Li2007Params{.epsilon_m = 0.1,
                                                  .rho_v_per_m2 = 1.0,
                                                  .reliability = 1.0,
                                                  .no_echo = {.reliability = 0.0},
                                                  .variant = variant};
      params.mapper.freshness.correlation = 0.0;
      const grids::MassMap dsmc = map_by({"", params, mapping::DsmcFold{}}, drive).map;
      const grids::MassMap dempster = map_by({"", params, mapping::DempsterFold{}}, drive).map;
      const DecidedDifferently different = decided_differently(dsmc, dempster);
      EXPECT_EQ(different.cells, different.underflown) << world;
      EXPECT_LT(static_cast<double>(different.cells), 0.01 * static_cast<double>(dsmc.masses.size())) << world;
    }
  }
}

/// The settings of `credo reproduce improved-ds`.
TEST(MappingClaims, TheAdaptiveApproximationLeavesAFifthFewerWrongCells) {
  using mapping::Approximation;
  const MapDrive drive = play_for_mapping(shipped("zhu"), 1);
  SweptErrors fixed, adaptive;
  const auto wrong = [&](double e, double rho, double n, Approximation approximation) {
    MapMethod method{
        "", {}, mapping::ApproximatedDempsterFold{{.e1 = e, .e2 = e, .e3 = e, .approximation = approximation}}};
    method.params.mapper.sonar = mapping::ZhuParams{.rho = rho, .cells_of_arc = n};
    method.params.mapper.freshness.correlation = 0.0;
    const MapScore score = map_score(decided_by_zhu(map_by(method, drive).map), drive.truth);
    return static_cast<double>(score.cells - score.right);
  };
  for (const double e : {0.01, 0.05, 0.1})
    for (const double rho : {0.1, 0.3, 0.5, 0.9})
      for (const double n : {10.0, 20.0, 40.0}) {
        fixed.push_back({wrong(e, rho, n, Approximation::kFixed)});
        adaptive.push_back({wrong(e, rho, n, Approximation::kAdaptive)});
      }
  EXPECT_GE(median_of(reductions(fixed, adaptive)), 0.20);
}

TEST(MappingClaims, AWorldThatChangesIsFollowed) {
  const sim::World world = shipped("changing");
  const MapDrive drive = play_for_mapping(world, 1);
  const std::vector<datasets::TruthState> states = true_states_of(sim::Simulation(world, 1));
  const ChangeScore score = change_score(drive.T_map_base, drive.rig, drive.scans, states, {}, mapping::ChangingFold{});
  EXPECT_GT(score.changed_5, 100);
  EXPECT_GE(score.followed_5(), 0.95);
  EXPECT_LE(score.wrong_share(), 0.01);
}

}  // namespace
}  // namespace credo::evaluation
