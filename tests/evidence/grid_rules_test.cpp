// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/grid_rules.hpp"

#include <gtest/gtest.h>

#include <random>

#include "evidence/averaging.hpp"
#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/proportional.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using Masses = std::vector<GridMass>;

const Frame& free_frame() {
  static const Frame frame = Frame::free_dsm({"E", "O"});
  return frame;
}

const Frame& exclusive_frame() {
  static const Frame frame = Frame::hybrid({"E", "O"}, std::vector<std::string>{"E ∩ O"});
  return frame;
}

std::vector<MassFunction> general(const Frame& frame, const Masses& sources) {
  std::vector<MassFunction> result;
  for (const GridMass& m : sources) {
    result.emplace_back(frame, std::initializer_list<std::pair<std::string_view, double>>{
                                   {"E", m.empty}, {"O", m.occupied}, {"E ∩ O", m.conflict}, {"E ∪ O", m.unknown}});
  }
  return result;
}

GridMass grid(const MassFunction& mass) {
  return {mass.mass("E"), mass.mass("O"), mass.mass("E ∩ O"), mass.mass("E ∪ O")};
}

double distance(const FusedGridMass& closed, const Fused& fused) {
  return std::max(distance(closed.mass, grid(fused.mass)), std::abs(closed.conflict - fused.conflict));
}

// nothing, or what is the first fault
std::string disagreement(const Masses& sources) {
  const std::vector<MassFunction> free = general(free_frame(), sources),
                                  constrained = general(exclusive_frame(), sources);
  if (!(distance(disjunctive(sources), grid(disjunctive(free))) < 1e-14)) return "disjunctive";
  if (!(distance(disjunctive(sources), grid(disjunctive(constrained))) < 1e-14)) return "disjunctive, exclusive";
  if (!(distance(average(sources), grid(average(free))) < 1e-14)) return "average";
  const auto closed = dempster(sources);
  const auto fused = dempster(constrained);
  if (closed.has_value() != fused.has_value()) return "dempster at total conflict";
  if (closed && !(distance(*closed, *fused) < 1e-12)) return "dempster";
  if (!(distance(conflict_to_ignorance(sources), conflict_to_ignorance(constrained)) < 1e-14)) return "yager";
  if (!(distance(dsmh(sources), dsmh(constrained)) < 1e-14)) return "dsmh";
  if (!(distance(pcr2(sources), pcr2(constrained)) < 1e-14)) return "pcr2";
  if (sources.size() == 2) {
    if (!(distance(pcr5(sources[0], sources[1]), pcr5(constrained)) < 1e-14)) return "pcr5";
    if (!(distance(pcr5(sources[0], sources[1]), pcr6(constrained)) < 1e-14)) return "pcr6";
  }
  return "";
}

RC_GTEST_PROP(GridRuleLaws, TheGeneralRulesGiveTheSame, (Masses sources)) {
  RC_PRE(!sources.empty());
  if (sources.size() > 5) sources.resize(5);
  RC_ASSERT(disagreement(sources) == "");
}

RC_GTEST_PROP(GridRuleLaws, TheGeneralRulesGiveTheSameForTwo, (const GridMass& a, const GridMass& b)) {
  RC_ASSERT(disagreement({a, b}) == "");
}

TEST(GridRules, TenThousandSetsOfSourcesAgreeWithTheGeneralRules) {
  std::mt19937 random(5);
  for (int k = 0; k < 10'000; ++k) {
    Masses sources;
    while (sources.size() < static_cast<std::size_t>(1 + k % 4)) {
      const auto share = [&] { return random() % 3 == 0 ? 0.0 : static_cast<double>(random() % 1000); };
      const double e = share(), o = share(), c = share(), u = share(), sum = e + o + c + u;
      if (sum > 0.0) sources.push_back({e / sum, o / sum, c / sum, u / sum});
    }
    ASSERT_EQ(disagreement(sources), "") << k << ", the first of " << sources.size() << ": " << sources[0];
  }
}

RC_GTEST_PROP(GridRuleLaws, ResultsAreMassesWithoutConflict, (const Masses& sources, const GridMass& other)) {
  const GridMass last = sources.empty() ? GridMass::vacuous() : sources.back();
  for (const FusedGridMass& fused : {conflict_to_ignorance(sources), dsmh(sources), pcr2(sources), pcr5(last, other)}) {
    RC_ASSERT(std::abs(total(fused.mass) - 1.0) < 1e-13);
    RC_ASSERT(std::min({fused.mass.empty, fused.mass.occupied, fused.mass.unknown}) >= 0.0);
    RC_ASSERT(fused.mass.conflict == 0.0);
    RC_ASSERT(fused.conflict >= 0.0 && fused.conflict <= 1.0 + 1e-13);
  }
}

RC_GTEST_PROP(GridRuleLaws, SourcesMayComeInAnyOrder, (Masses sources)) {
  const GridMass hybrid = dsmh(sources).mass, united = disjunctive(sources), shared = pcr2(sources).mass;
  std::reverse(sources.begin(), sources.end());
  RC_ASSERT(distance(dsmh(sources).mass, hybrid) < 1e-13);
  RC_ASSERT(distance(disjunctive(sources), united) < 1e-13);
  RC_ASSERT(distance(pcr2(sources).mass, shared) < 1e-13);
}

TEST(GridRules, TheOverlapIsNeutralInUnions) {
  const GridMass overlap{0.0, 0.0, 1.0, 0.0}, mass{.5, .25, .125, .125};
  EXPECT_EQ(disjunctive(Masses{overlap, mass, overlap}), mass);
  EXPECT_EQ(disjunctive(Masses{}), overlap);
}

TEST(GridRules, TotalConflictOfEveryRule) {
  const GridMass overlap{0.0, 0.0, 1.0, 0.0}, empty{1.0, 0.0, 0.0, 0.0}, occupied{0.0, 1.0, 0.0, 0.0};
  for (const Masses& sources : {Masses{overlap, overlap}, Masses{empty, overlap}, Masses{empty, occupied}}) {
    EXPECT_FALSE(dempster(sources));
    EXPECT_EQ(conflict_to_ignorance(sources).mass, GridMass::vacuous());
    EXPECT_EQ(conflict_to_ignorance(sources).conflict, 1.0);
  }
  EXPECT_EQ(pcr2(Masses{overlap, overlap}).mass, GridMass::vacuous());
  EXPECT_EQ(pcr5(overlap, overlap).mass, GridMass::vacuous());
  EXPECT_EQ(dsmh(Masses{overlap, overlap}).mass, GridMass::vacuous());
  EXPECT_EQ(pcr2(Masses{empty, overlap}).mass, empty);
  EXPECT_EQ(pcr5(empty, overlap).mass, empty);
  EXPECT_EQ(dsmh(Masses{empty, overlap}).mass, empty);
  EXPECT_EQ(pcr2(Masses{empty, occupied}).mass, (GridMass{.5, .5, 0.0, 0.0}));
  EXPECT_EQ(pcr5(empty, occupied).mass, (GridMass{.5, .5, 0.0, 0.0}));
  EXPECT_EQ(dsmh(Masses{empty, occupied}).mass, GridMass::vacuous());
}

TEST(GridRules, NoSourceIsVacuousButHasNoAverage) {
  EXPECT_EQ(conflict_to_ignorance(Masses{}).mass, GridMass::vacuous());
  EXPECT_EQ(dsmh(Masses{}).mass, GridMass::vacuous());
  EXPECT_EQ(pcr2(Masses{}).mass, GridMass::vacuous());
  ASSERT_TRUE(dempster(Masses{}));
  EXPECT_EQ(dempster(Masses{})->mass, GridMass::vacuous());
  EXPECT_THROW((void)average(Masses{}), std::invalid_argument);
}

TEST(GridRules, DempsterStandsThousandsOfOpposedSources) {
  Masses sources;
  for (int i = 0; i < 2000; ++i) {
    sources.push_back({.9, 0.0, 0.0, .1});
    sources.push_back({0.0, .8, .1, .1});
  }
  const auto fused = dempster(sources);
  ASSERT_TRUE(fused);
  EXPECT_NEAR(total(fused->mass), 1.0, 1e-12);
  EXPECT_NEAR(fused->conflict, 1.0, 1e-12);
}

}  // namespace
}  // namespace credo::evidence
