// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_calibrated.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::mapping {
namespace {

using evidence::GridMass;

TEST(CalibratedSonar, WeightsAreWeightsOfEvidence) {
  CalibratedSonarParams params;
  params.weights.assign(SonarKnots::kCount, 0.7);
  const GridMass occupied = CalibratedSonar(sensors::SonarRing{}, params).mass(1.0, 0.1, 1.3);
  EXPECT_NEAR(-std::log(occupied.unknown), 0.7, 1e-12);
  EXPECT_EQ(occupied.empty, 0.0);
  params.weights.assign(SonarKnots::kCount, -0.4);
  const CalibratedSonar model(sensors::SonarRing{}, params);
  EXPECT_NEAR(-std::log(model.mass(1.0, 0.1, 1.3).unknown), 0.4, 1e-12);
  EXPECT_EQ(model.mass(1.0, 0.1, 1.3).occupied, 0.0);
  EXPECT_NEAR(-std::log(model.no_echo().mass(1.0, 0.1).unknown), 0.4, 1e-12);
}

TEST(CalibratedSonar, TheDefaultKnowsWhereTheEchoIsFrom) {
  const CalibratedSonar model(sensors::SonarRing{});
  EXPECT_GT(model.mass(1.5, 0.0, 1.5).occupied, 0.02);
  EXPECT_GT(model.mass(0.6, 0.0, 1.5).empty, 0.02);
  EXPECT_EQ(model.mass(1.5, 0.3, 1.5), GridMass::vacuous());       // beside the cone
  EXPECT_EQ(model.mass(1.9, 0.0, 1.5), GridMass::vacuous());       // beyond the reach
  EXPECT_EQ(model.no_echo().mass(0.1, 0.0), GridMass::vacuous());  // nearer than it hears
  EXPECT_EQ(model.no_echo().mass(1.0, 0.23), GridMass::vacuous());
}

TEST(CalibratedSonar, SharesOfTheWeightsSumToOne) {
  for (const double rho : {0.1, 0.55, 1.49, 1.5, 1.62, 4.0})
    for (const double aside : {0.0, 0.2, 0.99, 1.0})
      for (const double reading : {0.1, 0.7, 1.5, 3.0, 5.0}) {
        double sum = 0.0;
        for_each_echo_weight(rho, aside, reading, [&](std::size_t i, double share) {
          EXPECT_LT(i, SonarKnots::kEcho);
          sum += share;
        });
        EXPECT_NEAR(sum, 1.0, 1e-12);
        sum = 0.0;
        for_each_no_echo_weight(rho, aside, [&](std::size_t i, double share) {
          EXPECT_TRUE(i >= SonarKnots::kEcho && i < SonarKnots::kCount);
          sum += share;
        });
        EXPECT_NEAR(sum, 1.0, 1e-12);
      }
}

TEST(CalibratedSonar, RefusesWeightsThatCannotBe) {
  EXPECT_THROW(CalibratedSonar(sensors::SonarRing{}, {.weights = {1.0, 2.0}}), std::invalid_argument);
  CalibratedSonarParams params;
  params.weights[3] = std::nan("");
  EXPECT_THROW(CalibratedSonar(sensors::SonarRing{}, params), std::invalid_argument);
}

}  // namespace
}  // namespace credo::mapping
