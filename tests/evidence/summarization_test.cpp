// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/summarization.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "evidence/measures.hpp"
#include "tests/evidence/random_mass_functions.hpp"

namespace credo::evidence {
namespace {

const Frame kAbcd = Frame::shafer({"A", "B", "C", "D"});

TEST(Summarization, KeepsTheLargestMassesAndUnitesTheRest) {
  const MassFunction mass(kAbcd, {{"A", 0.5}, {"B", 0.25}, {"C", 0.125}, {"C ∪ D", 0.125}});
  EXPECT_EQ(summarized(mass, 3), MassFunction(kAbcd, {{"A", 0.5}, {"B", 0.25}, {"C ∪ D", 0.25}}));
  EXPECT_EQ(summarized(mass, 2), MassFunction(kAbcd, {{"A", 0.5}, {"B ∪ C ∪ D", 0.5}}));
  EXPECT_TRUE(summarized(mass, 1).is_vacuous());
  EXPECT_EQ(summarized(mass, 4), mass);
  EXPECT_THROW(static_cast<void>(summarized(mass, 0)), std::invalid_argument);
}

TEST(Summarization, LeavesTheConflictWhereItIs) {
  const MassFunction mass(kAbcd, {{"∅", 0.25}, {"A", 0.5}, {"B", 0.25}});
  EXPECT_EQ(summarized(mass, 1), MassFunction(kAbcd, {{"∅", 0.25}, {"A ∪ B", 0.75}}));
}

RC_GTEST_PROP(SummarizationLaws, SaysNeverMore, ()) {
  const MassFunction mass = (*random_sources(1, {.frames = all_frames()})).front();
  const std::vector<Proposition>& sets = propositions_of(mass.frame());
  const Proposition set = sets[*rc::gen::resize(100, rc::gen::inRange<std::size_t>(0, sets.size()))];
  const std::size_t most = *rc::gen::inRange<std::size_t>(1, 5);
  const MassFunction less = summarized(mass, most);
  RC_ASSERT(less.focals().size() <= most);
  RC_ASSERT(belief(less, set) <= belief(mass, set) + 1e-12);
  RC_ASSERT(plausibility(less, set) >= plausibility(mass, set) - 1e-12);
}

}  // namespace
}  // namespace credo::evidence
