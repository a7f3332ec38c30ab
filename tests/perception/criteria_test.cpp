// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/criteria.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"
#include "range_world.hpp"

namespace credo::perception {
namespace {

using evidence::BinaryMass;

void expect_mass(const BinaryMass& mass, double yes, double no, const char* what) {
  EXPECT_NEAR(mass.yes, yes, 1e-12) << what;
  EXPECT_NEAR(mass.no, no, 1e-12) << what;
  EXPECT_NEAR(mass.yes + mass.no + mass.unknown, 1.0, 1e-12) << what;
}

TEST(Criteria, AlignmentInExpectedStandardDeviations) {
  for (const auto& [sigmas, yes, no] : {std::array{0.8, 0.8, 0.0},
                                        {1.0, 0.8, 0.0},
                                        {1.75, 0.4, 0.0},
                                        {2.5, 0.0, 0.125},
                                        {3.0, 0.0, 0.25},
                                        {4.0, 0.0, 0.5},
                                        {9.0, 0.0, 0.5}})
    expect_mass(segment_criteria({.mean_residual_sigmas = sigmas})[0], yes, no, "alignment");
}

TEST(Criteria, SupportSpeaksAgainstVeryFewPointsOnly) {
  for (const auto& [points, yes, no] : {std::array{1.0, 0.0, 0.4}, {3.0, 0.0, 0.4}, {6.0, 0.2, 0.0}, {12.0, 0.6, 0.0}})
    expect_mass(segment_criteria({.support = static_cast<int>(points)})[1], yes, no, "support");
}

TEST(Criteria, FarIsIgnoranceNotDenial) {
  for (const auto& [density, yes] : {std::array{0.1, 0.0}, {0.2, 0.0}, {0.6, 0.35}, {1.0, 0.7}, {3.0, 0.7}})
    expect_mass(segment_criteria({.support = 20, .relative_density = density})[2], yes, 0.0, "density");
}

TEST(Criteria, EndsByTheirFiveCases) {
  const double yes[] = {0.1, 0.3, 0.5, 0.65, 0.8}, no[] = {0.2, 0.1, 0.0, 0.0, 0.0};
  for (int i = 0; i < 5; ++i) expect_mass(segment_criteria({.endpoint_case = i + 1})[3], yes[i], no[i], "case");
}

TEST(Criteria, WhatWasNotMeasuredIsVacuous) {
  const auto criteria = segment_criteria({.support = 20});
  EXPECT_EQ(criteria[0], BinaryMass::vacuous());
  EXPECT_EQ(criteria[3], BinaryMass::vacuous()) << "no camera";
  EXPECT_EQ(criteria[4], BinaryMass::vacuous()) << "no image";
}

// The absolute shapes of the paper's method at both sides of their breakpoints.
TEST(Criteria, PaperShapesAreAbsolute) {
  const CriteriaParams paper = CriteriaParams::paper();
  const auto at = [&](const SegmentMeasures& m) { return segment_criteria(m, paper); };
  expect_mass(at({.mean_residual_m = 0.010})[0], 0.70, 0.0, "1");
  expect_mass(at({.mean_residual_m = 0.025})[0], 0.35, 0.0, "1");
  expect_mass(at({.mean_residual_m = 0.080})[0], 0.0, 0.40, "1");
  expect_mass(at({.support = 8})[1], 0.0, 0.0, "2");
  expect_mass(at({.support = 3})[1], 0.0, 0.6, "2");
  expect_mass(at({.support = 20, .density_per_m = 20.0})[2], 0.6, 0.0, "3");
  expect_mass(at({.support = 20, .density_per_m = 3.0})[2], 0.0, 0.3, "3");
  expect_mass(at({.endpoint_case = 1})[3], 0.0, 0.3, "4");
  expect_mass(at({.endpoint_case = 5})[3], 0.7, 0.0, "4");
  expect_mass(at({.mean_gray_deviation = 5.0})[4], 0.5, 0.0, "5");
  expect_mass(at({.mean_gray_deviation = 40.0})[4], 0.0, 0.4, "5");
}

RC_GTEST_PROP(Criteria, AreMassesWhateverIsMeasured, ()) {
  const auto number = [] { return *rc::gen::inRange(0, 1000) * 0.05; };
  const SegmentMeasures measures{.mean_residual_m = number() * 0.01,
                                 .mean_residual_sigmas = number(),
                                 .support = *rc::gen::inRange(0, 100),
                                 .density_per_m = number(),
                                 .relative_density = number() * 0.1,
                                 .endpoint_case = *rc::gen::inRange(0, 6),
                                 .mean_gray_deviation = number(),
                                 .mean_gray_sigmas = number()};
  for (const CriteriaParams& params : {CriteriaParams{}, CriteriaParams::paper()})
    for (const BinaryMass& mass : segment_criteria(measures, params)) {
      RC_ASSERT(mass.yes >= 0.0 && mass.no >= 0.0 && mass.unknown >= 0.0);
      RC_ASSERT(std::abs(mass.yes + mass.no + mass.unknown - 1.0) < 1e-12);
    }
}

TEST(Criteria, ShapesAreValid) {
  for (const CriteriaParams& params : {CriteriaParams{}, CriteriaParams::paper()}) {
    EXPECT_NO_THROW(evidence::check(params.alignment, "alignment"));
    EXPECT_NO_THROW(evidence::check(params.support, "support"));
    EXPECT_NO_THROW(evidence::check(params.density, "density"));
    EXPECT_NO_THROW(evidence::check(params.gray, "gray"));
  }
}

TEST(Criteria, AWallHeadOnAtTwoMetresHasRelativeDensityOne) {
  for (const int count : {180, 360, 1000}) {
    RangeWorld world;
    world.add(-0.4, 2.0, 0.4, 2.0);
    const auto finder = full_turn(count, {0.01, 0.0});
    std::vector<sensors::ScanPoint> points;
    sensors::carry_scan(scan_of(world, finder), finder, {}, 0, points);
    const PointNoise noise{finder.noise, {}};
    SegmentMeasures measures;
    measure_points(points, fit_line(points, noise).line, finder.angle_increment_rad, noise, {}, measures);
    EXPECT_NEAR(measures.relative_density, 1.0, 0.05) << count;
    EXPECT_EQ(measures.support, static_cast<int>(points.size()));
  }
}

TEST(Criteria, NormalNoiseHasAMeanResidualOfPointEight) {
  RangeWorld world;
  world.add(-2.0, 2.0, 2.0, 2.0);
  const auto finder = full_turn(720, {0.01, 0.0});
  const PointNoise noise{finder.noise, {.flatness_m = 0.0}};
  double sum = 0.0;
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    std::vector<sensors::ScanPoint> points;
    sensors::carry_scan(scan_of(world, finder, {}, seed), finder, {}, 0, points);
    SegmentMeasures measures;
    measure_points(points, fit_line(points, noise).line, finder.angle_increment_rad, noise, {}, measures);
    sum += measures.mean_residual_sigmas;
  }
  EXPECT_NEAR(sum / 50.0, std::sqrt(2.0 / std::numbers::pi), 0.03);
}

TEST(GrayDeviation, IsThatFromAStraightLine) {
  GrayCurve gray{.values = std::vector<float>(1024, 100.0F), .noise = 1.0};
  EXPECT_NEAR(gray_deviation(gray, 0.3, 1.0), 0.0, 1e-9);
  for (std::size_t i = 0; i < 1024; ++i) gray.values[i] = 50.0F + 0.1F * static_cast<float>(i);
  EXPECT_NEAR(gray_deviation(gray, 0.3, 1.0), 0.0, 1e-3) << "a slope is a straight line";
  for (std::size_t i = 0; i < 1024; ++i) gray.values[i] = i % 2 == 0 ? 90.0F : 110.0F;
  EXPECT_NEAR(gray_deviation(gray, 0.3, 1.0), 10.0, 0.1);
  // An edge in the middle of the sector, of 20 grey levels.
  for (std::size_t i = 0; i < 1024; ++i) gray.values[i] = i < 130 ? 90.0F : 110.0F;
  EXPECT_GT(gray_deviation(gray, 0.3, 1.0), 2.0);
}

TEST(GrayDeviation, GoesRoundTheCircle) {
  GrayCurve gray{.values = std::vector<float>(360, 10.0F), .noise = 1.0};
  gray.values[180] = 200.0F;  // opposite of the sector
  EXPECT_NEAR(gray_deviation(gray, -0.5, 1.0), 0.0, 1e-9);
  EXPECT_NEAR(gray_deviation(gray, 2.0 * std::numbers::pi - 0.5, 1.0), 0.0, 1e-9);
  EXPECT_GT(gray_deviation(gray, std::numbers::pi - 0.5, 1.0), 1.0);
}

TEST(GrayDeviation, IsNotANumberWithoutBins) {
  EXPECT_TRUE(std::isnan(gray_deviation({}, 0.0, 1.0)));
  EXPECT_TRUE(std::isnan(gray_deviation({.values = std::vector<float>(360, 1.0F)}, 0.0, 0.05)));
}

TEST(ConflictMeans, AreOverTheSegments) {
  std::array<BinaryMass, 5> criteria;
  criteria[0] = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  criteria[1] = {.yes = 0.0, .no = 0.4, .unknown = 0.6};
  ConflictMeans means;
  means.add(criteria, 0.32);
  means.add({}, 0.0);
  Scene scene;
  means.write(scene);
  EXPECT_NEAR(scene.mean_conflict, 0.16, 1e-12);
  EXPECT_NEAR(scene.conflicts.pair[0][1], 0.16, 1e-12);
  EXPECT_NEAR(scene.conflicts.pair[1][0], 0.16, 1e-12);
  EXPECT_EQ(scene.conflicts.pair[2][3], 0.0);
  ConflictMeans{}.write(scene);
  EXPECT_EQ(scene.mean_conflict, 0.0);
}

}  // namespace
}  // namespace credo::perception
