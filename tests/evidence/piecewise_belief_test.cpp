// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/piecewise_belief.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const ShapeTitle kTitle{.name = "alignment", .quantity = "mean residual", .unit = "standard deviations"};
const std::string kText =
    "shape alignment\n"
    "quantity mean residual\n"
    "unit standard deviations\n"
    "at 1 yes 0.9 no 0 good until\n"
    "at 2 yes 0.1 no 0.2 doubtful\n"
    "at 4 yes 0 no 0.8 bad from\n";

PiecewiseBelief alignment() {
  return {kTitle, {{"good until", 1.0, .9, 0.0}, {"doubtful", 2.0, .1, .2}, {"bad from", 4.0, 0.0, .8}}};
}

void expect_refused(const std::function<void()>& make, const std::string& found, const std::string& expected) {
  EXPECT_THAT(make, ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(found), HasSubstr("expected " + expected))));
}

TEST(PiecewiseBelief, IsLinearBetweenBreakpointsAndConstantOutside) {
  const PiecewiseBelief shape = alignment();
  EXPECT_LT(distance(shape(-7.0), {.9, 0.0, .1}), 1e-15);
  EXPECT_LT(distance(shape(1.0), {.9, 0.0, .1}), 1e-15);
  EXPECT_LT(distance(shape(1.5), {.5, .1, .4}), 1e-15);
  EXPECT_LT(distance(shape(2.0), {.1, .2, .7}), 1e-15);
  EXPECT_LT(distance(shape(3.5), {.025, .65, .325}), 1e-15);
  EXPECT_LT(distance(shape(4.0), {0.0, .8, .2}), 1e-15);
  EXPECT_LT(distance(shape(kInfinity), {0.0, .8, .2}), 1e-15);
  EXPECT_LT(distance(shape(-kInfinity), {.9, 0.0, .1}), 1e-15);
}

TEST(PiecewiseBelief, WhatCouldNotBeMeasuredSaysNothing) { EXPECT_EQ(alignment()(kNan), BinaryMass::vacuous()); }

TEST(PiecewiseBelief, OneBreakpointIsAConstant) {
  const PiecewiseBelief shape(kTitle, {{"always", 3.0, .2, .3}});
  for (const double x : {-kInfinity, 0.0, 3.0, 9.0}) EXPECT_LT(distance(shape(x), {.2, .3, .5}), 1e-15);
}

TEST(PiecewiseBelief, NeighbouringDoublesAndHugeRangesStayMasses) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const PiecewiseBelief step(kTitle, {{"until", 0.0, 1.0, 0.0}, {"from", tiny, 0.0, 1.0}});
  EXPECT_EQ(step(0.0), (BinaryMass{1.0, 0.0, 0.0}));
  EXPECT_EQ(step(tiny), (BinaryMass{0.0, 1.0, 0.0}));
  const PiecewiseBelief wide(kTitle, {{"low", -8e307, 1.0, 0.0}, {"high", 8e307, 0.0, 1.0}});
  EXPECT_LT(distance(wide(0.0), {.5, .5, 0.0}), 1e-15);
}

TEST(PiecewiseBelief, RefusesWhatIsNoShape) {
  const auto with = [](std::vector<Breakpoint> points) { return [points] { PiecewiseBelief(kTitle, points); }; };
  const auto titled = [](ShapeTitle title) { return [title] { PiecewiseBelief(title, {{"a", 0.0, .5, .5}}); }; };
  expect_refused(with({}), "shape 'alignment': found no breakpoint", "at least one");
  expect_refused(with({{"a", kNan, 0, 0}}), "breakpoint 'a': found x = nan", "a finite number");
  expect_refused(with({{"a", kInfinity, 0, 0}}), "found x = inf", "a finite number");
  expect_refused(with({{"a", 1, 0, 0}, {"b", 1, 0, 0}}), "breakpoint 'b': found x = 1 after 1", "a larger x");
  expect_refused(with({{"a", 0, -.1, 0}}), "found yes -0.1, no 0", "both >= 0 and their sum <= 1");
  expect_refused(with({{"a", 0, .6, .5}}), "found yes 0.6, no 0.5", "both >= 0 and their sum <= 1");
  expect_refused(with({{"a", 0, 0, kNan}}), "found yes 0, no nan", "both >= 0 and their sum <= 1");
  expect_refused(with({{"a", 0, 0, 0}, {"a", 1, 0, 0}}), "its name a second time", "another name");
  expect_refused(with({{"", 0, 0, 0}}), "name of a breakpoint: found ''", "one line of text");
  expect_refused(with({{"a", -1e308, 0, 0}, {"b", 1e308, 0, 0}}), "x = 1e+308", "a range of x");
  expect_refused(titled({"two\nlines", "q", "1"}), "name of a shape", "one line of text");
  expect_refused(titled({"n", " q", "1"}), "quantity of a shape: found ' q'", "one line of text");
  expect_refused(titled({"n", "q", ""}), "unit of a shape: found ''", "one line of text");
}

TEST(PiecewiseBelief, ASumThatRoundingHasLiftedOverOneIsCutOff) {
  const PiecewiseBelief shape(kTitle, {{"a", 0.0, .5, .5 + 1e-10}, {"b", 1.0, 1.0 + 1e-10, 0.0}});
  for (const double x : {0.0, .3, 1.0}) {
    EXPECT_NEAR(total(shape(x)), 1.0, 1e-15);
    EXPECT_GE(std::min({shape(x).yes, shape(x).no, shape(x).unknown}), 0.0);
  }
  EXPECT_EQ(read_piecewise_belief(to_text(shape)), shape);
}

TEST(PiecewiseBeliefText, IsWrittenAsItIsRead) {
  EXPECT_EQ(to_text(alignment()), kText);
  EXPECT_EQ(read_piecewise_belief(kText), alignment());
}

TEST(PiecewiseBeliefText, MayHaveCommentsBlankLinesAndOtherLineEnds) {
  const std::string loose =
      "# fitted by hand\r\n\r\nshape  alignment\r\n quantity mean residual\r\nunit standard deviations\r\n"
      "at  1 yes 0.9 no  0.0 good until\r\n  # between\r\nat 2 yes .1 no 2e-1 doubtful\r\nat 4 yes 0 no 0.8 bad from";
  EXPECT_EQ(read_piecewise_belief(loose), alignment());
}

TEST(PiecewiseBeliefText, NamesTheLineThatIsWrong) {
  const auto reading = [](const std::string& from, const std::string& to) {
    std::string text = kText;
    text.replace(text.find(from), from.size(), to);
    return [text] { static_cast<void>(read_piecewise_belief(text)); };
  };
  const std::string point = "'at NUMBER yes NUMBER no NUMBER NAME'";
  expect_refused(reading("shape", "form"), "line 1: a shape: found 'form alignment'", "'shape TEXT'");
  expect_refused(reading("unit standard deviations", "unit"), "line 3: a shape: found 'unit'", "'unit TEXT'");
  expect_refused(reading("mean residual", "mean\tresidual"), "line 2: a title: found 'mean", "one line of text");
  expect_refused(reading("0.9", "0,9"), "line 4: a shape: found 'at 1 yes 0,9 no 0 good until'", point);
  expect_refused(reading(" doubtful", ""), "line 5: a shape: found 'at 2 yes 0.1 no 0.2'", point);
  expect_refused(reading("at 4", "at 2"), "line 6: breakpoint 'bad from': found x = 2 after 2", "a larger x");
  expect_refused(reading("0.8", "1.8"), "line 6: breakpoint 'bad from': found yes 0, no 1.8", "both >= 0");
  expect_refused(reading("at 4", "at nan"), "line 6: breakpoint 'bad from': found x = nan", "a finite number");
  expect_refused(reading(kText, ""), "line 1: a shape: found the end of the text", "'shape TEXT'");
  expect_refused(reading(kText.substr(kText.find("at 1")), ""), "line 4: a shape: found the end of the text", point);
}

/// Numbers of any size, shares of integers as masses; x of distinct integers scaled at random.
PiecewiseBelief random_shape() {
  const auto xs = *rc::gen::nonEmpty(rc::gen::arbitrary<std::set<int>>());
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-900, 900)) / 3.0;
  std::vector<Breakpoint> points;
  for (const int x : xs) {
    const auto mass = *rc::gen::arbitrary<BinaryMass>();
    points.push_back({"p  " + std::to_string(x), x * scale, mass.yes, mass.no});
  }
  return {kTitle, points};
}

RC_GTEST_PROP(PiecewiseBeliefLaws, TextReadBackIsTheSameShape, ()) {
  const PiecewiseBelief shape = random_shape();
  RC_ASSERT(read_piecewise_belief(to_text(shape)) == shape);
}

RC_GTEST_PROP(PiecewiseBeliefLaws, EveryQuantityGivesAMassBetweenItsNeighbours, (double share)) {
  const PiecewiseBelief shape = random_shape();
  const auto& points = shape.breakpoints();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double part = std::abs(share) - std::floor(std::abs(share));
    const BinaryMass mass = shape(std::lerp(points[i].x, points[i + 1].x, part));
    RC_ASSERT(std::abs(total(mass) - 1.0) < 1e-15);
    RC_ASSERT(mass.unknown >= 0.0);
    RC_ASSERT(mass.yes >= std::min(points[i].yes, points[i + 1].yes) - 1e-15);
    RC_ASSERT(mass.yes <= std::max(points[i].yes, points[i + 1].yes) + 1e-15);
    RC_ASSERT(mass.no >= std::min(points[i].no, points[i + 1].no) - 1e-15);
    RC_ASSERT(mass.no <= std::max(points[i].no, points[i + 1].no) + 1e-15);
  }
}

RC_GTEST_PROP(PiecewiseBeliefLaws, RampsConvertToTheSameFunction, ()) {
  const auto number =
      rc::gen::map(rc::gen::inRange(-6, 7), [](int i) { return i / 3.0; });  // so that many fall together
  RampBelief ramp{.max_yes = *rc::gen::inRange(0, 11) / 10.0,
                  .yes_full_until = *number,
                  .yes_zero_from = *number,
                  .max_no = 0.0,
                  .no_zero_until = *number,
                  .no_full_from = *number};
  ramp.max_no = *rc::gen::inRange(0, 11) / 10.0;
  const auto shape = [&]() -> std::optional<PiecewiseBelief> {
    try {
      return piecewise(ramp, kTitle);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }();
  RC_PRE(shape.has_value());
  for (int i = -300; i <= 300; ++i) RC_ASSERT(distance((*shape)(i / 120.0), ramp(i / 120.0)) < 1e-12);
  for (const Breakpoint& point : shape->breakpoints()) RC_ASSERT(distance((*shape)(point.x), ramp(point.x)) < 1e-15);
}

TEST(PiecewiseBelief, BreakpointsOfRampsKeepTheirNames) {
  const PiecewiseBelief shape = piecewise(
      {.max_yes = .9, .yes_full_until = 0, .yes_zero_from = 10, .max_no = .8, .no_zero_until = 10, .no_full_from = 10},
      kTitle);
  ASSERT_EQ(shape.breakpoints().size(), 3u);
  EXPECT_EQ(shape.breakpoints()[1].name, "yes_zero_from = no_zero_until");
  EXPECT_EQ(shape.breakpoints()[2].x, std::nextafter(10.0, 11.0));
  EXPECT_THAT([] { static_cast<void>(piecewise({.max_yes = 2.0}, kTitle)); },
              ThrowsMessage<std::invalid_argument>(StartsWith("alignment.max_yes: found 2")));
}

}  // namespace
}  // namespace credo::evidence
