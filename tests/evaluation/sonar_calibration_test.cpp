// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/sonar_calibration.hpp"

#include <gtest/gtest.h>

#include "evaluation/map_score.hpp"
#include "evaluation/simulated_drive.hpp"
#include "mapping/map_rule.hpp"
#include "sim/presets.hpp"
#include "sim/random_world.hpp"

namespace credo::evaluation {
namespace {

struct SonarDrive {
  explicit SonarDrive(std::uint64_t seed) {
    sim::World world = sim::random_world(seed, {.shortest_way_m = 8.0, .longest_way_m = 10.0});
    world.camera.reset();
    world.range_finders.clear();
    world.sonars = {sim::sonar_preset("pioneer-16")};
    const sim::Simulation simulation(std::move(world), seed);
    readings = readings_of(simulation);
    truth = true_map_of(simulation);
    std::vector<sensors::OdometryReading> rows;
    for (const datasets::TimedPose& row : readings.truth) rows.push_back({row.time, row.pose});
    path = sensors::MotionPath(std::move(rows));
  }

  [[nodiscard]] MapScore score(const mapping::SonarParams& sonar) const {
    mapping::TrajectoryMappingParams params;
    params.mapper.sonar = sonar;
    return map_score(
        mapping::map_along(path, readings.header.rig, {}, readings.sonar.front(), params, grids::ReadOut::kDempster)
            .map,
        truth);
  }

  datasets::Dataset readings;
  datasets::OccupancyMap truth;
  sensors::MotionPath path;
};

TEST(SonarCalibration, WhatIsLearnedInOneBuildingMapsAnotherBetterThanThePapersModels) {
  SonarCalibration calibration;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SonarDrive drive(seed);
    calibration.add(drive.path, drive.readings.header.rig.sonar_rings.front(), drive.readings.sonar.front(),
                    drive.truth);
  }
  EXPECT_GT(calibration.cells(), 1000);
  const SonarDrive other(501);
  const MapScore learned = other.score(mapping::CalibratedSonarParams{.weights = calibration.fit()});
  for (const char* model : {"li2006", "li2007", "lip", "su", "zhu"}) {
    const MapScore paper = other.score(mapping::sonar_params(model, 0.05));
    EXPECT_GT(learned.accuracy(), paper.accuracy()) << model;
    EXPECT_LT(learned.brier, paper.brier) << model;
  }
  EXPECT_GT(other.score(mapping::CalibratedSonarParams{}).accuracy(), 0.96);  // the weights that come with it
}

TEST(SonarCalibration, NothingIsLearnedFromNothing) {
  EXPECT_THROW(static_cast<void>(SonarCalibration{}.fit()), std::invalid_argument);
  EXPECT_THROW(SonarCalibration({.ridge = 0.0}), std::invalid_argument);
  EXPECT_THROW(SonarCalibration({.empty_stride = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
