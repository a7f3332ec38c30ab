// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_mass.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using Masses = std::vector<BinaryMass>;

// Every tuple of focal elements, one from each source: YES = 1, NO = 2, the frame = 3, and AND is the intersection.
OpenBinaryMass enumerate(const Masses& sources) {
  std::array<double, 4> result{};
  const auto visit = [&](auto&& self, std::size_t i, unsigned element, double product) -> void {
    if (i == sources.size()) {
      result[element] += product;
      return;
    }
    self(self, i + 1, element & 1u, product * sources[i].yes);
    self(self, i + 1, element & 2u, product * sources[i].no);
    self(self, i + 1, element & 3u, product * sources[i].unknown);
  };
  visit(visit, 0, 3u, 1.0);
  return {result[1], result[2], result[3], result[0]};
}

double distance(const OpenBinaryMass& a, const OpenBinaryMass& b) {
  return std::max({std::abs(a.yes - b.yes), std::abs(a.no - b.no), std::abs(a.unknown - b.unknown),
                   std::abs(a.conflict - b.conflict)});
}

Masses at_most(Masses sources, std::size_t count) {
  if (sources.size() > count) sources.resize(count);
  return sources;
}

RC_GTEST_PROP(BinaryMassLaws, ConjunctionIsWhatEnumerationGives, (Masses sources)) {
  sources = at_most(sources, 6);
  RC_ASSERT(distance(conjunctive(sources), enumerate(sources)) < 1e-14);
}

RC_GTEST_PROP(BinaryMassLaws, EveryResultIsAMass, (const Masses& sources)) {
  const OpenBinaryMass open = conjunctive(sources);
  RC_ASSERT(std::abs(total(open) - 1.0) < 1e-14);
  RC_ASSERT(std::min({open.yes, open.no, open.unknown, open.conflict}) >= 0.0);
  const BinaryMass moved = conflict_to_ignorance(sources).mass;
  RC_ASSERT(std::abs(total(moved) - 1.0) < 1e-14);
  if (const auto normalised = dempster(sources)) {
    RC_ASSERT(std::abs(total(normalised->mass) - 1.0) < 1e-15);
    RC_ASSERT(std::min({normalised->mass.yes, normalised->mass.no, normalised->mass.unknown}) >= 0.0);
    RC_ASSERT(normalised->conflict == open.conflict);
  } else {
    RC_ASSERT(open.conflict > 1.0 - 1e-14);
  }
}

RC_GTEST_PROP(BinaryMassLaws, VacuousSourcesChangeNothing, (Masses sources)) {
  const OpenBinaryMass before = conjunctive(sources);
  const FusedBinaryMass moved = conflict_to_ignorance(sources);
  const auto normalised = dempster(sources);
  sources.insert(sources.begin() + static_cast<std::ptrdiff_t>(sources.size() / 2), 3, BinaryMass::vacuous());
  RC_ASSERT(distance(conjunctive(sources), before) < 1e-15);
  RC_ASSERT(distance(conflict_to_ignorance(sources).mass, moved.mass) < 1e-15);
  RC_ASSERT(dempster(sources).has_value() == normalised.has_value());
  if (normalised) RC_ASSERT(distance(dempster(sources)->mass, normalised->mass) < 1e-15);
}

RC_GTEST_PROP(BinaryMassLaws, SourcesMayComeInAnyOrder, (Masses sources)) {
  const OpenBinaryMass before = conjunctive(sources);
  std::reverse(sources.begin(), sources.end());
  RC_ASSERT(distance(conjunctive(sources), before) < 1e-14);
}

RC_GTEST_PROP(BinaryMassLaws, DempsterIsAssociative, (const BinaryMass& a, const BinaryMass& b, const BinaryMass& c)) {
  const auto ab = dempster({a, b});
  const auto bc = dempster({b, c});
  RC_PRE(ab && bc);
  const auto left = dempster({ab->mass, c});
  const auto right = dempster({a, bc->mass});
  RC_ASSERT(left.has_value() == right.has_value());
  if (left) RC_ASSERT(distance(left->mass, right->mass) < 1e-12);
}

TEST(BinaryMassLaws, ConflictToIgnoranceIsNotAssociative) {
  const BinaryMass a{.6, .3, .1}, b{.2, .7, .1}, c{.1, .8, .1};
  const BinaryMass left = conflict_to_ignorance({conflict_to_ignorance({a, b}).mass, c}).mass;
  const BinaryMass right = conflict_to_ignorance({a, conflict_to_ignorance({b, c}).mass}).mass;
  const BinaryMass at_once = conflict_to_ignorance({a, b, c}).mass;
  EXPECT_NEAR(at_once.yes, .041, 5e-4);
  EXPECT_GT(distance(left, right), .05);
  EXPECT_GT(distance(left, at_once), .04);
}

RC_GTEST_PROP(BinaryMassLaws, BeliefIsBelowPignisticBelowPlausibility, (const BinaryMass& mass)) {
  RC_ASSERT(mass.belief() <= mass.pignistic());
  RC_ASSERT(mass.pignistic() <= mass.plausibility());
  RC_ASSERT(std::abs(mass.plausibility() - (1.0 - mass.no)) < 1e-15);
}

RC_GTEST_PROP(BinaryMassLaws, DiscountingMovesTowardsIgnorance, (const BinaryMass& mass)) {
  const double reliability = *rc::gen::inRange(0, 1001) / 1000.0;
  const BinaryMass weak = discount(mass, reliability);
  RC_ASSERT(std::abs(total(weak) - 1.0) < 1e-15);
  RC_ASSERT(weak.unknown >= 0.0);
  RC_ASSERT(std::abs(weak.yes - reliability * mass.yes) < 1e-15);
  RC_ASSERT(discount(mass, 1.0) == mass);
  RC_ASSERT(discount(mass, 0.0) == BinaryMass::vacuous());
}

// Zadeh's example on two elements: two nearly certain sources that contradict each other.
TEST(BinaryMass, OpposedExpertsShareTheBelief) {
  const auto normalised = dempster({{.99, 0.0, .01}, {0.0, .99, .01}});
  ASSERT_TRUE(normalised);
  EXPECT_NEAR(normalised->conflict, .9801, 1e-15);
  EXPECT_NEAR(normalised->mass.yes, .0099 / .0199, 1e-15);
  EXPECT_NEAR(normalised->mass.unknown, .0001 / .0199, 1e-15);
  const FusedBinaryMass moved = conflict_to_ignorance({{.99, 0.0, .01}, {0.0, .99, .01}});
  EXPECT_NEAR(moved.mass.unknown, .9802, 1e-15);
}

// ... and as he gave it: both doctors leave .01 to the diagnosis that neither believes. Seen as that one against the
// rest.
TEST(BinaryMass, AgreementOnTheUnlikelyIsNoConflictAgainstTheRest) {
  const auto normalised = dempster({{.01, .99, 0.0}, {.01, .99, 0.0}});
  ASSERT_TRUE(normalised);
  EXPECT_NEAR(normalised->mass.yes, 1e-4 / (1e-4 + .9801), 1e-15);
}

TEST(BinaryMass, DempsterKeepsItsDigitsNearTotalConflict) {
  const auto fused = dempster({{1.0 - 1e-12, 0.0, 1e-12}, {0.0, 1.0, 0.0}});
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->mass, (BinaryMass{0.0, 1.0, 0.0}));
  const auto shared = dempster({{1.0, 3e-13, 0.0}, {1e-13, 1.0, 0.0}});
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->mass.yes, .25, 1e-15);
}

TEST(BinaryMass, TotalConflictHasNoDempsterAndIsIgnoranceOtherwise) {
  EXPECT_FALSE(dempster({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}));
  EXPECT_FALSE(fuse({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, FusionRule::kDempster));
  const auto moved = fuse({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, FusionRule::kConflictToIgnorance);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->mass, BinaryMass::vacuous());
  EXPECT_EQ(moved->conflict, 1.0);
}

TEST(BinaryMass, ThousandsOfOpposedSourcesDoNotUnderflow) {
  Masses sources;
  for (int i = 0; i < 2000; ++i) {
    sources.push_back({.9, 0.0, .1});
    sources.push_back({0.0, .9, .1});
  }
  const auto fused = dempster(sources);
  ASSERT_TRUE(fused);
  EXPECT_NEAR(fused->mass.yes, .5, 1e-12);
  EXPECT_NEAR(fused->mass.no, .5, 1e-12);
  EXPECT_NEAR(fused->conflict, 1.0, 1e-12);
  const OpenBinaryMass open = conjunctive(sources);
  EXPECT_EQ(open.unknown, 0.0);
  EXPECT_NEAR(total(open), 1.0, 1e-12);
}

TEST(BinaryMass, NoSourceIsVacuous) {
  EXPECT_EQ(conflict_to_ignorance(Masses{}).mass, BinaryMass::vacuous());
  ASSERT_TRUE(dempster(Masses{}));
  EXPECT_EQ(dempster(Masses{})->mass, BinaryMass::vacuous());
}

TEST(BinaryMass, FromRefusesWhatIsNoMass) {
  EXPECT_EQ(BinaryMass::from(.25, .5), (BinaryMass{.25, .5, .25}));
  EXPECT_EQ(BinaryMass::from(.5, .5 + 1e-12).unknown, 0.0);
  EXPECT_NEAR(total(BinaryMass::from(.5, .5 + 1e-12)), 1.0, 1e-15);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [yes, no] : {std::pair{-1e-3, .5}, {.5, -1e-3}, {.6, .5}, {nan, .1}, {.1, nan}}) {
    EXPECT_THROW((void)BinaryMass::from(yes, no), std::invalid_argument) << yes << ' ' << no;
  }
  try {
    (void)BinaryMass::from(.6, .5);
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("yes = 0.6"), ::testing::HasSubstr("at most 1")));
  }
}

TEST(BinaryMass, PrintsReadably) {
  std::ostringstream text;
  text << BinaryMass{.25, .5, .25};
  EXPECT_EQ(text.str(), "{yes 0.25, no 0.5, unknown 0.25}");
}

}  // namespace
}  // namespace credo::evidence
