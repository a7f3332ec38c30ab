// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/open_world.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <numeric>

#include "tests/evidence/random_masses.hpp"
#include "tests/support/counted_new.hpp"

namespace credo::evidence {
namespace {

using Candidates = std::vector<BinaryMass>;

Candidates at_most(Candidates candidates, std::size_t count) {
  if (candidates.size() > count) candidates.resize(count);
  return candidates;
}

// The combination as it is defined: all tuples of focal elements on the frame {P_1 .. P_p, *}, nothing condensed.
struct Enumerated {
  std::vector<double> match, plausibility, pignistic;  // the last entry is that of *
  double unknown = 0.0;
  double conflict = 0.0;
};

Enumerated enumerate(const Candidates& candidates) {
  const std::size_t count = candidates.size();
  const unsigned frame = (1u << (count + 1)) - 1u;
  Enumerated result;
  for (auto* values : {&result.match, &result.plausibility, &result.pignistic}) values->assign(count + 1, 0.0);
  const auto visit = [&](auto&& self, std::size_t i, unsigned element, double product) -> void {
    if (i < count) {
      self(self, i + 1, element & (1u << i), product * candidates[i].yes);
      self(self, i + 1, element & ~(1u << i), product * candidates[i].no);
      self(self, i + 1, element, product * candidates[i].unknown);
      return;
    }
    const int size = std::popcount(element);
    if (size == 0) result.conflict += product;
    if (size > 1) result.unknown += product;
    for (std::size_t k = 0; k <= count; ++k) {
      if ((element >> k & 1u) == 0) continue;
      result.plausibility[k] += product;
      result.pignistic[k] += product / size;
      if (size == 1) result.match[k] += product;
    }
  };
  visit(visit, 0, frame, 1.0);
  return result;
}

void expect_near(double value, double expected, double tolerance = 1e-14) {
  RC_ASSERT(std::abs(value - expected) <= tolerance);
}

RC_GTEST_PROP(OpenWorldLaws, CondensedMassesAreWhatEnumerationGives, (Candidates candidates)) {
  candidates = at_most(candidates, 6);
  const Enumerated expected = enumerate(candidates);
  OpenWorldMatcher matcher;
  matcher.combine(candidates);
  const OpenWorldMasses& open = matcher.open();
  RC_ASSERT(open.match.size() == candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) expect_near(open.match[i], expected.match[i]);
  expect_near(open.none, expected.match.back());
  // Without candidates the whole frame is {*}.
  expect_near(open.unknown, expected.unknown);
  expect_near(open.conflict, expected.conflict);
}

RC_GTEST_PROP(OpenWorldLaws, PlausibilityAndPignisticAreExact, (Candidates candidates)) {
  candidates = at_most(candidates, 6);
  const Enumerated expected = enumerate(candidates);
  OpenWorldMatcher matcher;
  matcher.combine(candidates);
  const double kept = std::accumulate(expected.match.begin(), expected.match.end(), expected.unknown);
  RC_PRE(kept > 0.0);
  const OpenWorldValues& plausibility = matcher.plausibility();
  const OpenWorldValues& pignistic = matcher.pignistic();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    expect_near(plausibility.match[i], expected.plausibility[i] / kept, 1e-13);
    expect_near(pignistic.match[i], expected.pignistic[i] / kept, 1e-13);
  }
  expect_near(plausibility.none, expected.plausibility.back() / kept, 1e-13);
  expect_near(pignistic.none, expected.pignistic.back() / kept, 1e-13);
}

RC_GTEST_PROP(OpenWorldLaws, ResultsAreMassesForAnyNumberOfCandidates, (const Candidates& candidates)) {
  OpenWorldMatcher matcher;
  matcher.combine(candidates);
  const OpenWorldMasses& open = matcher.open();
  const double matched = std::accumulate(open.match.begin(), open.match.end(), 0.0);
  expect_near(matched + open.none + open.unknown + open.conflict, 1.0, 1e-13);
  RC_ASSERT(open.unknown >= 0.0 && open.conflict >= 0.0);
  RC_PRE(!matcher.total_conflict());
  const OpenWorldMasses& normalised = matcher.normalised();
  const double sum = std::accumulate(normalised.match.begin(), normalised.match.end(), 0.0);
  expect_near(sum + normalised.none + normalised.unknown, 1.0, 1e-13);
  const OpenWorldValues& betp = matcher.pignistic();
  const OpenWorldValues& plausibility = matcher.plausibility();
  expect_near(std::accumulate(betp.match.begin(), betp.match.end(), betp.none), 1.0, 1e-13);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    RC_ASSERT(normalised.match[i] <= betp.match[i] + 1e-15);
    RC_ASSERT(betp.match[i] <= plausibility.match[i] + 1e-13);
  }
  RC_ASSERT(normalised.none <= betp.none + 1e-13 && betp.none <= plausibility.none + 1e-13);
}

// Row by row, plausibility and assignment weight are the same statement.
RC_GTEST_PROP(OpenWorldLaws, AssignmentWeightIsTheLogRatioOfPlausibilities, (const Candidates& candidates)) {
  OpenWorldMatcher matcher;
  matcher.combine(candidates);
  RC_PRE(!matcher.total_conflict());
  const OpenWorldValues& plausibility = matcher.plausibility();
  RC_PRE(plausibility.none > 0.0);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (plausibility.match[i] <= 0.0) continue;
    expect_near(assignment_weight(candidates[i]), std::log(plausibility.match[i] / plausibility.none), 1e-12);
  }
}

// Against the coefficients of the polynomials, integrated term by term in extended precision.
class ManyCandidates : public ::testing::TestWithParam<int> {};

TEST_P(ManyCandidates, HaveExactPignisticProbabilities) {
  const int count = GetParam();
  Candidates candidates;
  for (int i = 0; i < count; ++i) {
    const double match = .013 * (i % 7), no = .1 + .011 * (i % 13);
    candidates.push_back(BinaryMass::from(match, no));
  }
  const auto integral = [&](int left_out, int extra_degree) {
    std::vector<long double> coefficients{1.0L};
    for (int i = 0; i < count; ++i) {
      if (i == left_out) continue;
      coefficients.push_back(0.0L);
      for (std::size_t k = coefficients.size(); k-- > 0;) {
        coefficients[k] = coefficients[k] * static_cast<long double>(candidates[i].no) +
                          (k > 0 ? coefficients[k - 1] * static_cast<long double>(candidates[i].unknown) : 0.0L);
      }
    }
    long double sum = 0.0L;
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      sum += coefficients[k] / static_cast<long double>(k + 1 + static_cast<std::size_t>(extra_degree));
    }
    return sum;
  };
  OpenWorldMatcher matcher;
  matcher.combine(candidates);
  const double kept = 1.0 - matcher.open().conflict;
  const OpenWorldValues& betp = matcher.pignistic();
  EXPECT_NEAR(betp.none * kept / static_cast<double>(integral(-1, 0)), 1.0, 1e-12);
  for (int j = 0; j < count; ++j) {
    const double shared = candidates[j].unknown * static_cast<double>(integral(j, 1));
    EXPECT_NEAR(betp.match[j] * kept / (matcher.open().match[j] + shared), 1.0, 1e-12) << j;
  }
}

INSTANTIATE_TEST_SUITE_P(OpenWorld, ManyCandidates, ::testing::Values(60, 64, 130, 200));

TEST(OpenWorld, WithoutCandidatesThereIsNone) {
  OpenWorldMatcher matcher;
  matcher.combine({});
  EXPECT_EQ(matcher.open().none, 1.0);
  EXPECT_EQ(matcher.open().unknown, 0.0);
  EXPECT_EQ(matcher.plausibility().none, 1.0);
  EXPECT_NEAR(matcher.pignistic().none, 1.0, 1e-15);
  EXPECT_EQ(matcher.decide_by_mass().kind, MatchDecision::kNone);
  EXPECT_EQ(matcher.decide_by_pignistic().kind, MatchDecision::kNone);
  EXPECT_NEAR(matcher.decide_by_pignistic().margin, 1.0, 1e-15);
}

TEST(OpenWorld, OneCertainCandidateLeavesNothingToTheOthers) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{.8, .1, .1}, {1.0, 0.0, 0.0}, {0.0, .5, .5}});
  ASSERT_FALSE(matcher.total_conflict());
  EXPECT_NEAR(matcher.open().conflict, .8, 1e-15);
  EXPECT_NEAR(matcher.normalised().match[1], 1.0, 1e-15);
  EXPECT_EQ(matcher.normalised().match[0], 0.0);
  EXPECT_NEAR(matcher.pignistic().match[1], 1.0, 1e-15);
  EXPECT_EQ(matcher.plausibility().none, 0.0);
}

TEST(OpenWorld, TwoCertainCandidatesAreTotalConflict) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{1.0, 0.0, 0.0}, {0.2, .3, .5}, {1.0, 0.0, 0.0}});
  EXPECT_TRUE(matcher.total_conflict());
  EXPECT_NEAR(matcher.open().conflict, 1.0, 1e-15);
  EXPECT_EQ(matcher.decide_by_mass().kind, MatchDecision::kUndecided);
  EXPECT_EQ(matcher.decide_by_pignistic().kind, MatchDecision::kUndecided);
  matcher.combine(Candidates{{.6, .1, .3}});
  EXPECT_FALSE(matcher.total_conflict());
}

TEST(OpenWorld, BothDecisionsTakeAClearMatch) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{0.0, .9, .1}, {.8, 0.0, .2}, {0.0, .9, .1}});
  for (const OpenWorldDecision& decision : {matcher.decide_by_mass(), matcher.decide_by_pignistic()}) {
    EXPECT_EQ(decision.kind, MatchDecision::kMatched);
    EXPECT_EQ(decision.candidate, 1);
    EXPECT_GT(decision.value, .8 - 1e-12);
    EXPECT_GT(decision.margin, .5);
  }
}

// A lone candidate that is neither near nor far: by mass the lumped ignorance wins and the prediction is lost; by
// pignistic probability the ignorance does not compete.
TEST(OpenWorld, IgnoranceCompetesByMassOnly) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{.3, 0.0, .7}});
  EXPECT_EQ(matcher.decide_by_mass().kind, MatchDecision::kNone);
  const OpenWorldDecision decision = matcher.decide_by_pignistic();
  EXPECT_EQ(decision.kind, MatchDecision::kMatched);
  EXPECT_NEAR(decision.value, .65, 1e-15);
  EXPECT_NEAR(decision.margin, .3, 1e-15);
}

TEST(OpenWorld, TwoEqualCandidatesAreAmbiguous) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{.6, 0.0, .4}, {.6, 0.0, .4}});
  EXPECT_EQ(matcher.decide_by_pignistic().kind, MatchDecision::kUndecided);
  EXPECT_EQ(matcher.decide_by_pignistic().candidate, -1);
  EXPECT_EQ(matcher.decide_by_pignistic(0.0).kind, MatchDecision::kMatched);
  EXPECT_EQ(matcher.decide_by_pignistic(std::numeric_limits<double>::quiet_NaN()).kind, MatchDecision::kUndecided);
  EXPECT_EQ(matcher.decide_by_mass().candidate, 0);  // .24, .24, ignorance .16
}

TEST(OpenWorld, EverythingFarIsNone) {
  OpenWorldMatcher matcher;
  matcher.combine(Candidates{{0.0, .9, .1}, {0.0, .9, .1}});
  EXPECT_EQ(matcher.decide_by_mass().kind, MatchDecision::kNone);
  EXPECT_NEAR(matcher.decide_by_mass().value, .81, 1e-15);
  EXPECT_EQ(matcher.decide_by_pignistic().kind, MatchDecision::kNone);
}

TEST(OpenWorld, CertaintiesWeighInfinitely) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(assignment_weight({1.0, 0.0, 0.0}), infinity);
  EXPECT_EQ(assignment_weight({0.0, 1.0, 0.0}), -infinity);
  EXPECT_EQ(assignment_weight(BinaryMass::vacuous()), 0.0);
  EXPECT_NEAR(assignment_weight({.5, .2, .3}), std::log(.8 / .5), 1e-15);
}

TEST(OpenWorld, AMatcherInUseDoesNotAllocate) {
  const Candidates many(40, BinaryMass{.01, .8, .19}), few(3, BinaryMass{.5, .2, .3});
  OpenWorldMatcher matcher;
  matcher.reserve(many.size());
  const int before = credo::testing::allocations();
  for (int i = 0; i < 10; ++i) {
    for (const Candidates* candidates : {&many, &few}) {
      matcher.combine(*candidates);
      (void)matcher.normalised();
      (void)matcher.plausibility();
      (void)matcher.decide_by_mass();
      (void)matcher.decide_by_pignistic();
    }
  }
  EXPECT_EQ(credo::testing::allocations(), before);
  const Candidates more(41, BinaryMass{.01, .8, .19});
  matcher.combine(more);
  EXPECT_GT(credo::testing::allocations(), before);  // the counter counts
}

}  // namespace
}  // namespace credo::evidence
