// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/mass_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>

#include "evidence/discounting.hpp"
#include "evidence/measures.hpp"
#include "evidence/moebius.hpp"

namespace credo::evidence {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Frame kAbc = Frame::shafer({"A", "B", "C"});

TEST(MassFunction, IsMadeOfPropositionsInAnyOrder) {
  const MassFunction mass(kAbc, {{"A ∪ B", 0.25}, {"A", 0.5}, {"B | A", 0.25}, {"C", 0.0}});
  EXPECT_EQ(mass.focals().size(), 2u);
  EXPECT_EQ(mass.mass("A ∪ B"), 0.5);
  EXPECT_EQ(mass.mass("A"), 0.5);
  EXPECT_EQ(mass.mass("C"), 0.0);
  EXPECT_EQ(mass, MassFunction(kAbc, {{"A", 0.5}, {"A ∪ B", 0.5}}));
}

TEST(MassFunction, WhatIsNoneIsRefusedWithTheReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto complaint = [](double a, double b, const char* why) {
    EXPECT_THAT(
        [&] {
          MassFunction(kAbc, {{"A", a}, {"A ∪ B", b}});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  };
  complaint(0.5, 0.4, "sum to 0.9");
  complaint(-0.1, 1.1, "m(A) = -0.1");
  complaint(0.5, nan, "m(A ∪ B) = nan");
  complaint(1.5, 0.0, "m(A) = 1.5");
  complaint(std::numeric_limits<double>::infinity(), 0.0, "m(A) = inf");
  EXPECT_THROW(MassFunction(kAbc, {{"A ∪ D", 1.0}}), std::invalid_argument);
  EXPECT_THROW(MassFunction(kAbc, {}), std::invalid_argument);
}

TEST(MassFunction, SumsWithinTheToleranceAreDividedOut) {
  const MassFunction mass(kAbc, {{"A", 0.5 + 5e-10}, {"B", 0.5}});
  EXPECT_NEAR(mass.mass("A") + mass.mass("B"), 1.0, 1e-15);
  EXPECT_THROW(MassFunction(kAbc, {{"A", 0.5 + 2e-9}, {"B", 0.5}}), std::invalid_argument);
}

TEST(MassFunction, TheRestIsUnknownOnRequest) {
  const MassFunction mass = MassFunction::with_rest_unknown(kAbc, {{"A", 0.3}, {"B ∪ C", 0.2}});
  EXPECT_DOUBLE_EQ(mass.mass("Θ"), 0.5);
  EXPECT_THROW(MassFunction::with_rest_unknown(kAbc, {{"A", 0.8}, {"B", 0.3}}), std::invalid_argument);
}

TEST(MassFunction, IsRestoredToTheLastBit) {
  // The sum of these is not 1 in double: dividing by it again would change them.
  const MassFunction mass(kAbc, {{"A", 0.7}, {"B", 0.1}, {"A ∪ B", 0.1}, {"C", 0.1}});
  const MassFunction rounded = discount(mass, 1.0 / 3.0);
  EXPECT_EQ(MassFunction::restored(kAbc, rounded.focals()), rounded);
  EXPECT_EQ(MassFunction::restored(kAbc, mass.focals()), mass);

  const Focal unordered[] = {{kAbc.parse("B"), 0.5}, {kAbc.parse("A"), 0.5}};
  EXPECT_THROW((void)MassFunction::restored(kAbc, unordered), std::invalid_argument);
  const Focal no_mass[] = {{kAbc.parse("B"), 0.5}};
  EXPECT_THROW((void)MassFunction::restored(kAbc, no_mass), std::invalid_argument);
}

TEST(MassFunction, HasItsSpecialKinds) {
  const MassFunction vacuous = MassFunction::vacuous(kAbc);
  EXPECT_TRUE(vacuous.is_vacuous() && vacuous.is_categorical() && !vacuous.is_dogmatic() && vacuous.is_consonant());

  const MassFunction simple = MassFunction::simple_support(kAbc, kAbc.parse("A ∪ B"), 0.7);
  EXPECT_DOUBLE_EQ(simple.mass("A ∪ B"), 0.7);
  EXPECT_TRUE(simple.is_consonant() && !simple.is_bayesian() && simple.is_normal());

  const double probabilities[] = {0.2, 0.5, 0.3};
  const MassFunction bayesian = MassFunction::bayesian(kAbc, probabilities);
  EXPECT_TRUE(bayesian.is_bayesian() && bayesian.is_dogmatic() && !bayesian.is_consonant());
  EXPECT_EQ(bayesian.mass("B"), 0.5);

  const MassFunction open(kAbc, {{"∅", 0.4}, {"A", 0.6}});
  EXPECT_EQ(open.conflict(), 0.4);
  EXPECT_FALSE(open.is_normal());

  EXPECT_THROW(MassFunction::simple_support(kAbc, kAbc.parse("A"), 1.2), std::invalid_argument);
  EXPECT_THROW(MassFunction::bayesian(kAbc, std::span(probabilities, 2)), std::invalid_argument);
  EXPECT_THROW(MassFunction::bayesian(Frame::free_dsm({"A", "B", "C"}), probabilities), std::invalid_argument);
}

TEST(MassFunction, ConsonantOnesHaveTheirContourAsPlausibility) {
  const double contour[] = {0.4, 1.0, 0.9};
  const MassFunction mass = MassFunction::consonant(kAbc, contour);
  EXPECT_TRUE(mass.is_consonant());
  EXPECT_THAT(mass.mass("B"), DoubleNear(0.1, 1e-15));
  EXPECT_THAT(mass.mass("B ∪ C"), DoubleNear(0.5, 1e-15));
  EXPECT_THAT(mass.mass("Θ"), DoubleNear(0.4, 1e-15));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(plausibility(mass, kAbc.element(i)), contour[i], 1e-15);
  const double subnormal[] = {0.4, 0.8, 0.9};
  EXPECT_THAT([&] { static_cast<void>(MassFunction::consonant(kAbc, subnormal)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("got 0.9")));
  const double negative[] = {-0.4, 1.0, 0.9};
  EXPECT_THAT([&] { static_cast<void>(MassFunction::consonant(kAbc, negative)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("plausibility of A")));
}

TEST(MassFunction, NormalisingDividesByTheSumOfTheRest) {
  const double tiny = 1e-13;
  const std::optional<Fused> fused = normalised(MassFunction(kAbc, {{"∅", 1.0 - 2 * tiny}, {"A", tiny}, {"B", tiny}}));
  ASSERT_TRUE(fused.has_value());
  EXPECT_NEAR(fused->mass.mass("A"), 0.5, 1e-12);
  EXPECT_NEAR(fused->conflict, 1.0, 1e-12);
  EXPECT_FALSE(normalised(MassFunction::categorical(kAbc, {})).has_value());
}

TEST(MassFunction, NormalisingKeepsARestBelowTheSmallestNormalNumber) {
  const std::optional<Fused> rest = normalised(MassFunction(Frame::shafer({"A", "B"}), {{"A", 1e-310}, {"∅", 1.0}}));
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->mass.mass("A"), 1.0);
}

TEST(MassFunction, ConstraintsMakeMassEmptyButRememberItsForm) {
  const std::string empty[] = {"A ∩ B"};
  const Frame frame = Frame::hybrid({"A", "B"}, empty);
  const MassFunction mass(frame, {{"A ∩ B", 0.5}, {"A", 0.5}});
  EXPECT_EQ(mass.conflict(), 0.5);
  EXPECT_EQ(frame.to_string(frame.composing(mass.focals()[0].set)), "Θ");
}

TEST(MassFunction, ConvertsToTheBinaryFormAndBack) {
  const Frame frame = Frame::shafer({"YES", "NO"});
  const BinaryMass binary{.yes = 0.5, .no = 0.125, .unknown = 0.375};
  EXPECT_EQ(to_binary(from_binary(frame, binary)), binary);
  EXPECT_THROW(static_cast<void>(from_binary(kAbc, binary)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(to_binary(MassFunction::vacuous(kAbc))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(to_binary(MassFunction(frame, {{"∅", 1.0}}))), std::invalid_argument);
}

TEST(MassFunction, PrintsReadably) {
  std::ostringstream text;
  text << MassFunction(kAbc, {{"A ∪ B", 0.25}, {"A", 0.5}, {"Θ", 0.25}});
  EXPECT_EQ(text.str(), "{A: 0.5, A ∪ B: 0.25, Θ: 0.25}");
}

TEST(MassFunction, DifferentFramesAreNotCombined) {
  EXPECT_THROW((Sources{MassFunction::vacuous(kAbc), MassFunction::vacuous(Frame::shafer({"A", "B"}))}.common_frame()),
               std::invalid_argument);
  EXPECT_THROW(Sources(std::vector<MassFunction>{}).common_frame(), std::invalid_argument);
}

TEST(Moebius, TransformsAreTheSumsOverSubsetsAndTheirInverses) {
  const MassFunction mass(kAbc, {{"∅", 0.1}, {"A", 0.2}, {"B ∪ C", 0.3}, {"Θ", 0.4}});
  const std::vector<double> dense = to_dense(mass);
  std::vector<double> q = dense, b = dense;
  mass_to_commonality(q);
  mass_to_implicability(b);
  for (std::uint64_t bits = 0; bits < 8; ++bits) {
    EXPECT_NEAR(q[bits], commonality(mass, Proposition::from_bits(bits)), 1e-15);
    EXPECT_NEAR(b[bits], implicability(mass, Proposition::from_bits(bits)), 1e-15);
  }
  commonality_to_mass(q);
  implicability_to_mass(b);
  for (std::uint64_t bits = 0; bits < 8; ++bits) {
    EXPECT_NEAR(q[bits], dense[bits], 1e-15);
    EXPECT_NEAR(b[bits], dense[bits], 1e-15);
  }
}

TEST(Moebius, DenseFormsAreCheckedAsMassFunctionsAre) {
  const MassFunction mass(kAbc, {{"A", 0.2}, {"B ∪ C", 0.8}});
  std::vector<double> dense = to_dense(mass);
  EXPECT_EQ(from_dense(kAbc, dense), mass);
  dense[0] = -1e-3;
  EXPECT_THROW(static_cast<void>(from_dense(kAbc, dense)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(from_dense(kAbc, std::span(dense).first(4))), std::invalid_argument);
  std::vector<double> q = to_dense(mass);
  mass_to_commonality(q);
  EXPECT_EQ(from_commonality(kAbc, q)->mass("A"), 0.2);
  q[1] = 1.5;  // A more common than ∅
  EXPECT_EQ(from_commonality(kAbc, q), std::nullopt);
  q[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(from_commonality(kAbc, q), std::nullopt);
  EXPECT_THROW(static_cast<void>(from_commonality(kAbc, {1.0, 1.0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(to_dense(MassFunction::vacuous(Frame::free_dsm({"A", "B"})))), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evidence
