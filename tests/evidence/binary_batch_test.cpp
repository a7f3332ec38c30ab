// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evidence/binary_rules.hpp"
#include "tests/evidence/random_masses.hpp"
#include "tests/support/counted_new.hpp"

namespace credo::evidence {
namespace {

template <typename Real>
struct Arrays {
  std::vector<Real> yes, no, unknown, conflict;

  explicit Arrays(const std::vector<BinaryMass>& masses) : conflict(masses.size()) {
    for (const BinaryMass& mass : masses) {
      yes.push_back(static_cast<Real>(mass.yes));
      no.push_back(static_cast<Real>(mass.no));
      unknown.push_back(static_cast<Real>(mass.unknown));
    }
  }
  BinaryCells<Real> cells() { return {yes, no, unknown}; }
  OpenBinaryMass operator[](std::size_t i) const { return {yes[i], no[i], unknown[i], conflict[i]}; }
};

OpenBinaryMass normal(const BinaryMass& mass) { return {mass.yes, mass.no, mass.unknown, 0.0}; }

double distance(const OpenBinaryMass& a, const OpenBinaryMass& b) {
  return std::max({std::abs(a.yes - b.yes), std::abs(a.no - b.no), std::abs(a.unknown - b.unknown),
                   std::abs(a.conflict - b.conflict)});
}

// A rule on arrays, and what it is to do to each cell.
template <typename Real>
struct Rule {
  const char* name;
  void (*batch)(Arrays<Real>& map, Arrays<Real>& reading);
  OpenBinaryMass (*scalar)(const BinaryMass& map, const BinaryMass& reading);
};

template <typename Real>
std::vector<Rule<Real>> rules() {
  using A = Arrays<Real>;
  using M = const BinaryMass&;
  return {{"conjunctive", [](A& map, A& reading) { conjunctive(map.cells(), reading.cells(), map.conflict); },
           [](M a, M b) {
             return conjunctive({a, b});
           }},
          {"dempster", [](A& map, A& reading) { (void)dempster(map.cells(), reading.cells()); },
           [](M a, M b) {
             const auto fused = dempster({a, b});
             return normal(fused ? fused->mass : a);
           }},
          {"yager", [](A& map, A& reading) { conflict_to_ignorance(map.cells(), reading.cells()); },
           [](M a, M b) {
             return normal(conflict_to_ignorance({a, b}).mass);
           }},
          {"disjunctive", [](A& map, A& reading) { disjunctive(map.cells(), reading.cells()); },
           [](M a, M b) {
             return normal(disjunctive({a, b}));
           }},
          {"pcr2", [](A& map, A& reading) { pcr2(map.cells(), reading.cells()); },
           [](M a, M b) {
             return normal(pcr2({a, b}).mass);
           }},
          {"pcr5", [](A& map, A& reading) { pcr5(map.cells(), reading.cells()); },
           [](M a, M b) {
             return normal(pcr5({a, b}).mass);
           }},
          {"cautious", [](A& map, A& reading) { (void)cautious(map.cells(), reading.cells(), map.conflict); },
           [](M a, M b) {
             return a.unknown == 0.0 || b.unknown == 0.0 ? normal(a) : cautious({a, b});
           }},
          {"average", [](A& map, A& reading) { average(map.cells(), reading.cells()); },
           [](M a, M b) {
             return normal(average({a, b}));
           }},
          {"discount", [](A& map, A&) { discount(map.cells(), Real(0.75)); },
           [](M a, M) { return normal(discount(a, .75)); }}};
}

template <typename Real>
void agrees_with_the_closed_forms(std::vector<BinaryMass> map, std::vector<BinaryMass> readings, double tolerance) {
  map.resize(std::min(map.size(), readings.size()));
  readings.resize(map.size());
  for (const Rule<Real>& rule : rules<Real>()) {
    Arrays<Real> result(map), reading(readings);
    rule.batch(result, reading);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const double error = distance(result[i], rule.scalar(map[i], readings[i]));
      RC_ASSERT_FALSE(error > tolerance && (RC_LOG() << rule.name << ' ' << map[i] << ' ' << readings[i], true));
      RC_ASSERT(error == error);
    }
  }
}

RC_GTEST_PROP(BinaryBatchLaws, EveryCellIsThatOfTheClosedFormToTheBit,
              (const std::vector<BinaryMass>& map, const std::vector<BinaryMass>& readings)) {
  agrees_with_the_closed_forms<double>(map, readings, 0.0);
}

RC_GTEST_PROP(BinaryBatchLaws, FloatIsTheSameInFewerDigits,
              (const std::vector<BinaryMass>& map, const std::vector<BinaryMass>& readings)) {
  agrees_with_the_closed_forms<float>(map, readings, 1e-6);
}

TEST(BinaryBatch, ConflictAddsUpOverTheReadings) {
  const std::vector<BinaryMass> readings{{.5, .25, .25}, {.25, .5, .25}, {.125, .125, .75}};
  Arrays<double> map({BinaryMass::vacuous()});
  for (const BinaryMass& reading : readings) conjunctive(map.cells(), Arrays<double>({reading}).cells(), map.conflict);
  EXPECT_EQ(distance(map[0], conjunctive(readings)), 0.0);
}

TEST(BinaryBatch, AtTotalConflictACellKeepsItsMassAndIsCounted) {
  const std::vector<BinaryMass> before{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {.5, .25, .25}, {1.0, 0.0, 0.0}};
  Arrays<float> map(before), reading({{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {.5, .5, 0.0}});
  EXPECT_EQ(dempster(map.cells(), reading.cells()), 2u);
  EXPECT_EQ(distance(map[0], normal(before[0])), 0.0);
  EXPECT_EQ(distance(map[1], normal(before[1])), 0.0);
  EXPECT_EQ(distance(map[2], {0.0, 1.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(distance(map[3], {1.0, 0.0, 0.0, 0.0}), 0.0);
}

TEST(BinaryBatch, DogmaticCellsHaveNoCautiousRuleAndAreCounted) {
  const std::vector<BinaryMass> before{{.5, .5, 0.0}, {.5, .25, .25}, {.5, .25, .25}};
  Arrays<double> map(before), reading({{.2, .2, .6}, {1.0, 0.0, 0.0}, {.5, .25, .25}});
  EXPECT_EQ(cautious(map.cells(), reading.cells(), map.conflict), 2u);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT(distance(map[i], normal(before[i])), 1e-15) << i;
}

TEST(BinaryBatch, AllocatesNothing) {
  const std::vector<BinaryMass> masses(1000, {.5, .25, .25});
  Arrays<float> map(masses), reading(masses);
  const int before = credo::testing::allocations();
  for (const Rule<float>& rule : rules<float>()) rule.batch(map, reading);
  const int by_the_list = 1;
  EXPECT_EQ(credo::testing::allocations() - before, by_the_list);
}

TEST(BinaryBatch, RefusesArraysOfDifferentSizesAndOtherReliabilities) {
  Arrays<double> map({{.5, .25, .25}, {.5, .25, .25}}), longer({{.5, .25, .25}, {.5, .25, .25}, {.5, .25, .25}});
  std::vector<double> conflict(3);
  EXPECT_THROW(pcr5(map.cells(), longer.cells()), std::invalid_argument);
  EXPECT_THROW(conjunctive(map.cells(), map.cells(), conflict), std::invalid_argument);
  EXPECT_THROW(average(BinaryCells<double>{map.yes, longer.no, map.unknown}, map.cells()), std::invalid_argument);
  EXPECT_THROW(discount(map.cells(), 1.5), std::invalid_argument);
  try {
    pcr2(map.cells(), longer.cells());
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("2 and 3"));
  }
  EXPECT_EQ(map.yes[0], .5);
}

TEST(BinaryBatch, NoCellsAreNothingToDo) {
  Arrays<float> nothing({});
  EXPECT_EQ(dempster(nothing.cells(), nothing.cells()), 0u);
}

}  // namespace
}  // namespace credo::evidence
