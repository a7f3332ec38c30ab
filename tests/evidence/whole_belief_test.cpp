// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/whole_belief.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "evidence/believed.hpp"
#include "evidence/gated_match.hpp"
#include "evidence/joint_existence.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using Masses = std::vector<BinaryMass>;

TEST(WholeBelief, FusesEveryDiscountedPartAtOnce) {
  const Masses criteria{{.5, .1, .4}, {.3, .2, .5}};
  const std::vector<Part> parts{{{.6, .2, .2}, .3}, {{.1, .7, .2}, .6}};
  const Masses sources{criteria[0], criteria[1], discount(parts[0].mass, .3), discount(parts[1].mass, .6)};
  for (const FusionRule rule : {FusionRule::kDempster, FusionRule::kConflictToIgnorance}) {
    const auto whole = whole_from_all_parts(criteria, parts, rule);
    ASSERT_TRUE(whole);
    EXPECT_LT(distance(whole->mass, fuse(sources, rule)->mass), 1e-15);
  }
}

// What speaks against fusing all parts one by one: their number alone moves the belief.
TEST(WholeBelief, TheMeanDoesNotDependOnTheNumberOfEqualParts) {
  const Masses criteria{{.4, .1, .5}};
  const Part part{{.5, .2, .3}, .6};
  const std::vector<Part> few(4, part), many(20, part);
  EXPECT_LT(distance(whole_from_mean_part(criteria, few).mass, whole_from_mean_part(criteria, many).mass), 1e-14);
  EXPECT_GT(whole_from_all_parts(criteria, many, FusionRule::kDempster)->mass.yes, .99);
  EXPECT_LT(whole_from_all_parts(criteria, many, FusionRule::kConflictToIgnorance)->mass.yes,
            whole_from_all_parts(criteria, few, FusionRule::kConflictToIgnorance)->mass.yes - .1);
}

TEST(WholeBelief, ThePartsAreAveragedBeforeTheyAreFused) {
  const std::vector<Part> parts{{{1.0, 0.0, 0.0}, .6}, {{0.0, 1.0, 0.0}, .3}};
  EXPECT_LT(distance(mean_part(parts), {.3, .15, .55}), 1e-15);
  const FusedBinaryMass whole = whole_from_mean_part(Masses{{.5, 0.0, .5}}, parts);
  EXPECT_LT(distance(whole.mass, conflict_to_ignorance({{.5, 0.0, .5}, {.3, .15, .55}}).mass), 1e-15);
  EXPECT_NEAR(whole.conflict, .075, 1e-15);
}

TEST(WholeBelief, WithoutPartsOnlyTheCriteriaSpeak) {
  const Masses criteria{{.4, .1, .5}};
  EXPECT_EQ(mean_part({}), BinaryMass::vacuous());
  EXPECT_LT(distance(whole_from_mean_part(criteria, {}).mass, criteria[0]), 1e-15);
  EXPECT_LT(distance(whole_from_all_parts(criteria, {}, FusionRule::kDempster)->mass, criteria[0]), 1e-15);
}

TEST(WholeBelief, TotalConflictHasNoDempster) {
  const std::vector<Part> parts{{{0.0, 1.0, 0.0}, 1.0}};
  EXPECT_FALSE(whole_from_all_parts(Masses{{1.0, 0.0, 0.0}}, parts, FusionRule::kDempster));
  EXPECT_EQ(whole_from_mean_part(Masses{{1.0, 0.0, 0.0}}, parts).mass, BinaryMass::vacuous());
}

// Two parallel walls of one length: near in angle and length, far apart. The paper tells that the conflict refuses
// them.
TEST(GatedMatch, ParallelWallsAreRefusedByTheirConflict) {
  const GatedMatch walls = gated_match(Masses{{.9, 0.0, .1}, {.6, 0.0, .4}, {0.0, .8, .2}});
  EXPECT_NEAR(walls.mass.conflict, .768, 1e-15);
  EXPECT_GT(walls.mass.yes, walls.mass.no);
  EXPECT_FALSE(walls.match);
  EXPECT_TRUE(gated_match(Masses{{.9, 0.0, .1}, {.6, 0.0, .4}, {0.0, .8, .2}}, .77).match);
}

TEST(GatedMatch, TheLimitPassesAndEqualityDoesNot) {
  // Conflict .7 * 1 = .7, and YES .3 > NO 0.
  EXPECT_TRUE(gated_match(Masses{{1.0, 0.0, 0.0}, {0.0, .7, .3}}).match);
  EXPECT_FALSE(gated_match(Masses{{.3, .3, .4}}).match);
  EXPECT_FALSE(gated_match(Masses{}).match);
  EXPECT_FALSE(gated_match(Masses{{.1 + .2, .3, .4}}).match);
}

TEST(JointExistence, WeakPartsReinforceEachOther) {
  const auto joint = joint_existence({.3, 0.0, .7}, {.4, 0.0, .6}, BinaryMass::vacuous(), FusionRule::kDempster);
  ASSERT_TRUE(joint);
  EXPECT_NEAR(joint->mass.yes, 1.0 - .7 * .6, 1e-15);
  EXPECT_EQ(joint->conflict, 0.0);
}

TEST(JointExistence, ConflictIsThatOfBothSteps) {
  const BinaryMass a{.5, .3, .2}, b{.2, .6, .2}, kind{.7, .1, .2};
  const auto joint = joint_existence(a, b, kind, FusionRule::kDempster);
  const auto at_once = dempster({a, b, kind});
  ASSERT_TRUE(joint && at_once);
  EXPECT_LT(distance(joint->mass, at_once->mass), 1e-15);
  EXPECT_NEAR(joint->conflict, at_once->conflict, 1e-15);
  EXPECT_FALSE(joint_existence({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, kind, FusionRule::kDempster));
}

TEST(Believed, IsAValueWithItsBelief) {
  const Believed<int> seven{7, {.6, .1, .3}};
  EXPECT_EQ(seven, (Believed<int>{7, {.6, .1, .3}}));
  EXPECT_NE(seven, (Believed<int>{7, BinaryMass::vacuous()}));
}

}  // namespace
}  // namespace credo::evidence
