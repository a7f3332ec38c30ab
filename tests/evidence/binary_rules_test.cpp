// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "evidence/averaging.hpp"
#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/discounting.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/proportional.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using Masses = std::vector<BinaryMass>;
using OpenMasses = std::vector<OpenBinaryMass>;

const Frame& frame() {
  static const Frame yes_no = Frame::shafer({"YES", "NO"});
  return yes_no;
}

std::vector<MassFunction> general(const Masses& sources) {
  std::vector<MassFunction> result;
  for (const BinaryMass& source : sources) result.push_back(from_binary(frame(), source));
  return result;
}

MassFunction general(const OpenBinaryMass& mass) {
  const Focal focals[] = {{frame().element(0), mass.yes},
                          {frame().element(1), mass.no},
                          {frame().all(), mass.unknown},
                          {Proposition(), mass.conflict}};
  return MassFunction(frame(), focals);
}

std::vector<MassFunction> general(const OpenMasses& sources) {
  std::vector<MassFunction> result;
  for (const OpenBinaryMass& source : sources) result.push_back(general(source));
  return result;
}

OpenBinaryMass open(const MassFunction& mass) {
  return {mass.mass("YES"), mass.mass("NO"), mass.mass("Θ"), mass.conflict()};
}

OpenBinaryMass open(const BinaryMass& mass) { return {mass.yes, mass.no, mass.unknown, 0.0}; }

double distance(const OpenBinaryMass& a, const OpenBinaryMass& b) {
  return std::max({std::abs(a.yes - b.yes), std::abs(a.no - b.no), std::abs(a.unknown - b.unknown),
                   std::abs(a.conflict - b.conflict)});
}

double distance(const FusedBinaryMass& closed, const Fused& fused) {
  return std::max(distance(closed.mass, to_binary(fused.mass)), std::abs(closed.conflict - fused.conflict));
}

bool is_mass(const BinaryMass& mass) {
  return std::min({mass.yes, mass.no, mass.unknown}) >= 0.0 && std::abs(total(mass) - 1.0) < 1e-13;
}

Masses at_most(Masses sources, std::size_t count) {
  if (sources.size() > count) sources.resize(count);
  return sources;
}

RC_GTEST_PROP(BinaryRuleLaws, TheGeneralRulesGiveTheSame, (Masses sources)) {
  sources = at_most(sources, 4);
  RC_PRE(!sources.empty());
  const std::vector<MassFunction> all = general(sources);
  RC_ASSERT(distance(open(disjunctive(sources)), open(disjunctive(all))) < 1e-14);
  RC_ASSERT(distance(open(average(sources)), open(average(all))) < 1e-15);
  RC_ASSERT(distance(murphy(sources), *murphy(all)) < 1e-13);
  RC_ASSERT(distance(pcr2(sources), pcr2(all)) < 1e-14);
  RC_ASSERT(distance(pcr5(sources), pcr5(all)) < 1e-14);
  RC_ASSERT(distance(pcr6(sources), pcr6(all)) < 1e-12);
  RC_ASSERT(distance(conflict_to_ignorance(sources), dubois_prade(all)) < 1e-14);
  RC_ASSERT(distance(conflict_to_ignorance(sources), dsmh(all)) < 1e-14);
}

TEST(BinaryRules, TenThousandSetsOfSourcesAgreeWithTheGeneralRules) {
  MassesOfAllMagnitudes random;
  for (int k = 0; k < 10'000; ++k) {
    const Masses sources = random.next(static_cast<std::size_t>(1 + k % 4));
    const std::vector<MassFunction> all = general(sources);
    ASSERT_LT(distance(open(disjunctive(sources)), open(disjunctive(all))), 1e-14) << k;
    ASSERT_LT(distance(open(average(sources)), open(average(all))), 1e-15) << k;
    ASSERT_LT(distance(murphy(sources), *murphy(all)), 1e-13) << k;
    ASSERT_LT(distance(pcr2(sources), pcr2(all)), 1e-14) << k;
    ASSERT_LT(distance(pcr5(sources), pcr5(all)), 1e-14) << k;
    ASSERT_LT(distance(pcr6(sources), pcr6(all)), 1e-12) << k;
  }
}

RC_GTEST_PROP(BinaryRuleLaws, ResultsAreMassesWhateverTheConflict, (const Masses& sources)) {
  RC_ASSERT(is_mass(pcr2(sources).mass));
  RC_ASSERT(is_mass(pcr6(sources).mass));
  RC_ASSERT(is_mass(pcr6_plus(sources).mass));
  const Masses few = at_most(sources, 6);
  RC_ASSERT(is_mass(pcr5(few).mass));
  RC_ASSERT(is_mass(pcr5_plus(few).mass));
  RC_PRE(!sources.empty());
  RC_ASSERT(is_mass(disjunctive(sources)));
  RC_ASSERT(is_mass(average(sources)));
  RC_ASSERT(is_mass(murphy(sources).mass));
}

RC_GTEST_PROP(BinaryRuleLaws, VacuousSourcesChangeNothingWhereTheyAreNeutral, (Masses sources)) {
  sources = at_most(sources, 6);
  const BinaryMass two = pcr2(sources).mass, five = pcr5_plus(sources).mass, six = pcr6_plus(sources).mass;
  sources.insert(sources.begin() + static_cast<std::ptrdiff_t>(sources.size() / 2), 3, BinaryMass::vacuous());
  RC_ASSERT(distance(pcr2(sources).mass, two) < 1e-14);
  RC_ASSERT(distance(pcr5_plus(sources).mass, five) < 1e-14);
  RC_ASSERT(distance(pcr6_plus(sources).mass, six) < 1e-12);
}

TEST(BinaryRules, VacuousSourcesShareInPcr5AndPcr6) {
  const BinaryMass a{.6, .3, .1}, b{.2, .7, .1}, vacuous;
  EXPECT_GT(distance(pcr5({a, b, vacuous}).mass, pcr5({a, b}).mass), .05);
  EXPECT_GT(distance(pcr6({a, b, vacuous}).mass, pcr6({a, b}).mass), .05);
}

RC_GTEST_PROP(BinaryRuleLaws, SourcesMayComeInAnyOrder, (Masses sources)) {
  sources = at_most(sources, 7);
  const BinaryMass two = pcr2(sources).mass, five = pcr5(sources).mass, six = pcr6(sources).mass;
  std::reverse(sources.begin(), sources.end());
  RC_ASSERT(distance(pcr2(sources).mass, two) < 1e-14);
  RC_ASSERT(distance(pcr5(sources).mass, five) < 1e-13);
  RC_ASSERT(distance(pcr6(sources).mass, six) < 1e-12);
}

TEST(BinaryRules, TheMostExtremeMassesKeepTheSum) {
  for (const double tiny : {1e-9, 1e-30, 1e-150, 1e-300}) {
    const BinaryMass yes{1.0 - tiny, tiny, 0.0}, no{tiny, 1.0 - tiny, 0.0}, nothing{tiny, tiny, 1.0 - 2.0 * tiny};
    for (const Masses& sources : {Masses{yes, no, nothing}, Masses{nothing, nothing, nothing},
                                  Masses{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, nothing}}) {
      for (const auto& rule : {pcr2, pcr5, pcr6, pcr5_plus, pcr6_plus}) {
        EXPECT_TRUE(is_mass(rule(sources).mass)) << tiny << ' ' << rule(sources).mass;
      }
    }
  }
}

TEST(BinaryRules, CategoricalSourcesVote) {
  const Masses sources{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  EXPECT_NEAR(pcr2(sources).mass.yes, .75, 1e-15);
  EXPECT_NEAR(pcr6(sources).mass.yes, .75, 1e-12);
  EXPECT_NEAR(pcr5(sources).mass.yes, .5, 1e-15);
  EXPECT_EQ(pcr6(sources).conflict, 1.0);
  EXPECT_FALSE(dempster(sources));
}

TEST(BinaryRules, Pcr5RefusesMoreProductsThanItCanVisit) {
  try {
    (void)pcr5(Masses(17, BinaryMass{.5, .3, .2}));
    FAIL() << "3^17 products";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("17 sources"), ::testing::HasSubstr("PCR6")));
  }
  // Vacuous and categorical ones do not multiply.
  Masses sources(40, BinaryMass::vacuous());
  sources[7] = sources[30] = {.6, .3, .1};
  EXPECT_NEAR(total(pcr5(sources).mass), 1.0, 1e-14);
  EXPECT_LT(distance(pcr5_plus(sources).mass, pcr5({sources[7], sources[30]}).mass), 1e-15);
}

TEST(BinaryRules, NoSourceIsVacuousWhereThatIsNeutralAndRefusedElsewhere) {
  for (const auto& rule : {pcr2, pcr5, pcr6, pcr5_plus, pcr6_plus}) {
    EXPECT_EQ(rule(Masses{}).mass, BinaryMass::vacuous());
    EXPECT_EQ(rule({{.6, .3, .1}}).mass, (BinaryMass{.6, .3, .1}));
  }
  EXPECT_THROW((void)disjunctive(Masses{}), std::invalid_argument);
  EXPECT_THROW((void)average(Masses{}), std::invalid_argument);
  EXPECT_THROW((void)murphy(Masses{}), std::invalid_argument);
  EXPECT_THROW((void)cautious(Masses{}), std::invalid_argument);
  EXPECT_THROW((void)bold(OpenMasses{}), std::invalid_argument);
}

TEST(BinaryRules, AveragesTakeWeights) {
  const Masses sources{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  EXPECT_EQ(average(sources, std::array{3.0, 1.0}), (BinaryMass{.75, .25, 0.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)average(sources, std::array{1.0}), std::invalid_argument);
  EXPECT_THROW((void)average(sources, std::array{0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW((void)average(sources, std::array{-1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW((void)average(sources, std::array{nan, 2.0}), std::invalid_argument);
}

// Sources that leave at least a hundredth to ignorance: general weights are sums of logarithms.
Masses with_ignorance(const Masses& sources) {
  Masses result;
  for (const BinaryMass& source : sources) result.push_back(discount(source, .99));
  return result;
}

OpenMasses with_conflict(const Masses& sources) {
  OpenMasses result;
  for (std::size_t i = 1; i < sources.size(); ++i) {
    OpenBinaryMass both = conjunctive({sources[i - 1], sources[i]});
    both = {.99 * both.yes, .99 * both.no, .99 * both.unknown, .99 * both.conflict + .01};
    result.push_back(both);
  }
  return result;
}

RC_GTEST_PROP(BinaryRuleLaws, CautiousAndBoldAreThoseOfTheDecomposition, (Masses sources)) {
  sources = with_ignorance(at_most(sources, 5));
  RC_PRE(sources.size() > 1u);
  RC_ASSERT(distance(cautious(sources), open(cautious(general(sources)))) < 1e-12);
  const OpenMasses conflicting = with_conflict(sources);
  RC_ASSERT(distance(cautious(conflicting), open(cautious(general(conflicting)))) < 1e-10);
  RC_ASSERT(distance(bold(conflicting), open(bold(general(conflicting)))) < 1e-10);
}

RC_GTEST_PROP(BinaryRuleLaws, CautiousIsIdempotentAndAssociative,
              (const BinaryMass& a, const BinaryMass& b, const BinaryMass& c)) {
  const Masses s = with_ignorance({a, b, c});
  RC_ASSERT(distance(cautious({s[0], s[0]}), open(s[0])) < 1e-14);
  const OpenBinaryMass at_once = cautious(s);
  const OpenBinaryMass left = cautious(OpenMasses{cautious({s[0], s[1]}), open(s[2])});
  const OpenBinaryMass right = cautious(OpenMasses{open(s[0]), cautious({s[1], s[2]})});
  RC_ASSERT(std::abs(total(at_once) - 1.0) < 1e-13);
  RC_ASSERT(std::min({at_once.yes, at_once.no, at_once.unknown, at_once.conflict}) >= 0.0);
  RC_ASSERT(distance(left, at_once) < 1e-12);
  RC_ASSERT(distance(right, at_once) < 1e-12);
}

TEST(BinaryRules, CautiousAndBoldRefuseWhatHasNoWeights) {
  EXPECT_THROW((void)cautious({{.5, .5, 0.0}, {.2, .2, .6}}), std::invalid_argument);
  EXPECT_THROW((void)cautious({{.2, .2, .6}, {1.0, 0.0, 5e-324}}), std::invalid_argument);
  EXPECT_THROW((void)bold(OpenMasses{{.5, .25, .25, 0.0}}), std::invalid_argument);
  const OpenBinaryMass nearly = cautious({{.5, .5, 3e-308}, {.25, .75, 3e-308}});
  EXPECT_NEAR(total(nearly), 1.0, 1e-13);
}

RC_GTEST_PROP(BinaryRuleLaws, DecombinationUndoesTheConjunction, (const Masses& sources, const BinaryMass& part)) {
  const BinaryMass weak = discount(part, .9);
  const OpenBinaryMass rest = conjunctive(sources);
  Masses all = sources;
  all.push_back(weak);
  const auto undone = decombine(conjunctive(all), weak);
  RC_ASSERT(undone.has_value());
  RC_ASSERT(distance(*undone, rest) < 1e-13);
}

TEST(BinaryRules, DecombinationRefusesWhatWasNotThere) {
  EXPECT_FALSE(decombine({.2, .1, .7, 0.0}, {.5, 0.0, .5}));
  EXPECT_FALSE(decombine(conjunctive({{.5, 0.0, .5}}), {0.0, .1, .9}));
  EXPECT_FALSE(decombine({1.0, 0.0, 1e-15, 0.0}, {1.0, 0.0, 1e-16}));  // more ignorance than before
  EXPECT_THROW((void)decombine({.2, .1, .7, 0.0}, {.5, .5, 0.0}), std::invalid_argument);
  const OpenBinaryMass whole = conjunctive({{.6, .3, .1}, {.2, .5, .3}});
  EXPECT_LT(
      distance(*decombine(whole, {.2, .5, .3}), open(*decombine(general(whole), from_binary(frame(), {.2, .5, .3})))),
      1e-14);
}

RC_GTEST_PROP(BinaryRuleLaws, ContextualDiscountingIsTheGeneralOne, (const BinaryMass& mass)) {
  const std::array r{*rc::gen::inRange(0, 101) / 100.0, *rc::gen::inRange(0, 101) / 100.0};
  const BinaryMass expected = to_binary(contextual_discount(from_binary(frame(), mass), r));
  RC_ASSERT(distance(contextual_discount(mass, r[0], r[1]), expected) < 1e-15);
  RC_ASSERT(contextual_discount(mass, 1.0, 1.0) == mass);
}

TEST(BinaryRules, ReliabilityCountsWhereTheSourceIsWrong) {
  EXPECT_EQ(contextual_discount({.5, .25, .25}, 0.0, 1.0), (BinaryMass{.5, 0.0, .5}));
}

}  // namespace
}  // namespace credo::evidence
