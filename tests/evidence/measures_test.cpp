// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/measures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "evidence/discounting.hpp"
#include "evidence/grid_mass.hpp"
#include "evidence/probability.hpp"
#include "evidence/refinement.hpp"

namespace credo::evidence {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Frame kAbc = Frame::shafer({"A", "B", "C"});
const Frame kAb = Frame::shafer({"A", "B"});
const MassFunction kMass(kAbc, {{"A", 0.5}, {"A ∪ B", 0.3}, {"Θ", 0.2}});

TEST(Measures, BoundWhatIsBelieved) {
  const Proposition a = kAbc.parse("A"), b = kAbc.parse("B"), ab = kAbc.parse("A ∪ B");
  EXPECT_DOUBLE_EQ(belief(kMass, ab), 0.8);
  EXPECT_DOUBLE_EQ(belief(kMass, b), 0.0);
  EXPECT_DOUBLE_EQ(plausibility(kMass, b), 0.5);
  EXPECT_DOUBLE_EQ(commonality(kMass, ab), 0.5);
  EXPECT_DOUBLE_EQ(pignistic(kMass, a), 0.5 + 0.15 + 0.2 / 3.0);
}

TEST(Measures, OnTheFreeModelAnOverlapImpliesBoth) {
  const Frame frame = Frame::free_dsm({"A", "B"});
  const MassFunction mass(frame, {{"A ∩ B", 0.4}, {"A", 0.3}, {"Θ", 0.3}});
  EXPECT_DOUBLE_EQ(belief(mass, frame.parse("A")), 0.7);
  EXPECT_DOUBLE_EQ(belief(mass, frame.parse("B")), 0.4);
  EXPECT_DOUBLE_EQ(plausibility(mass, frame.parse("A ∩ B")), 1.0);
  EXPECT_DOUBLE_EQ(pignistic(mass, frame.parse("A")), 0.4 + 0.3 + 0.3 * 2.0 / 3.0);
}

TEST(Measures, DsmpFollowsWhatTheElementsWereGiven) {
  const MassFunction mass(kAb, {{"A", 0.3}, {"B", 0.1}, {"Θ", 0.6}});
  EXPECT_NEAR(dsmp(mass, kAb.parse("A"), 0.0), 0.75, 1e-15);
  EXPECT_NEAR(dsmp(mass, kAb.parse("A"), 1e9), pignistic(mass, kAb.parse("A")), 1e-9);
  EXPECT_THROW(static_cast<void>(dsmp(mass, kAb.parse("A"), -0.1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(dsmp(mass, kAb.parse("A"), std::nan(""))), std::invalid_argument);
}

TEST(Measures, ALargeEpsilonOfDsmpSharesEqually) {
  const Frame frame = Frame::shafer({"A", "B", "C"});
  const MassFunction mass(frame, {{"A", .2}, {"Θ", .8}});
  for (const double epsilon : {1e20, 1e308}) {
    EXPECT_NEAR(dsmp(mass, frame.parse("A | B"), epsilon), pignistic(mass, frame.parse("A | B")), 1e-12);
    EXPECT_NEAR(dsmp(GridMass::from(.2, .3), GridElement::kEmpty, GridModel::kFree, epsilon),
                pignistic(GridMass::from(.2, .3), GridElement::kEmpty, GridModel::kFree), 1e-12);
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)dsmp(mass, frame.all(), infinity), std::invalid_argument);
  EXPECT_THROW((void)dsmp(GridMass::vacuous(), GridElement::kEmpty, GridModel::kFree, infinity), std::invalid_argument);
}

TEST(Measures, ConflictIsDividedOutOfProbabilities) {
  const MassFunction open(kAb, {{"∅", 0.5}, {"A", 0.25}, {"Θ", 0.25}});
  EXPECT_NEAR(pignistic(open, kAb.parse("A")), 0.75, 1e-15);
  EXPECT_THAT(plausibility_transform(open), ElementsAre(DoubleNear(2.0 / 3.0, 1e-15), DoubleNear(1.0 / 3.0, 1e-15)));
  EXPECT_THAT(pignistic_regions(open), ElementsAre(DoubleEq(0.75), DoubleEq(0.25)));
  const MassFunction nothing = MassFunction::categorical(kAb, {});
  EXPECT_THROW(static_cast<void>(pignistic(nothing, kAb.parse("A"))), std::domain_error);
  EXPECT_THROW(static_cast<void>(pignistic_regions(nothing)), std::domain_error);
  EXPECT_THROW(static_cast<void>(plausibility_transform(nothing)), std::domain_error);
  EXPECT_THROW(static_cast<void>(plausibility_transform(MassFunction::vacuous(Frame::free_dsm({"A", "B"})))),
               std::invalid_argument);
}

TEST(Measures, UncertaintyIsInBits) {
  const MassFunction vacuous = MassFunction::vacuous(Frame::shafer({"A", "B", "C", "D"}));
  EXPECT_DOUBLE_EQ(nonspecificity(vacuous), 2.0);
  EXPECT_DOUBLE_EQ(dissonance(vacuous), 0.0);
  EXPECT_DOUBLE_EQ(strife(vacuous), 0.0);
  EXPECT_DOUBLE_EQ(pignistic_entropy(vacuous), 2.0);
  EXPECT_DOUBLE_EQ(jirousek_shenoy_entropy(vacuous), 4.0);
  const MassFunction coin(kAb, {{"A", 0.5}, {"B", 0.5}});
  EXPECT_DOUBLE_EQ(nonspecificity(coin), 0.0);
  EXPECT_DOUBLE_EQ(dissonance(coin), 1.0);
  EXPECT_DOUBLE_EQ(strife(coin), 1.0);
  EXPECT_DOUBLE_EQ(jirousek_shenoy_entropy(coin), 1.0);
  EXPECT_EQ(strife(MassFunction::categorical(kAb, {})), 0.0);
}

TEST(Measures, DistanceAndConflictAreDifferentThings) {
  const MassFunction coin(kAb, {{"A", 0.5}, {"B", 0.5}});
  EXPECT_DOUBLE_EQ(conflict_between(coin, coin), 0.5);
  EXPECT_DOUBLE_EQ(jousselme_distance(coin, coin), 0.0);
  const MassFunction a = MassFunction::categorical(kAb, kAb.parse("A")),
                     b = MassFunction::categorical(kAb, kAb.parse("B"));
  EXPECT_DOUBLE_EQ(jousselme_distance(a, b), 1.0);
  EXPECT_DOUBLE_EQ(jousselme_distance(a, MassFunction::vacuous(kAb)), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(jousselme_distance(a, MassFunction::categorical(kAb, {})), 1.0);
}

TEST(Decision, TakesTheBestByTheCriterion) {
  const MassFunction mass(kAbc, {{"A", 0.35}, {"B", 0.25}, {"B ∪ C", 0.4}});
  EXPECT_EQ(decide(mass, {.criterion = Criterion::kBelief}).choice, 0u);
  EXPECT_EQ(decide(mass, {.criterion = Criterion::kPlausibility}).choice, 1u);
  const Decision pignistic = decide(mass, {.criterion = Criterion::kPignistic});
  EXPECT_EQ(pignistic.choice, 1u);
  EXPECT_NEAR(pignistic.value, 0.45, 1e-15);
  EXPECT_NEAR(pignistic.margin, 0.1, 1e-15);
  EXPECT_FALSE(pignistic.rejected);
}

TEST(Decision, IsRejectedWhereTooLittleSpeaksForIt) {
  const MassFunction mass(kAbc, {{"A", 0.35}, {"B", 0.25}, {"B ∪ C", 0.4}});
  EXPECT_TRUE(decide(mass, {.min_value = 0.5}).rejected);
  EXPECT_TRUE(decide(mass, {.min_margin = 0.2}).rejected);
  EXPECT_FALSE(decide(mass, {.min_value = 0.4, .min_margin = 0.05}).rejected);
  EXPECT_TRUE(decide(MassFunction::categorical(kAbc, {})).rejected);
  EXPECT_THROW(static_cast<void>(decide(mass, std::span<const Proposition>())), std::invalid_argument);
  const Proposition candidates[] = {kAbc.parse("A"), kAbc.parse("B ∪ C")};
  EXPECT_EQ(decide(mass, candidates).choice, 1u);
  EXPECT_EQ(decide(MassFunction::vacuous(kAbc)).choice, 0u);  // equal ones: the first
}

TEST(Discounting, IsDoneByReliability) {
  EXPECT_EQ(discount(kMass, 1.0), kMass);
  EXPECT_TRUE(discount(kMass, 0.0).is_vacuous());
  EXPECT_NEAR(discount(kMass, 0.5).mass("Θ"), 0.6, 1e-15);
  for (const double wrong : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(discount(kMass, wrong)), std::invalid_argument);
  }
}

TEST(Discounting, DependsOnTheTruthWhereItIsContextual) {
  const MassFunction mass(kAb, {{"A", 0.6}, {"B", 0.3}, {"∅", 0.1}});
  const double reliabilities[] = {0.9, 0.5}, one[] = {1.0}, wrong[] = {0.5, 2.0};
  const MassFunction weaker = contextual_discount(mass, reliabilities);
  EXPECT_NEAR(weaker.mass("A"), 0.5 * (0.6 + 0.1 * 0.1), 1e-15);
  EXPECT_NEAR(weaker.mass("B"), 0.9 * (0.3 + 0.5 * 0.1), 1e-15);
  EXPECT_NEAR(weaker.mass("∅"), 0.9 * 0.5 * 0.1, 1e-15);
  EXPECT_THROW(static_cast<void>(contextual_discount(mass, one)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(contextual_discount(mass, wrong)), std::invalid_argument);
  const Frame free = Frame::free_dsm({"A", "B"});
  EXPECT_THROW(static_cast<void>(contextual_discount(MassFunction::vacuous(free), reliabilities)),
               std::invalid_argument);
}

TEST(Discounting, DecaysWithAge) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(reliability_after(3.0, 3.0), 0.5);
  EXPECT_DOUBLE_EQ(reliability_after(0.0, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(reliability_after(infinity, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(reliability_after(infinity, infinity), 1.0);
  EXPECT_NEAR(jousselme_distance(decay(decay(kMass, 1.0, 3.0), 2.0, 3.0), decay(kMass, 3.0, 3.0)), 0.0, 1e-8);
  EXPECT_THROW(static_cast<void>(reliability_after(-1.0, 3.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(reliability_after(1.0, 0.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(reliability_after(std::nan(""), 1.0)), std::invalid_argument);
}

TEST(Refinement, SaysTheSameInMoreDetail) {
  const Frame fine = Frame::shafer({"a1", "a2", "b"});
  const Refining refining(kAb, fine, {fine.parse("a1 ∪ a2"), fine.parse("b")});
  EXPECT_EQ(fine.to_string(refining.refine(kAb.parse("A"))), "a1 ∪ a2");
  EXPECT_EQ(kAb.to_string(refining.coarsen_outer(fine.parse("a1"))), "A");
  EXPECT_EQ(kAb.to_string(refining.coarsen_inner(fine.parse("a1"))), "∅");
  EXPECT_THROW(static_cast<void>(refine(kMass, refining)), std::invalid_argument);
}

TEST(Refinement, ImagesMustPartitionTheFinerFrame) {
  const Frame fine = Frame::shafer({"a1", "a2", "b"});
  const auto complaint = [&](std::vector<Proposition> images, const char* why) {
    EXPECT_THAT([&] { Refining(kAb, fine, images); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  };
  complaint({fine.parse("a1")}, "one image for each of the 2 elements");
  complaint({fine.parse("a1 ∪ a2"), Proposition()}, "image of 'B' is empty");
  complaint({fine.parse("a1 ∪ a2"), fine.parse("a2 ∪ b")}, "overlaps");
  complaint({fine.parse("a1"), fine.parse("b")}, "leave out a2");
  EXPECT_THROW(Refining(kAb, Frame::free_dsm({"a", "b"}), {}), std::invalid_argument);
}

TEST(ProductFrame, HasAllCombinations) {
  const Frame size = Frame::shafer({"small", "large"});
  const ProductFrame product({size, kAbc});
  EXPECT_EQ(product.size(), 2u);
  EXPECT_EQ(product.frame().size(), 6u);
  EXPECT_EQ(product.frame().name(3), "large × A");
  const MassFunction joint = product.extend(MassFunction::categorical(size, size.parse("large")), 0);
  EXPECT_EQ(joint.mass("large × A ∪ large × B ∪ large × C"), 1.0);
  EXPECT_TRUE(product.marginal(joint, 1).is_vacuous());
  EXPECT_THROW(ProductFrame({}), std::invalid_argument);
  EXPECT_THROW(ProductFrame({size, Frame::free_dsm({"A"})}), std::invalid_argument);
  EXPECT_THROW(ProductFrame(std::vector<Frame>(9, size)), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evidence
