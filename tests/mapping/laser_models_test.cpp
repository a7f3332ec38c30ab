// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/cell_rules.hpp"
#include "mapping/changing_fold.hpp"
#include "mapping/laser_choice.hpp"
#include "mapping/sequential_mapper.hpp"
#include "mapping/simple_mass.hpp"
#include "mapping/sonar_choice.hpp"
#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using evidence::GridMass;
using evidence::LogCommonality;

constexpr sensors::RangeNoise kFlight{.sigma_0_m = 0.01, .k_per_m = 0.0};
constexpr sensors::RangeNoise kTriangulation{.sigma_0_m = 0.005, .k_per_m = 0.0045};

/// What one reading adds where it hits.
template <LaserModel Model>
GridMass hit(const Model& model, double reading_m, const sensors::RangeNoise& noise) {
  return evidence::discount(model.hit_mass(), model.reliability() * model.hit_share(reading_m, noise));
}
template <LaserModel Model>
GridMass free(const Model& model) {
  return evidence::discount(model.free_mass(), model.reliability());
}

double pignistic_of(const GridMass& mass) {
  return evidence::pignistic(mass, evidence::GridElement::kOccupied, evidence::GridModel::kExclusive);
}
/// What the rule `bayes` reads.
double bayes_of(const GridMass& mass) {
  return evidence::plausibility_probability_occupied(evidence::log_commonality(mass, 1.0 - 1e-15));
}

TEST(Li2006Laser, PrintedIsThePapersMassesAtAnyRange) {
  const Li2006Laser model({.variant = Variant::kPrinted});
  for (const double reading_m : {0.5, 3.9}) {
    EXPECT_DOUBLE_EQ(model.half_width(reading_m, kTriangulation), 0.05);
    EXPECT_DOUBLE_EQ(model.free_margin(reading_m, kTriangulation), 0.05);
    const GridMass occupied = laser_li2006(reading_m, reading_m, 0.05), empty = laser_li2006(0.1, reading_m, 0.05);
    EXPECT_NEAR(hit(model, reading_m, kTriangulation).occupied, occupied.occupied, 1e-12);
    EXPECT_NEAR(hit(model, reading_m, kTriangulation).unknown, occupied.unknown, 1e-12);
    EXPECT_NEAR(free(model).empty, empty.empty, 1e-12);
    EXPECT_NEAR(free(model).occupied, empty.occupied, 1e-12);
  }
}

TEST(BayesLaser, OneReadingHasTheProbabilityThatTheMatchedMassesHaveAsPignisticOne) {
  for (const Variant variant : {Variant::kResolved, Variant::kPrinted}) {
    const Li2006LaserParams matched{.variant = variant};
    const Li2006Laser evidential(matched);
    const BayesLaser bayes({matched});
    EXPECT_NEAR(bayes_of(free(bayes)), pignistic_of(free(evidential)), 1e-9);
    for (const double reading_m : {0.5, 2.0, 3.9}) {
      EXPECT_NEAR(bayes_of(hit(bayes, reading_m, kTriangulation)),
                  pignistic_of(hit(evidential, reading_m, kTriangulation)), 1e-9);
      EXPECT_EQ(bayes.half_width(reading_m, kTriangulation), evidential.half_width(reading_m, kTriangulation));
      EXPECT_EQ(bayes.free_margin(reading_m, kTriangulation), evidential.free_margin(reading_m, kTriangulation));
    }
  }
}

TEST(BayesLaser, ReadAsBayesItIsTheLogOddsFilterOfTheMatchedMasses) {
  const GridMass readings[] = {free(Li2006Laser{}), hit(Li2006Laser{}, 1.0, kFlight), free(Li2006Laser{})};
  const GridMass simple[] = {free(BayesLaser{}), hit(BayesLaser{}, 1.0, kFlight), free(BayesLaser{})};
  BayesFold::Cell filter = 0.0;
  LogCommonality sum;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(BayesFold{}.update(filter, readings[i]));
    sum += evidence::log_commonality(simple[i], 1.0 - 1e-15);
  }
  EXPECT_NEAR(evidence::plausibility_probability_occupied(sum), BayesFold{}.masses(filter).occupied, 1e-9);
}

TEST(BayesSonar, OneReadingHasTheProbabilityThatTheMatchedMassesHaveAsPignisticOne) {
  const sensors::SonarRing ring;
  const AnySonarModel bayes = sonar_model(ring, BayesSonarParams{}), evidential = sonar_model(ring, Li2007Params{});
  for (const double rho_m : {0.3, 1.2, 1.45, 1.5, 1.54, 1.7})
    for (const double theta_rad : {0.0, 0.1, 0.2, 0.3}) {
      EXPECT_NEAR(bayes_of(evidence::discount(bayes.mass(rho_m, theta_rad, 1.5), bayes.reliability())),
                  pignistic_of(evidence::discount(evidential.mass(rho_m, theta_rad, 1.5), evidential.reliability())),
                  1e-9);
      EXPECT_NEAR(bayes_of(evidence::discount(bayes.no_echo().mass(rho_m, theta_rad), bayes.no_echo().reliability())),
                  pignistic_of(evidence::discount(evidential.no_echo().mass(rho_m, theta_rad),
                                                  evidential.no_echo().reliability())),
                  1e-9);
    }
  EXPECT_EQ(bayes.reach(1.5), evidential.reach(1.5));
  EXPECT_EQ(bayes.no_echo().reach(), evidential.no_echo().reach());
}

LaserWeights weights_of(double free, double hit) {
  return {.free_weight = free, .hit_weights = std::vector<double>(LaserKnots::kCount, hit)};
}

TEST(CalibratedLaser, WeightsAreWeightsOfEvidence) {
  CalibratedLaserParams params{.free_margin = {.least_m = 0.05, .sigmas = 2.0},
                               .half_width = {.least_m = 0.02, .sigmas = 1.0},
                               .summed = weights_of(0.4, 0.7),
                               .alone = weights_of(1.5, 1.2)};
  const CalibratedLaser model(params);
  EXPECT_NEAR(-std::log(free(model).unknown), 0.4, 1e-12);
  EXPECT_EQ(free(model).occupied, 0.0);
  EXPECT_NEAR(-std::log(hit(model, 1.3, kFlight).unknown), 0.7, 1e-12);
  EXPECT_EQ(hit(model, 1.3, kFlight).empty, 0.0);
  EXPECT_DOUBLE_EQ(model.free_margin(4.0, kTriangulation), 2.0 * kTriangulation.sigma(4.0));
  EXPECT_DOUBLE_EQ(model.free_margin(4.0, kFlight), 0.05);
  EXPECT_DOUBLE_EQ(model.half_width(1.0, kFlight), 0.02);

  params.summed.hit_weights.back() = -3.0;  // of the noisiest and farthest: no evidence, rather than evidence against
  EXPECT_EQ(CalibratedLaser(params).hit_share(12.0, {.sigma_0_m = 0.1, .k_per_m = 0.0}), 0.0);
  EXPECT_NEAR(-std::log(hit(CalibratedLaser(params), 1.0, kFlight).unknown), 0.7, 1e-12);

  const CalibratedLaser alone(params, ReadingsTaken::kAlone);
  EXPECT_NEAR(-std::log(free(alone).unknown), 1.5, 1e-12);
  EXPECT_NEAR(-std::log(hit(alone, 1.3, kFlight).unknown), 1.2, 1e-12);
  EXPECT_EQ(alone.free_margin(4.0, kTriangulation), model.free_margin(4.0, kTriangulation));
}

/// What the laser says of the cell that it hits at 6 m, and of one before it, in one scan.
template <CellRule Rule>
std::pair<GridMass, GridMass> after_one_scan(const MapperParams& params) {
  SequentialMapper<Rule> mapper(rig_with(panoramic()), params);
  const Pose2 pose{2.0, 1.5, 0.0};
  mapper.insert(certain(pose), scan_of_room(panoramic(), pose, 6.01, 3.0));
  const grids::MassMap masses = mapper.masses();
  return {masses.at({120, 30}), masses.at({60, 30})};
}

TEST(CalibratedLaser, ARuleThatForgetsTakesWhatAReadingIsWorthByItself) {
  MapperParams params;
  params.laser = CalibratedLaserParams{.free_margin = {.least_m = 0.05, .sigmas = 0.0},
                                       .half_width = {.least_m = 0.05, .sigmas = 0.0},
                                       .summed = weights_of(0.4, 0.7),
                                       .alone = weights_of(1.5, 1.2)};
  const auto [summed_hit, summed_free] = after_one_scan<DempsterFold>(params);
  const auto [alone_hit, alone_free] = after_one_scan<DsmhFold>(params);
  EXPECT_NEAR(-std::log(summed_hit.unknown), 0.7, 1e-3);
  EXPECT_NEAR(-std::log(summed_free.unknown), 0.4, 1e-3);
  EXPECT_NEAR(-std::log(alone_hit.unknown), 1.2, 1e-3);
  EXPECT_NEAR(-std::log(alone_free.unknown), 1.5, 1e-3);
}

TEST(CalibratedLaser, WhatChangesIsFollowedWithinThreeScans) {
  MapperParams params;
  params.laser = default_calibrated_laser();
  const sensors::Rig rig = rig_with(panoramic());
  SequentialMapper<ChangingFold> mapper(rig, params);
  const Pose2 pose{2.0, 1.5, 0.0};
  sensors::Timestamp time = 0;
  const auto scan = [&](int times, double width_m) {
    for (int i = 0; i < times; ++i) {
      sensors::RangeScan one = scan_of_room(panoramic(), pose, width_m, 3.0);
      one.time = time += sensors::from_seconds(0.2);
      mapper.insert(certain(pose), one);
    }
  };
  const auto pignistic = [&](int x) { return pignistic_of(mapper.masses().at({x, 30})); };
  scan(20, 6.01);
  ASSERT_LT(pignistic(80), 0.1);
  ASSERT_GT(pignistic(120), 0.9);
  scan(3, 4.01);  // a screen stands in the room
  EXPECT_GT(pignistic(80), 0.9);
  EXPECT_GT(pignistic(120), 0.9);
  scan(3, 6.01);  // and is gone
  EXPECT_LT(pignistic(80), 0.1);
}

TEST(CalibratedLaser, RefusesWhatCannotBe) {
  const auto refused = [](const auto& spoil) {
    CalibratedLaserParams params = default_calibrated_laser();
    spoil(params);
    EXPECT_THROW(CalibratedLaser{params}, std::invalid_argument);
  };
  refused([](auto& params) { params.summed.hit_weights.pop_back(); });
  refused([](auto& params) { params.alone.hit_weights.pop_back(); });
  refused([](auto& params) { params.summed.hit_weights[3] = std::nan(""); });
  refused([](auto& params) { params.alone.free_weight = -0.1; });
  refused([](auto& params) { params.half_width.least_m = params.free_margin.least_m + 0.01; });
  refused([](auto& params) { params.half_width.sigmas = params.free_margin.sigmas + 0.5; });
  refused([](auto& params) { params.half_width.least_m = 0.0; });
}

TEST(LaserChoice, EveryModelFindsTheRoom) {
  for (const std::string_view name : laser_model_names()) {
    MapperParams params;
    params.laser = laser_params(name);
    EXPECT_EQ(name_of(params.laser), name);
    Mapper mapper(rig_with(panoramic()), params);
    const Pose2 pose{2.0, 1.5, 0.3};
    mapper.insert(certain(pose), scan_of_room(panoramic(), pose, 6.0, 3.0));
    const auto occupied = [&](int x) { return evidence::pignistic_occupied(mapper.grid().at({x, 30}).value()); };
    EXPECT_LT(occupied(60), 0.5) << name;
    EXPECT_GT(std::max({occupied(119), occupied(120), occupied(121)}), 0.5) << name;
  }
  EXPECT_THROW(static_cast<void>(laser_params("li2007")), std::invalid_argument);
}

TEST(CalibratedLaser, SpeaksOfWallsWithAnyNoiseAndAtAnyRange) {
  for (const ReadingsTaken taken : {ReadingsTaken::kSummed, ReadingsTaken::kAlone}) {
    const CalibratedLaser laser(default_calibrated_laser(), taken);
    double before = 1.0;
    for (const double sigma_m : {0.005, 0.01, 0.02, 0.04, 0.08, 0.2, 0.5})
      for (const double reading_m : {1.0, 3.5, 10.0, 30.0})
        EXPECT_GT(laser.hit_mass().occupied * laser.hit_share(reading_m, {.sigma_0_m = sigma_m, .k_per_m = 0.0}), 0.01)
            << sigma_m << " m, at " << reading_m;
    for (const double sigma_m : {0.08, 0.16, 0.32}) {
      const double share = laser.hit_share(3.5, {.sigma_0_m = sigma_m, .k_per_m = 0.0});
      EXPECT_LT(share, before);
      before = share;
    }
  }
}

}  // namespace
}  // namespace credo::mapping
