// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/readout.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::grids {
namespace {

using evidence::FixedLogCommonality;

FixedLogCommonality evidence_of(int empty, int occupied) {
  const FixedLogCommonality seen_empty = evidence::quantise(evidence::log_commonality({0.9, 0.05, 0.0, 0.05}, 0.95));
  const FixedLogCommonality seen_occupied = evidence::quantise(evidence::log_commonality({0.05, 0.9, 0.0, 0.05}, 0.95));
  FixedLogCommonality cell;
  for (int i = 0; i < empty; ++i) cell += seen_empty;
  for (int i = 0; i < occupied; ++i) cell += seen_occupied;
  return cell;
}

TEST(Decide, GivesEachCellItsState) {
  EXPECT_EQ(decide(FixedLogCommonality{}), CellState::kUnknown);
  EXPECT_EQ(decide(evidence_of(1, 0)), CellState::kEmpty);
  EXPECT_EQ(decide(evidence_of(0, 1)), CellState::kOccupied);
  EXPECT_EQ(decide(evidence_of(20, 20)), CellState::kContested);
  EXPECT_EQ(decide(evidence_of(300, 2)), CellState::kEmpty);
  EXPECT_EQ(decide(evidence_of(2, 300)), CellState::kOccupied);
}

TEST(Decide, WeakEvidenceStaysUnknown) {
  const FixedLogCommonality weak = evidence::quantise(evidence::log_commonality({0.9, 0.0, 0.0, 0.1}, 0.2));
  EXPECT_EQ(decide(weak), CellState::kUnknown);
  EXPECT_EQ(decide(weak, {.unknown_above = 0.9, .occupied_from = 0.65, .empty_until = 0.45, .contested_from = 0.8}),
            CellState::kEmpty);
}

TEST(Decide, OneSidedEvidenceIsNotContestedForATraceOfTheOther) {
  const FixedLogCommonality half_empty = evidence::quantise(evidence::log_commonality({0.55, 0.03, 0.0, 0.42}, 0.95));
  EXPECT_EQ(decide(half_empty), CellState::kUnknown);
  const FixedLogCommonality both = evidence::quantise(evidence::log_commonality({0.4, 0.3, 0.0, 0.3}, 0.95));
  EXPECT_EQ(decide(both), CellState::kContested);
}

TEST(Layer, ReadsARectangleLowestRowFirst) {
  EvidentialGrid grid;
  grid.add({-1, 0}, evidence_of(1, 0));
  grid.add({64, 1}, evidence_of(0, 1));
  const CellBox box = grid.bounding_box();
  ASSERT_EQ(box, (CellBox{{-1, 0}, 66, 2}));
  const std::vector<float> unknown = layer(grid, box, Layer::kUnknown);
  ASSERT_EQ(unknown.size(), 132u);
  EXPECT_LT(unknown.front(), 0.2F);
  EXPECT_LT(unknown.back(), 0.2F);
  EXPECT_EQ(unknown[1], 1.0F);
  EXPECT_EQ(layer(grid, box, Layer::kProbabilityOccupied)[1], 0.5F);
}

TEST(Layer, MassesOfACellSumToOne) {
  EvidentialGrid grid;
  grid.add({0, 0}, evidence_of(3, 2));
  const auto one = [&](Layer which) { return layer(grid, {{0, 0}, 1, 1}, which).front(); };
  EXPECT_NEAR(one(Layer::kEmpty) + one(Layer::kOccupied) + one(Layer::kUnknown), 1.0, 1e-6);
  EXPECT_NEAR(one(Layer::kRawEmpty) + one(Layer::kRawOccupied) + one(Layer::kRawUnknown) + one(Layer::kRawConflict),
              1.0, 1e-6);
  EXPECT_GT(one(Layer::kRawConflict), 0.9F);
  EXPECT_GT(one(Layer::kContested), 0.5F);
  // Dempster's ratio of the masses is that of the raw ones.
  EXPECT_NEAR(one(Layer::kEmpty) / one(Layer::kOccupied), one(Layer::kRawEmpty) / one(Layer::kRawOccupied), 1e-3);
}

TEST(Layer, ReadOutsOfOccupiedLieBetweenBeliefAndPlausibility) {
  EvidentialGrid grid;
  int x = 0;
  for (const auto& [empty, occupied] : {std::pair{0, 0}, {1, 0}, {0, 1}, {3, 2}, {1, 4}, {20, 20}, {300, 0}})
    grid.add({x++, 0}, evidence_of(empty, occupied));
  const CellBox box{{0, 0}, x, 1};
  const auto belief = layer(grid, box, Layer::kOccupied), plausibility = layer(grid, box, Layer::kPlausibilityOccupied),
             pignistic = layer(grid, box, Layer::kProbabilityOccupied), dsmp = layer(grid, box, Layer::kDsmpOccupied);
  for (std::size_t i = 0; i < belief.size(); ++i) {
    EXPECT_GE(pignistic[i], belief[i]) << i;
    EXPECT_LE(pignistic[i], plausibility[i]) << i;
    EXPECT_GE(dsmp[i], belief[i] - 1e-6F) << i;
    EXPECT_LE(dsmp[i], plausibility[i] + 1e-6F) << i;
  }
  EXPECT_EQ(plausibility.front(), 1.0F);
  EXPECT_EQ(dsmp.front(), 0.5F);
  EXPECT_LT(dsmp[1], pignistic[1]);  // the ignorance goes where the masses are
  EXPECT_GT(dsmp[2], pignistic[2]);
}

TEST(Layer, ReadsABoxThatIsPartlyOutside) {
  EvidentialGrid grid;
  grid.add({63, 63}, evidence_of(1, 0));
  const auto states = decisions(grid, {{62, 62}, 4, 3});
  ASSERT_EQ(states.size(), 12u);
  for (std::size_t i = 0; i < states.size(); ++i)
    EXPECT_EQ(states[i], i == 5 ? CellState::kEmpty : CellState::kUnknown) << i;
}

TEST(Layer, RefusesAPictureThatIsTooLarge) {
  EvidentialGrid grid;
  grid.add({0, 0}, evidence_of(1, 0));
  grid.add({1 << 27, 1 << 27}, evidence_of(1, 0));
  EXPECT_EQ(grid.tiles().size(), 2u);
  EXPECT_THROW(static_cast<void>(layer(grid, grid.bounding_box(), Layer::kEmpty)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(picture_box(grid)), std::invalid_argument);
  EXPECT_TRUE(layer(grid, CellBox{}, Layer::kEmpty).empty());
}

TEST(PictureBox, IsThatOfTheEvidenceOrACell) {
  EvidentialGrid grid;
  EXPECT_EQ(picture_box(grid), (CellBox{{0, 0}, 1, 1}));
  grid.add({-3, 7}, evidence_of(1, 0));
  grid.add({0, 9}, evidence_of(1, 0));
  EXPECT_EQ(picture_box(grid), (CellBox{{-3, 7}, 4, 3}));
}

TEST(CellStateNames, AreWords) {
  EXPECT_STREQ(to_string(CellState::kUnknown), "unknown");
  EXPECT_STREQ(to_string(CellState::kEmpty), "empty");
  EXPECT_STREQ(to_string(CellState::kOccupied), "occupied");
  EXPECT_STREQ(to_string(CellState::kContested), "contested");
}

}  // namespace
}  // namespace credo::grids
