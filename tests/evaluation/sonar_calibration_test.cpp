// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/sonar_calibration.hpp"

#include <gtest/gtest.h>

#include "mapping/sonar_choice.hpp"

namespace credo::evaluation {
namespace {

constexpr sim::RandomWorldParams kShort{.shortest_way_m = 8.0, .longest_way_m = 10.0};

TEST(SonarCalibration, WhatIsLearnedInOneBuildingMapsAnotherBetterThanThePapersModels) {
  SonarCalibration calibration;
  for (const std::uint64_t seed : {1, 2, 3}) add_simulated_drive(calibration, seed, kShort);
  EXPECT_GT(calibration.cells(), 1000);
  const MapDrive other = sonar_drive(501, kShort);
  const auto score_of = [&](const mapping::SonarParams& sonar) {
    MapMethod method{"", {}, grids::ReadOut::kDempster};
    method.params.mapper.sonar = sonar;
    return map_score(map_by(method, other).map, other.truth);
  };
  const MapScore learned = score_of(mapping::CalibratedSonarParams{.weights = calibration.fit()});
  for (const char* model : {"li2006", "li2007", "lip", "su", "zhu"}) {
    const MapScore paper = score_of(mapping::sonar_params(model, 0.05));
    EXPECT_GT(learned.accuracy(), paper.accuracy()) << model;
    EXPECT_LT(learned.brier, paper.brier) << model;
  }
  EXPECT_GT(score_of(mapping::CalibratedSonarParams{}).accuracy(), 0.96);  // the weights that come with it
}

TEST(SonarCalibration, ATruthOfKilometresIsRefusedBeforeRoomIsMadeForIt) {
  MapDrive drive = sonar_drive(1, kShort);
  drive.truth.resolution_m = 100.0;
  SonarCalibration calibration;
  EXPECT_THROW(calibration.add(drive.T_map_base, drive.rig.sonar_rings.front(), drive.sweeps, drive.truth),
               std::length_error);
}

TEST(SonarCalibration, NothingIsLearnedFromNothing) {
  EXPECT_THROW(static_cast<void>(SonarCalibration{}.fit()), std::invalid_argument);
  EXPECT_THROW(SonarCalibration({.regression = {.ridge = 0.0}}), std::invalid_argument);
  EXPECT_THROW(SonarCalibration({.empty_stride = 0, .regression = {}}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
