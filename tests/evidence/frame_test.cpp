// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace credo::evidence {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Frame kAbcShafer = Frame::shafer({"A", "B", "C"});
const Frame kAbcFree = Frame::free_dsm({"A", "B", "C"});

Frame with_constraints(const std::vector<std::string>& empty) { return Frame::hybrid({"A", "B", "C"}, empty); }

std::vector<std::string> letters(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back("e" + std::to_string(i));
  return names;
}

TEST(Proposition, SetAlgebraWorksAcrossWords) {
  const Proposition low = Proposition::first(3), high = Proposition::region(200), most = Proposition::first(256);
  EXPECT_EQ((low | high).count(), 4u);
  EXPECT_TRUE((low & high).empty());
  EXPECT_EQ((low | high) - low, high);
  EXPECT_TRUE((low | high).subset_of(most));
  EXPECT_FALSE(high.subset_of(Proposition::first(200)));
  EXPECT_TRUE(high.subset_of(Proposition::first(201)));
  EXPECT_TRUE(high.contains(200));
  EXPECT_TRUE(high.meets(most));
  EXPECT_LT(low, high);
  EXPECT_LT(Proposition(), low);
  EXPECT_EQ(Proposition::first(64).low_bits(), ~std::uint64_t{0});
  EXPECT_EQ(most.count(), 256u);
}

TEST(Frame, PropositionsAreReadAndWritten) {
  struct Case {
    const Frame& frame;
    const char* text;
    const char* written;
  };
  const Frame exclusive = with_constraints({"A ∩ B"});
  for (const auto& [frame, text, written] : std::vector<Case>{{kAbcFree, "A ∩ B ∪ C", "A ∩ B ∪ C"},
                                                              {kAbcFree, "C|A&B", "A ∩ B ∪ C"},
                                                              {kAbcFree, " ( A ∪ C ) ∩ B ", "A ∩ B ∪ B ∩ C"},
                                                              {kAbcFree, "A ∪ A ∩ B", "A"},
                                                              {kAbcFree, "A ∪ B ∪ C", "Θ"},
                                                              {kAbcFree, "∅", "∅"},
                                                              {kAbcFree, "Θ ∩ A", "A"},
                                                              {kAbcShafer, "A ∪ C", "A ∪ C"},
                                                              {kAbcShafer, "A ∩ B ∪ C", "C"},
                                                              {kAbcShafer, "¬A", "B ∪ C"},
                                                              {kAbcShafer, "~(A ∪ B) ∪ A", "A ∪ C"},
                                                              {exclusive, "A ∩ B", "∅"},
                                                              {exclusive, "A ∩ (B ∪ C)", "A ∩ C"}}) {
    EXPECT_EQ(frame.to_string(frame.parse(text)), written) << text;
  }
}

TEST(Frame, WhatCannotBeReadIsExplained) {
  const auto complaint = [](const Frame& frame, const char* text, const char* why) {
    EXPECT_THAT([&] { static_cast<void>(frame.parse(text)); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why)))
        << text;
  };
  complaint(kAbcFree, "A ∪ D", "no element 'D'; it has: A, B, C");
  complaint(kAbcFree, "A ∪", "expected an element at ''");
  complaint(kAbcFree, "", "expected an element");
  complaint(kAbcFree, "(A ∪ B", "expected )");
  complaint(kAbcFree, "A) ∪ B", "expected ∪, ∩ or the end at ') ∪ B'");
  complaint(kAbcFree, "¬A", "complement");
  complaint(kAbcFree, std::string(100'000, '(').c_str(), "at most 1000 levels");
  complaint(Frame::shafer({"A"}), (std::string(100'000, '~') + "A").c_str(), "at most 1000 levels");
}

TEST(Frame, NamesThatCannotBeReadAreRefused) {
  const auto complaint = [](const std::vector<std::string>& names, const char* why) {
    EXPECT_THAT([&] { static_cast<void>(Frame::shafer(names)); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  };
  complaint({}, "at least one");
  complaint({"A", ""}, "element 2");
  complaint({"A", "A"}, "twice");
  complaint({"A∩B"}, "operator");
  complaint({"A|B"}, "operator");
  complaint({" A"}, "space");
  complaint({"Θ"}, "every frame");
  complaint(letters(257), "at most 256");
  EXPECT_THAT([] { static_cast<void>(Frame::free_dsm(letters(9))); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("at most 8")));
  EXPECT_EQ(Frame::shafer({"no obstacle", "wall"}).to_string(Proposition::first(1)), "no obstacle");
}

TEST(Frame, HyperPowerSetsHaveDedekindsSizes) {
  const std::size_t sizes[] = {1, 4, 18, 166, 7579};
  for (std::size_t n = 1; n <= 5; ++n) {
    EXPECT_EQ(Frame::free_dsm(letters(n)).propositions().size(), sizes[n - 1]) << n;
    EXPECT_EQ(Frame::shafer(letters(n)).propositions().size(), (1u << n) - 1) << n;
  }
  EXPECT_THROW(static_cast<void>(Frame::free_dsm(letters(6)).propositions()), std::length_error);
  EXPECT_THROW(static_cast<void>(Frame::shafer(letters(21)).propositions()), std::length_error);
}

TEST(Frame, AllExclusionsMakeAPowerSetOfAHyperPowerSet) {
  const Frame all_exclusive = with_constraints({"A ∩ B", "A ∩ C", "B ∩ C"});
  EXPECT_EQ(all_exclusive.propositions().size(), 7u);
  EXPECT_EQ(all_exclusive.cardinality(all_exclusive.parse("A ∪ B")), 2u);
  EXPECT_EQ(kAbcFree.cardinality(kAbcFree.parse("A ∪ B")), 6u);
}

TEST(Frame, WhatDoesNotExistIsEmpty) {
  const Frame without_c = with_constraints({"C"});
  EXPECT_EQ(without_c.propositions().size(), 4u);  // of {A, B} that may overlap
  EXPECT_EQ(without_c.to_string(without_c.parse("C")), "∅");
  EXPECT_EQ(without_c.to_string(without_c.all()), "Θ");
  EXPECT_EQ(without_c.existing(without_c.all()), without_c.existing(without_c.parse("A ∪ B")));
  EXPECT_THROW(static_cast<void>(with_constraints({"A", "B ∪ C"})), std::invalid_argument);
}

TEST(Frame, EveryPropositionIsReadBackAsWritten) {
  const Frame exclusive = with_constraints({"A ∩ B"});
  for (const Frame& frame : {kAbcShafer, kAbcFree, exclusive, with_constraints({"B"})}) {
    for (const Proposition& set : frame.propositions()) {
      EXPECT_EQ(frame.existing(frame.parse(frame.to_string(set))), frame.existing(set)) << frame.to_string(set);
    }
  }
}

TEST(Frame, PropositionsAreComposedOfElements) {
  const auto composing = [](const Frame& frame, const char* text) {
    return frame.to_string(frame.composing(frame.parse(text)));
  };
  EXPECT_EQ(composing(kAbcFree, "A ∩ B"), "A ∪ B");
  EXPECT_EQ(composing(kAbcFree, "A ∩ B ∪ A"), "A");
  EXPECT_EQ(composing(kAbcShafer, "A ∪ B"), "A ∪ B");
  EXPECT_EQ(composing(with_constraints({"A ∩ B"}), "A ∩ B"), "A ∪ B");  // though it is empty
}

TEST(Frame, SetsThatAreNoPropositionAreRefused) {
  EXPECT_THROW(static_cast<void>(kAbcFree.admitted(Proposition::region(0))),
               std::invalid_argument);  // A without overlaps
  EXPECT_THROW(static_cast<void>(kAbcShafer.admitted(Proposition::region(3))), std::invalid_argument);
  const Frame exclusive = with_constraints({"A ∩ B", "A ∩ C", "B ∩ C"});
  EXPECT_EQ(exclusive.admitted(exclusive.existing(exclusive.parse("A"))), exclusive.canonical(exclusive.parse("A")));
}

TEST(Frame, EqualFramesAreOfEqualNamesAndRegions) {
  EXPECT_EQ(kAbcFree, Frame::free_dsm({"A", "B", "C"}));
  EXPECT_EQ(kAbcFree, with_constraints({}));
  EXPECT_FALSE(kAbcFree == kAbcShafer);
  EXPECT_FALSE(kAbcShafer == Frame::shafer({"A", "B", "D"}));
  EXPECT_FALSE(with_constraints({"A"}) == with_constraints({"B"}));
}

}  // namespace
}  // namespace credo::evidence
