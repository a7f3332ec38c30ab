// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <stdexcept>

#include "evidence/averaging.hpp"
#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/measures.hpp"
#include "evidence/proportional.hpp"
#include "tests/evidence/random_mass_functions.hpp"

namespace credo::evidence {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

static_assert(AssociativeRule<rule::Conjunctive> && AssociativeRule<rule::Dempster> &&
              AssociativeRule<rule::Disjunctive> && AssociativeRule<rule::Cautious> && AssociativeRule<rule::Bold>);
// A rule that is not associative cannot be folded by accident.
static_assert(!AssociativeRule<rule::ConflictToIgnorance> && !AssociativeRule<rule::DuboisPrade> &&
              !AssociativeRule<rule::Dsmh> && !AssociativeRule<rule::Pcr2> && !AssociativeRule<rule::Pcr5> &&
              !AssociativeRule<rule::Pcr6> && !AssociativeRule<rule::Average> && !AssociativeRule<rule::Murphy>);

const Frame kAbc = Frame::shafer({"A", "B", "C"});
const Frame kAb = Frame::shafer({"A", "B"});

void expect_mass(const MassFunction& mass, std::initializer_list<std::pair<std::string_view, double>> expected,
                 double tolerance = 1e-12) {
  EXPECT_LE(distance(mass, MassFunction(mass.frame(), expected)), tolerance) << mass;
}

// Zadeh (1979): two experts, each nearly sure of something else, agree on what both hold nearly impossible.
const MassFunction kFirst(kAbc, {{"A", 0.9}, {"C", 0.1}});
const MassFunction kSecond(kAbc, {{"B", 0.9}, {"C", 0.1}});

TEST(Rules, ZadehsExample) {
  const Masses sources = {kFirst, kSecond};
  expect_mass(conjunctive(sources), {{"∅", 0.99}, {"C", 0.01}});
  expect_mass(dempster(sources)->mass, {{"C", 1.0}});
  EXPECT_NEAR(dempster(sources)->conflict, 0.99, 1e-15);
  expect_mass(conflict_to_ignorance(sources).mass, {{"C", 0.01}, {"Θ", 0.99}});
  expect_mass(dubois_prade(sources).mass, {{"A ∪ B", 0.81}, {"A ∪ C", 0.09}, {"B ∪ C", 0.09}, {"C", 0.01}});
  expect_mass(disjunctive(sources), {{"A ∪ B", 0.81}, {"A ∪ C", 0.09}, {"B ∪ C", 0.09}, {"C", 0.01}});
  expect_mass(pcr5(sources).mass, {{"A", 0.486}, {"B", 0.486}, {"C", 0.028}});
  expect_mass(pcr6(sources).mass, {{"A", 0.486}, {"B", 0.486}, {"C", 0.028}});
  expect_mass(average(sources), {{"A", 0.45}, {"B", 0.45}, {"C", 0.1}});
}

TEST(Rules, Pcr2HasItsPublishedExamples) {
  const auto pcr2_of = [](std::initializer_list<std::pair<std::string_view, double>> a,
                          std::initializer_list<std::pair<std::string_view, double>> b) {
    return pcr2({MassFunction(kAb, a), MassFunction(kAb, b)}).mass;
  };
  expect_mass(pcr2_of({{"A", 0.6}, {"Θ", 0.4}}, {{"B", 0.3}, {"Θ", 0.7}}), {{"A", 0.54}, {"B", 0.18}, {"Θ", 0.28}});
  expect_mass(pcr2_of({{"A", 0.6}, {"Θ", 0.4}}, {{"A", 0.2}, {"B", 0.3}, {"Θ", 0.5}}),
              {{"A", 0.63 + 0.01 / 11.0}, {"B", 0.17 - 0.01 / 11.0}, {"Θ", 0.2}});
}

TEST(Rules, CategoricalVotersAreCountedByPcr6AndNotByPcr5) {
  const MassFunction a = MassFunction::categorical(kAb, kAb.parse("A"));
  const MassFunction b = MassFunction::categorical(kAb, kAb.parse("B"));
  expect_mass(pcr6({a, a, a, b}).mass, {{"A", 0.75}, {"B", 0.25}});
  expect_mass(pcr2({a, a, a, b}).mass, {{"A", 0.75}, {"B", 0.25}});
  expect_mass(pcr5({a, a, a, b}).mass, {{"A", 0.5}, {"B", 0.5}});
}

TEST(Rules, TotalConflictHasATypedOutcome) {
  const Masses opposed = {MassFunction::categorical(kAb, kAb.parse("A")),
                          MassFunction::categorical(kAb, kAb.parse("B"))};
  EXPECT_FALSE(dempster(opposed).has_value());
  EXPECT_EQ(conjunctive(opposed).conflict(), 1.0);
  EXPECT_TRUE(conflict_to_ignorance(opposed).mass.is_vacuous());
  for (const NamedRule& rule : all_rules()) {
    if (rule.name == "cautious" || rule.name == "bold") continue;  // they refuse dogmatic sources
    const std::optional<Fused> fused = rule.combine(opposed);
    EXPECT_EQ(fused.has_value(), rule.name != "dempster") << rule.name;
    EXPECT_NEAR(fused ? total(fused->mass) : 1.0, 1.0, 1e-15) << rule.name;
  }
}

TEST(Rules, ConstraintsDecideWhatIsInConflict) {
  const std::string exclusive[] = {"A ∩ B"}, without_c[] = {"C"};
  const auto fused = [](const Frame& frame, const char* first, const char* second) {
    return dsmh({MassFunction::categorical(frame, frame.parse(first)),
                 MassFunction::categorical(frame, frame.parse(second))})
        .mass;
  };
  const Frame hybrid = Frame::hybrid({"A", "B", "C"}, exclusive);
  expect_mass(fused(hybrid, "A", "C"), {{"A ∩ C", 1.0}});          // S1: they may overlap
  expect_mass(fused(hybrid, "A", "B"), {{"A ∪ B", 1.0}});          // S3
  expect_mass(fused(hybrid, "A ∩ B", "A ∩ B"), {{"A ∪ B", 1.0}});  // S2: what composes it
  const Frame dynamic = Frame::hybrid({"A", "B", "C"}, without_c);
  expect_mass(fused(dynamic, "C", "A"), {{"A", 1.0}});  // S3: only A exists of C ∪ A
  expect_mass(fused(dynamic, "C", "C"), {{"Θ", 1.0}});  // S2: nothing does
}

TEST(Rules, HundredsOfOpposedSourcesDoNotUnderflow) {
  Masses sources;
  for (int i = 0; i < 400; ++i) {
    sources.emplace_back(
        kAb, std::initializer_list<std::pair<std::string_view, double>>{{i % 2 == 0 ? "A" : "B", 0.999}, {"Θ", 0.001}});
  }
  const std::optional<Fused> fused = dempster(sources);
  ASSERT_TRUE(fused.has_value());
  expect_mass(fused->mass, {{"A", 0.5}, {"B", 0.5}}, 1e-9);
  EXPECT_NEAR(fused->conflict, 1.0, 1e-12);
}

TEST(Rules, NearTotalConflictKeepsItsDigits) {
  const double tiny = 1e-12;
  const MassFunction a(kAb, {{"A", 1.0 - tiny}, {"Θ", tiny}}), b(kAb, {{"B", 1.0 - tiny}, {"Θ", tiny}});
  const double rest = 2.0 * tiny * (1.0 - tiny) + tiny * tiny;
  expect_mass(dempster({a, b})->mass,
              {{"A", tiny * (1.0 - tiny) / rest}, {"B", tiny * (1.0 - tiny) / rest}, {"Θ", tiny * tiny / rest}}, 1e-14);
}

MassFunction dense_mass(const Frame& frame, std::uint64_t random_seed) {
  std::mt19937_64 generator(random_seed);
  std::vector<Focal> focals;
  double sum = 0.0;
  for (const Proposition& set : propositions_of(frame)) {
    focals.push_back({set, static_cast<double>(generator() % 1000)});
    sum += focals.back().mass;
  }
  for (Focal& focal : focals) focal.mass /= sum;
  return MassFunction(frame, focals);
}

// So many focal elements are combined by transforms.
TEST(Rules, MassesWhoseProductsUnderflowLoseNothing) {
  const MassFunction ab(kAbc, {{"A", 1e-200}, {"B", 1.0}}), ac(kAbc, {{"A", 1e-200}, {"C", 1.0}});
  EXPECT_FALSE(dempster({ab, ac}));
  EXPECT_EQ(conjunctive({ab, ac, MassFunction::vacuous(kAbc)}).conflict(), 1.0);

  const MassFunction a(kAbc, {{"A", 1e-200}, {"B", .5}, {"Θ", .5}}), c(kAbc, {{"A", .5}, {"C", 1e-200}, {"Θ", .5}});
  for (const NamedRule& rule : all_rules()) {
    if (rule.name == "bold") continue;  // needs mass on ∅
    const std::optional<Fused> fused = rule.combine({a, a, c, c});
    ASSERT_TRUE(fused) << rule.name;
    EXPECT_NEAR(total(fused->mass), 1.0, 1e-12) << rule.name;
  }
}

TEST(Rules, DenseSourcesGiveWhatTheirPairsGive) {
  const Frame frame = Frame::shafer(element_names(9));
  const MassFunction a = dense_mass(frame, 1), b = dense_mass(frame, 2);
  FocalSum pairs;
  for (const Focal& x : a.focals()) {
    for (const Focal& y : b.focals()) pairs.add(x.set & y.set, x.mass * y.mass);
  }
  const MassFunction expected = pairs.mass_function(frame);
  EXPECT_LE(distance(conjunctive({a, b}), expected), 1e-14);
  EXPECT_LE(distance(dempster({a, b})->mass, normalised(expected)->mass), 1e-14);
  EXPECT_NEAR(dempster({a, b})->conflict, expected.conflict(), 1e-14);
  FocalSum unions;
  for (const Focal& x : a.focals()) {
    for (const Focal& y : b.focals()) unions.add(x.set | y.set, x.mass * y.mass);
  }
  EXPECT_LE(distance(disjunctive({a, b}), unions.mass_function(frame)), 1e-14);
}

TEST(Rules, DenseSourcesNearTotalConflictAreCombinedByPairs) {
  const Frame frame = Frame::shafer(element_names(9));
  const MassFunction dense = dense_mass(frame, 3);
  const auto nearly = [&](const char* element) {  // 1e-8 of the mass is spread over everything
    std::vector<Focal> focals{{frame.parse(element), 1.0 - 1e-8}};
    for (const Focal& focal : dense.focals()) focals.push_back({focal.set, focal.mass * 1e-8});
    return MassFunction(frame, focals);
  };
  const MassFunction a = nearly("A"), b = nearly("B");
  FocalSum pairs;
  for (const Focal& x : a.focals()) {
    for (const Focal& y : b.focals()) {
      if (x.set.meets(y.set)) pairs.add(x.set & y.set, x.mass * y.mass);
    }
  }
  EXPECT_LE(distance(dempster({a, b})->mass, normalised(pairs.mass_function(frame))->mass), 1e-12);
}

// 8 elements that may overlap have more than 10^22 propositions, 200 that exclude each other 2^200.
TEST(Rules, LargeFramesNeedNoEnumeration) {
  const Frame free = Frame::free_dsm(element_names(8));
  const MassFunction a(free, {{"A ∩ B ∪ C", 0.6}, {"Θ", 0.4}}), b(free, {{"A ∪ H", 0.5}, {"Θ", 0.5}});
  const MassFunction both = conjunctive({a, b});
  EXPECT_NEAR(both.mass("A ∩ B ∪ A ∩ C ∪ C ∩ H"), 0.3, 1e-15);
  EXPECT_EQ(free.to_string(free.parse("(A ∩ B ∪ C) ∩ (A ∪ H)")), "A ∩ B ∪ A ∩ C ∪ C ∩ H");
  EXPECT_NEAR(belief(both, free.parse("A ∪ C")), 0.6, 1e-15);

  std::vector<std::string> names;
  for (int i = 0; i < 200; ++i) names.push_back("place " + std::to_string(i));
  const Frame large = Frame::shafer(names);
  const MassFunction early = MassFunction::simple_support(large, Proposition::first(150), 0.8);
  const MassFunction late = MassFunction::simple_support(large, large.all() - Proposition::first(140), 0.5);
  const MassFunction here = dempster({early, late})->mass;
  EXPECT_NEAR(belief(here, Proposition::first(150) - Proposition::first(140)), 0.4, 1e-15);
  EXPECT_NEAR(pcr6({early, late, late}).mass.mass(large.all()), 0.05, 1e-15);
}

TEST(Rules, TooManyProductsAreRefused) {
  const Masses sources(20, MassFunction(kAbc, {{"A", 0.5}, {"B", 0.25}, {"Θ", 0.25}}));
  EXPECT_THAT([&] { static_cast<void>(pcr6(sources)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("products of focal elements")));
  EXPECT_NO_THROW(static_cast<void>(pcr2(sources)));  // no product is visited
  EXPECT_NO_THROW(static_cast<void>(dubois_prade(sources)));
}

TEST(Rules, Pcr2NeedsNoProductsOfManySources) {  // 5^40 of them
  const Frame frame = Frame::shafer(element_names(10));
  std::vector<MassFunction> sources;
  for (std::uint64_t i = 0; i < 40; ++i) {
    std::vector<Focal> focals;
    for (std::uint64_t k = 1; k <= 5; ++k)
      focals.push_back({Proposition::from_bits((37 * i + 211 * k) % 1023 + 1), .2});
    sources.emplace_back(frame, focals);
  }
  EXPECT_NEAR(total(pcr2(sources).mass), 1.0, 1e-12);
}

TEST(Rules, SourcesThatCannotBeCombinedAreRefused) {
  for (const NamedRule& rule : all_rules()) {
    EXPECT_THROW(rule.combine(Masses{}), std::invalid_argument) << rule.name;
    EXPECT_THROW(rule.combine({MassFunction::vacuous(kAb), MassFunction::vacuous(kAbc)}), std::invalid_argument)
        << rule.name;
  }
  EXPECT_THAT([] { static_cast<void>(cautious({kFirst})); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("dogmatic")));
  EXPECT_THAT([] { static_cast<void>(bold({kFirst})); }, ThrowsMessage<std::invalid_argument>(HasSubstr("∅")));
  EXPECT_THROW(static_cast<void>(negation(MassFunction::vacuous(Frame::free_dsm({"A", "B"})))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(recompose({kAb, {-1.0, 5.0, 0.0, 0.0}})), std::invalid_argument);
}

TEST(Rules, OnlyWhatWasCombinedIsTakenOut) {
  const MassFunction a = MassFunction::simple_support(kAb, kAb.parse("A"), 0.5);
  const MassFunction b = MassFunction::simple_support(kAb, kAb.parse("B"), 0.5);
  EXPECT_EQ(decombine(a, b), std::nullopt);
  EXPECT_THAT([&] { static_cast<void>(decombine(a, MassFunction::categorical(kAb, kAb.parse("A")))); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("dogmatic")));
}

TEST(Rules, AnAverageTakesWeights) {
  const double weights[] = {3.0, 1.0}, negative[] = {1.0, -1.0}, none[] = {0.0, 0.0};
  expect_mass(average({kFirst, kSecond}, weights), {{"A", 0.675}, {"B", 0.225}, {"C", 0.1}});
  EXPECT_THROW(static_cast<void>(average({kFirst, kSecond}, negative)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(average({kFirst, kSecond}, none)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(average({kFirst, kSecond}, std::span(weights, 1))), std::invalid_argument);
}

TEST(Rules, MurphySharpensTheMean) {
  const MassFunction a(kAb, {{"A", 0.6}, {"B", 0.4}});
  expect_mass(murphy({a, a})->mass, {{"A", 0.36 / 0.52}, {"B", 0.16 / 0.52}});
  EXPECT_NEAR(murphy({a, a})->conflict, 0.48, 1e-15);
  const MassFunction nothing = MassFunction::categorical(kAb, {});
  EXPECT_FALSE(murphy({nothing, nothing}).has_value());
}

TEST(Rules, AFoldKeepsItsMassAtTotalConflict) {
  Fold<rule::Dempster> fold(MassFunction::simple_support(kAb, kAb.parse("A"), 0.5));
  EXPECT_TRUE(fold.add(MassFunction::simple_support(kAb, kAb.parse("A"), 0.5)));
  expect_mass(fold.mass(), {{"A", 0.75}, {"Θ", 0.25}});
  EXPECT_FALSE(fold.add(MassFunction::categorical(kAb, {})));
  expect_mass(fold.mass(), {{"A", 0.75}, {"Θ", 0.25}});
}

TEST(Rules, FoldsOfRulesThatAreNotAssociativeDependOnTheOrder) {
  const MassFunction a(kAb, {{"A", 0.6}, {"B", 0.3}, {"Θ", 0.1}}), b(kAb, {{"A", 0.2}, {"B", 0.7}, {"Θ", 0.1}}),
      c(kAb, {{"A", 0.1}, {"B", 0.8}, {"Θ", 0.1}});
  EXPECT_GT(distance(fold_in_order<rule::Pcr5>({a, b, c})->mass, fold_in_order<rule::Pcr5>({c, b, a})->mass), 0.08);
  EXPECT_LT(distance(fold_in_order<rule::Dempster>({a, b, c})->mass, dempster({c, b, a})->mass), 1e-15);
  const MassFunction sure_a = MassFunction::categorical(kAb, kAb.parse("A")),
                     sure_b = MassFunction::categorical(kAb, kAb.parse("B"));
  EXPECT_FALSE(fold_in_order<rule::Dempster>({sure_a, sure_b, a}).has_value());
}

TEST(Rules, AreFoundByName) {
  EXPECT_EQ(rule_named("pcr6").name, rule::Pcr6::kName);
  EXPECT_THAT([] { static_cast<void>(rule_named("bayes")); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("there are: conjunctive, dempster")));
}

}  // namespace
}  // namespace credo::evidence
