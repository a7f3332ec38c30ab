// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/plausible_relation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using ::testing::ElementsAre;

double log_plausibility(std::span<const BinaryMass> evidence, std::size_t columns, const std::vector<int>& relation) {
  double sum = 0.0;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const bool is_in = relation[i / columns] == static_cast<int>(i % columns);
    sum += std::log((is_in ? evidence[i].yes : evidence[i].no) + evidence[i].unknown);
  }
  return sum;
}

// Every relation there is.
double best_by_enumeration(std::span<const BinaryMass> evidence, std::size_t rows, std::size_t columns,
                           std::vector<int> relation = {}) {
  if (relation.size() == rows) return log_plausibility(evidence, columns, relation);
  double best = -HUGE_VAL;
  for (int column = -1; column < static_cast<int>(columns); ++column) {
    if (column >= 0 && std::ranges::count(relation, column) > 0) continue;
    std::vector<int> longer = relation;
    longer.push_back(column);
    best = std::max(best, best_by_enumeration(evidence, rows, columns, longer));
  }
  return best;
}

RC_GTEST_PROP(PlausibleRelationLaws, NoRelationIsMorePlausible, ()) {
  const auto rows = *rc::gen::resize(100, rc::gen::inRange<std::size_t>(1, 5));
  const auto columns = *rc::gen::resize(100, rc::gen::inRange<std::size_t>(1, 5));
  const auto evidence = *rc::gen::container<std::vector<BinaryMass>>(rows * columns, rc::gen::arbitrary<BinaryMass>());
  const std::optional<Relation> found = most_plausible_relation(evidence, rows, columns);
  const double best = best_by_enumeration(evidence, rows, columns);
  RC_ASSERT(found.has_value() == (best > -HUGE_VAL));
  if (!found) return;
  RC_ASSERT(std::abs(found->log_plausibility - best) < 1e-9);
  RC_ASSERT(std::abs(log_plausibility(evidence, columns, found->column_of_row) - best) < 1e-9);
  for (const int column : found->column_of_row) {
    RC_ASSERT(column < 0 || std::ranges::count(found->column_of_row, column) == 1);
  }
}

TEST(PlausibleRelation, RowsThatWantTheSameColumnAreSettledTogether) {
  const BinaryMass strong{.yes = 0.8, .no = 0.0, .unknown = 0.2}, weak{.yes = 0.6, .no = 0.1, .unknown = 0.3},
      none{.yes = 0.0, .no = 0.9, .unknown = 0.1};
  const BinaryMass evidence[] = {strong, weak,   //
                                 strong, none};  // row by row, both would take column 0
  EXPECT_THAT(most_plausible_relation(evidence, 2, 2)->column_of_row, ElementsAre(1, 0));
}

TEST(PlausibleRelation, WhatSpeaksAgainstIsLeftAlone) {
  const BinaryMass against{.yes = 0.1, .no = 0.6, .unknown = 0.3};
  EXPECT_THAT(most_plausible_relation(std::span(&against, 1), 1, 1)->column_of_row, ElementsAre(-1));
  EXPECT_THAT(most_plausible_relation({}, 2, 0)->column_of_row, ElementsAre(-1, -1));
  EXPECT_THAT(most_plausible_relation({}, 0, 2)->column_of_row, ElementsAre());
}

TEST(PlausibleRelation, TwoThatAreCertainOfOneAreInTotalConflict) {
  const BinaryMass certain{.yes = 1.0, .no = 0.0, .unknown = 0.0};
  EXPECT_EQ(most_plausible_relation(std::vector{certain, certain}, 2, 1), std::nullopt);
  EXPECT_THAT(most_plausible_relation(std::vector{certain}, 1, 1)->column_of_row, ElementsAre(0));
}

TEST(PlausibleRelation, AnotherSizeIsRefused) {
  EXPECT_THROW(static_cast<void>(most_plausible_relation(std::vector<BinaryMass>(3), 2, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evidence
