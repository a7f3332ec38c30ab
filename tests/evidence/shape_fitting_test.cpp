// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/shape_fitting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "evidence/predictive_belief.hpp"
#include "tests/evidence/labelled_samples.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Samples = std::vector<LabelledSample>;

const ShapeTitle kTitle{.name = "fitted", .quantity = "score", .unit = "1"};

TEST(ShapeFitting, HoldsItsConfidenceOnSamplesThatWereNotFitted) {
  for (const auto truth : {rising_truth, falling_truth}) {
    for (const std::size_t count : {30u, 100u, 1000u, 10'000u}) {
      EXPECT_GT(mean_calibration(truth, count, .95).coverage, .92) << count;
      EXPECT_GT(mean_calibration(truth, count, .8).coverage, .77) << count;
    }
  }
}

TEST(ShapeFitting, LessConfidenceCoversLessAndLeavesLessUnknown) {
  const Calibration sure = mean_calibration(rising_truth, 300, .99);
  const Calibration bold = mean_calibration(rising_truth, 300, .3);
  EXPECT_GT(sure.coverage, .97);
  EXPECT_LT(bold.coverage, .75);
  EXPECT_LT(bold.mean_unknown, .5 * sure.mean_unknown);
}

TEST(ShapeFitting, MoreSamplesLeaveLessUnknownAndAreBetterCalibrated) {
  const Calibration few = mean_calibration(rising_truth, 30, .95);
  const Calibration many = mean_calibration(rising_truth, 10'000, .95);
  EXPECT_GT(few.mean_unknown, .4);
  EXPECT_LT(many.mean_unknown, .06);
  EXPECT_LT(many.calibration_error, .015);
  EXPECT_GT(few.calibration_error, .05);
}

TEST(ShapeFitting, FindsTheDirectionOrTakesTheOneGiven) {
  EXPECT_EQ(fit_shape(drawn(rising_truth, 200, 1), kTitle).direction, Direction::kRising);
  EXPECT_EQ(fit_shape(drawn(falling_truth, 200, 1), kTitle).direction, Direction::kFalling);
  // Against its will a shape is constant.
  const FittedShape forced = fit_shape(drawn(falling_truth, 2000, 1), kTitle, {.direction = Direction::kRising});
  EXPECT_EQ(forced.direction, Direction::kRising);
  for (const Breakpoint& point : forced.shape.breakpoints()) {
    EXPECT_EQ(point.yes, forced.shape.breakpoints().front().yes);
  }
  EXPECT_GT(forced.held_out->refuted, .5);
}

TEST(ShapeFitting, FewBreakpointsAreRefutedByManySamples) {
  const Samples samples = drawn(rising_truth, 20'000, 5);
  EXPECT_GT(fit_shape(samples, kTitle, {.breakpoints = 2}).held_out->refuted, .5);
  EXPECT_LE(fit_shape(samples, kTitle).held_out->refuted, .1);
}

RC_GTEST_PROP(ShapeFittingLaws, ShapesAreMonotoneWhateverTheSamples, ()) {
  const auto xs = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-20, 20)));
  Samples samples;
  for (const int x : xs) samples.push_back({.x = x / 3.0, .label = *rc::gen::arbitrary<bool>()});
  const FitParams params{.breakpoints = *rc::gen::inRange(1, 9),
                         .min_samples = *rc::gen::inRange(1, 6),
                         .confidence = *rc::gen::element(.5, .9, .99)};
  const FittedShape fitted = fit_shape(samples, kTitle, params);
  const auto& points = fitted.shape.breakpoints();
  RC_ASSERT(points.size() <= static_cast<std::size_t>(params.breakpoints));
  const double sign = fitted.direction == Direction::kRising ? 1.0 : -1.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    RC_ASSERT(sign * (points[i].yes - points[i - 1].yes) >= 0.0);
    RC_ASSERT(sign * (points[i].no - points[i - 1].no) <= 0.0);
  }
  std::reverse(samples.begin(), samples.end());
  RC_ASSERT(fit_shape(samples, kTitle, params).shape == fitted.shape);
}

RC_GTEST_PROP(ShapeFittingLaws, OppositeLabelsSwapYesAndNo, ()) {
  Samples samples = drawn(rising_truth, *rc::gen::inRange<std::size_t>(1, 200), *rc::gen::arbitrary<unsigned>());
  const auto points = fit_shape(samples, kTitle, {.direction = Direction::kRising}).shape.breakpoints();
  for (LabelledSample& sample : samples) sample.label = !sample.label;
  const auto opposite = fit_shape(samples, kTitle, {.direction = Direction::kFalling}).shape.breakpoints();
  RC_ASSERT(points.size() == opposite.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    RC_ASSERT(points[i].x == opposite[i].x && points[i].yes == opposite[i].no && points[i].no == opposite[i].yes);
  }
}

TEST(ShapeFitting, OneSampleIsMostlyUnknownAndCannotBeJudged) {
  const FittedShape fitted = fit_shape(Samples{{2.0, true}}, kTitle);
  EXPECT_LT(distance(fitted.shape(2.0), {.025, 0.0, .975}), 1e-12);
  EXPECT_FALSE(fitted.held_out);
  EXPECT_EQ(fitted.samples, 1u);
}

TEST(ShapeFitting, EqualLabelsGiveAConstant) {
  const FittedShape fitted = fit_shape(drawn([](double) { return 1.0; }, 160, 1), kTitle);
  ASSERT_EQ(fitted.shape.breakpoints().size(), 2u);  // what lies within a constant stretch is left out
  const double bound = std::pow(.025, 1.0 / 160.0);
  EXPECT_LT(distance(fitted.shape(0.0), {bound, 0.0, 1.0 - bound}), 1e-12);
  EXPECT_EQ(fitted.held_out->coverage, 1.0);
  EXPECT_EQ(fitted.held_out->refuted, 0.0);
}

TEST(ShapeFitting, EqualQuantitiesStayTogether) {
  Samples samples(40, {1.0, false});
  samples.insert(samples.end(), 60, {2.0, true});
  samples[0].label = true;
  const FittedShape fitted = fit_shape(samples, kTitle);
  ASSERT_EQ(fitted.shape.breakpoints().size(), 2u);
  EXPECT_LT(distance(fitted.shape(1.0), predictive_belief(1, 40, .95)), 1e-15);
  EXPECT_LT(distance(fitted.shape(2.0), predictive_belief(60, 60, .95)), 1e-15);
  EXPECT_EQ(fit_shape(Samples(30, {1.0, true}), kTitle).shape.breakpoints().size(), 1u);
}

TEST(ShapeFitting, WhatWasNotMeasuredIsCountedAndIgnored) {
  Samples samples = drawn(rising_truth, 100, 3);
  const PiecewiseBelief without = fit_shape(samples, kTitle).shape;
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    samples.insert(samples.begin(), {x, true});
  }
  const FittedShape fitted = fit_shape(samples, kTitle);
  EXPECT_EQ(fitted.shape, without);
  EXPECT_EQ(fitted.samples, 100u);
  EXPECT_EQ(fitted.ignored, 2u);
  EXPECT_EQ(calibration_of(without, samples).ignored, 2u);
}

TEST(ShapeFitting, RefusesWhatCannotBeFitted) {
  EXPECT_THAT([] { static_cast<void>(fit_shape({}, kTitle)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("found none of 0 with a finite x")));
  const Samples unmeasured(3, {std::numeric_limits<double>::quiet_NaN(), true});
  EXPECT_THAT([&] { static_cast<void>(fit_shape(unmeasured, kTitle)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("found none of 3 with a finite x")));
  const Samples one{{0.0, true}};
  EXPECT_THAT([&] { static_cast<void>(fit_shape(one, kTitle, {.breakpoints = 0})); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("breakpoints: found 0")));
  EXPECT_THAT([&] { static_cast<void>(fit_shape(one, kTitle, {.min_samples = -1})); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("min_samples: found -1")));
  EXPECT_THAT([&] { static_cast<void>(fit_shape(one, kTitle, {.confidence = 1.0})); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("confidence: found 1")));
  EXPECT_THROW(static_cast<void>(fit_shape(one, {.name = "", .quantity = "q", .unit = "1"})), std::invalid_argument);
  const PiecewiseBelief shape = fit_shape(one, kTitle).shape;
  EXPECT_THROW(static_cast<void>(calibration_of(shape, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(calibration_of(shape, one, 0)), std::invalid_argument);
}

/// Two bins of ten: x = 0 with `low` true labels, x = 1 with `high`.
Samples two_bins(std::size_t low, std::size_t high) {
  Samples samples;
  for (std::size_t i = 0; i < 10; ++i) samples.push_back({0.0, i < low});
  for (std::size_t i = 0; i < 10; ++i) samples.push_back({1.0, i < high});
  return samples;
}

TEST(Calibration, IsAsCountedByHand) {
  const PiecewiseBelief shape(kTitle, {{"low", 0.0, .1, .7}, {"high", 1.0, .6, .2}});
  const Calibration judged = calibration_of(shape, two_bins(2, 9));
  EXPECT_EQ(judged.samples, 20u);
  EXPECT_EQ(judged.bins, 2u);
  EXPECT_EQ(judged.coverage, .5);  // .2 in [.1, .3]; .9 not in [.6, .8]
  EXPECT_EQ(judged.refuted, 0.0);  // ten samples of .9 may come from .8
  EXPECT_NEAR(judged.calibration_error, (std::abs(.2 - .2) + std::abs(.7 - .9)) / 2, 1e-12);
  EXPECT_NEAR(judged.brier_score, (2 * .64 + 8 * .04 + 9 * .09 + 1 * .49) / 20, 1e-12);
  EXPECT_NEAR(judged.mean_unknown, .2, 1e-12);
}

TEST(Calibration, BoundsBelongToTheInterval) {
  const PiecewiseBelief shape(kTitle, {{"low", 0.0, .3, .7}, {"high", 1.0, .8, .1}});
  EXPECT_EQ(calibration_of(shape, two_bins(3, 8)).coverage, 1.0);
  EXPECT_EQ(calibration_of(shape, two_bins(3, 9)).coverage, 1.0);
}

TEST(Calibration, RefutedIsWhatNoScatterExplains) {
  const PiecewiseBelief shape(kTitle, {{"low", 0.0, 0.0, .8}, {"high", 1.0, .8, 0.0}});
  const Calibration judged = calibration_of(shape, two_bins(8, 8));
  EXPECT_EQ(judged.coverage, .5);
  EXPECT_EQ(judged.refuted, .5);
}

TEST(Calibration, TheTrueProbabilityIsRefutedByChanceOnly) {
  double refuted = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const PiecewiseBelief truth(kTitle, {{"always", 0.0, .3, .7}});
    refuted += calibration_of(truth, drawn(flat_truth, 1000, seed)).refuted / 40;
  }
  EXPECT_GT(refuted, 0.0);
  EXPECT_LT(refuted, .06);
}

}  // namespace
}  // namespace credo::evidence
