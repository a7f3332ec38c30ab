// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/laser_calibration.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "mapping/laser_choice.hpp"

namespace credo::evaluation {
namespace {

constexpr sim::RandomWorldParams kShort{.shortest_way_m = 6.0, .longest_way_m = 8.0};

MapScore score_of(const mapping::LaserParams& laser, const MapDrive& drive) {
  MapMethod method{"", {}, grids::ReadOut::kDempster};
  method.params.mapper.laser = laser;
  return map_score(map_by(method, drive).map, drive.truth);
}

TEST(LaserCalibration, WhatIsLearnedInSomeBuildingsMapsAnotherBetterThanThePapersModel) {
  LaserCalibration calibration;
  for (const std::uint64_t seed : {1, 2, 3, 4}) add_simulated_drive(calibration, seed, kShort);
  EXPECT_GT(calibration.cells(), 1000);
  const MapDrive other = laser_drive(502, kShort);
  const MapScore learned = score_of(calibration.fit(), other);
  for (const char* model : {"li2006", "bayes"}) {
    const MapScore paper = score_of(mapping::laser_params(model), other);
    EXPECT_GE(learned.accuracy(), paper.accuracy() - 0.001) << model;
    EXPECT_LT(learned.brier, paper.brier) << model;
    EXPECT_LT(learned.log_loss, paper.log_loss) << model;
  }
  EXPECT_GT(score_of(mapping::laser_params("calibrated"), other).accuracy(), 0.98);  // the weights that come with it
}

/// Learned from range finders of little noise: what they do not have is no reason to see no wall.
TEST(LaserCalibration, WhatIsLearnedOfSomeRangeFindersSeesWallsWithAnother) {
  LaserCalibration calibration;
  for (const std::uint64_t seed : {1, 3}) add_simulated_drive(calibration, seed, kShort);
  sim::RandomWorldParams flight = kShort;
  flight.range_preset = "tof-lms";
  for (const double sigma_m : {0.08, 0.12}) {
    const MapDrive noisy = laser_drive(503, flight, sigma_m);
    for (const mapping::CalibratedLaserParams& laser : {calibration.fit(), mapping::default_calibrated_laser()})
      EXPECT_LT(score_of(laser, noisy).missed_m, 0.1) << sigma_m;
  }
}

TEST(LaserCalibration, AReadingByItselfIsWorthMoreThanOneOfMany) {
  LaserCalibration calibration;
  for (const std::uint64_t seed : {1, 2, 3, 4}) add_simulated_drive(calibration, seed, kShort);
  const auto sum = [](const std::vector<double>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
  };
  const mapping::CalibratedLaserParams learned = calibration.fit(), shipped = mapping::default_calibrated_laser();
  for (const mapping::CalibratedLaserParams& laser : {learned, shipped}) {
    EXPECT_GT(laser.alone.free_weight, laser.summed.free_weight);
    EXPECT_GT(sum(laser.alone.hit_weights), sum(laser.summed.hit_weights));
  }
}

TEST(LaserCalibration, TellsHowFarItIsAndCanBeEnded) {
  LaserCalibration calibration;
  double last = 0.0;
  int calls = 0;
  add_simulated_drive(calibration, 1, kShort, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
    ++calls;
  });
  EXPECT_GT(calls, 100);
  EXPECT_EQ(last, 1.0);
  const auto stop = [](double) { throw std::runtime_error("stop"); };
  EXPECT_THROW(static_cast<void>(calibration.fit(stop)), std::runtime_error);
  EXPECT_THROW(add_simulated_drive(calibration, 2, kShort, stop), std::runtime_error);
}

TEST(LaserCalibration, NothingIsLearnedFromNothing) {
  EXPECT_THROW(static_cast<void>(LaserCalibration{}.fit()), std::invalid_argument);
  EXPECT_THROW(LaserCalibration({.regression = {.ridge = 0.0}}), std::invalid_argument);
  EXPECT_THROW(LaserCalibration({.empty_stride = 0, .regression = {}}), std::invalid_argument);
  EXPECT_THROW(LaserCalibration({.alone_stride = 0, .regression = {}}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
