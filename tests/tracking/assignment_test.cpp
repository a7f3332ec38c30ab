// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/assignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

namespace credo::tracking {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

// Largest sum over all assignments, by enumeration.
double best_by_enumeration(int row, int rows, const std::vector<Candidate>& candidates, std::vector<char>& used) {
  if (row == rows) return 0.0;
  double best = best_by_enumeration(row + 1, rows, candidates, used);
  for (const Candidate& c : candidates) {
    if (c.row != row || used[c.column]) continue;
    used[c.column] = 1;
    best = std::max(best, c.weight + best_by_enumeration(row + 1, rows, candidates, used));
    used[c.column] = 0;
  }
  return best;
}

double sum_of(const std::vector<int>& columns, const std::vector<Candidate>& candidates) {
  double sum = 0.0;
  for (const Candidate& c : candidates) {
    if (columns[c.row] == c.column) sum += c.weight;
  }
  return sum;
}

bool columns_are_unique(std::vector<int> columns) {
  std::erase(columns, -1);
  std::ranges::sort(columns);
  return std::ranges::adjacent_find(columns) == columns.end();
}

std::vector<Candidate> random_problem(std::mt19937& random, int rows, int columns, double density) {
  std::uniform_real_distribution<double> weight(-1.0, 3.0), share(0.0, 1.0);
  std::vector<Candidate> candidates;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (share(random) < density) candidates.push_back({row, column, weight(random)});
    }
  }
  return candidates;
}

TEST(Assignment, GivesEveryRowItsBestColumnWhereNothingCollides) {
  Assigner assigner;
  EXPECT_THAT(assigner.assign(2, 3, std::vector<Candidate>{{0, 0, 1.0}, {0, 2, 2.0}, {1, 0, 0.5}}), ElementsAre(2, 0));
}

TEST(Assignment, GivesAContestedColumnToTheHeavierRow) {
  Assigner assigner;
  EXPECT_THAT(assigner.assign(3, 1, std::vector<Candidate>{{0, 0, 1.0}, {1, 0, 2.0}, {2, 0, 1.5}}),
              ElementsAre(-1, 0, -1));
}

TEST(Assignment, GivesAContestedColumnToTheFirstOfEqualRows) {
  Assigner assigner;
  EXPECT_THAT(assigner.assign(2, 1, std::vector<Candidate>{{1, 0, 1.0}, {0, 0, 1.0}}), ElementsAre(0, -1));
}

TEST(Assignment, MakesARowYieldWhereTheSumGrows) {
  Assigner assigner;  // both want column 0; row 0 loses little by taking 1
  EXPECT_THAT(assigner.assign(2, 2, std::vector<Candidate>{{0, 0, 2.0}, {0, 1, 1.8}, {1, 0, 1.9}, {1, 1, 0.1}}),
              ElementsAre(1, 0));
}

TEST(Assignment, LeavesARowAloneRatherThanTakingALightPair) {
  Assigner assigner;
  EXPECT_THAT(assigner.assign(2, 2, std::vector<Candidate>{{0, 0, 2.0}, {1, 0, 1.0}, {1, 1, -0.5}}),
              ElementsAre(0, -1));
}

TEST(Assignment, OfNothingIsNothing) {
  Assigner assigner;
  EXPECT_TRUE(assigner.assign(0, 0, {}).empty());
  EXPECT_THAT(assigner.assign(3, 0, {}), Each(-1));
  EXPECT_THAT(assigner.assign(2, 2, std::vector<Candidate>{{0, 0, 0.0}, {1, 1, -1.0}}), Each(-1));
}

TEST(Assignment, ForgetsTheProblemBefore) {
  Assigner assigner;
  (void)assigner.assign(5, 5, std::vector<Candidate>{{4, 4, 1.0}, {3, 4, 2.0}});
  EXPECT_THAT(assigner.assign(1, 1, std::vector<Candidate>{{0, 0, 1.0}}), ElementsAre(0));
}

RC_GTEST_PROP(Assignment, IsTheBestOfAll, (unsigned seed)) {
  std::mt19937 random(seed);
  const int rows = std::uniform_int_distribution<int>(1, 6)(random),
            columns = std::uniform_int_distribution<int>(1, 6)(random);
  const auto candidates =
      random_problem(random, rows, columns, std::uniform_real_distribution<double>(0.2, 1.0)(random));
  Assigner assigner;
  const std::vector<int> found = assigner.assign(rows, columns, candidates);
  std::vector<char> used(columns, 0);
  RC_ASSERT(columns_are_unique(found));
  RC_ASSERT(std::abs(sum_of(found, candidates) - best_by_enumeration(0, rows, candidates, used)) < 1e-7);
}

RC_GTEST_PROP(Assignment, DoesNotDependOnTheOrderOfTheCandidates, (unsigned seed)) {
  std::mt19937 random(seed);
  auto candidates = random_problem(random, 6, 6, 0.5);
  Assigner assigner;
  const std::vector<int> found = assigner.assign(6, 6, candidates);
  std::ranges::shuffle(candidates, random);
  RC_ASSERT(assigner.assign(6, 6, candidates) == found);
}

RC_GTEST_PROP(Assignment, AgreesWithTheFlowOverTheWholeProblem, (unsigned seed)) {
  std::mt19937 random(seed);
  auto candidates = random_problem(random, 15, 12, 0.3);
  Assigner assigner;
  const std::vector<int> found = assigner.assign(15, 12, candidates);
  std::erase_if(candidates, [](const Candidate& c) { return c.weight <= 0.0; });
  std::vector<int> by_flow(15, -1);
  assign_by_min_cost_flow(candidates, by_flow);
  RC_ASSERT(columns_are_unique(by_flow));
  RC_ASSERT(std::abs(sum_of(found, candidates) - sum_of(by_flow, candidates)) < 1e-7);
}

}  // namespace
}  // namespace credo::tracking
