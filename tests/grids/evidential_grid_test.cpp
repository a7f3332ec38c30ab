// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/evidential_grid.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "grids/readout.hpp"

namespace credo::grids {
namespace {

using evidence::FixedLogCommonality;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const FixedLogCommonality kSeenEmpty = evidence::quantise(evidence::log_commonality({0.9, 0.05, 0.0, 0.05}, 0.95));
const FixedLogCommonality kSeenOccupied = evidence::quantise(evidence::log_commonality({0.05, 0.9, 0.0, 0.05}, 0.95));

struct Contribution {
  CellIndex cell;
  FixedLogCommonality increment;
};

std::vector<Contribution> contributions(std::mt19937& random, int count, std::int32_t spread) {
  std::uniform_int_distribution<std::int32_t> place(-spread, spread), strength(-3 << 20, 0);
  std::vector<Contribution> result;
  for (int i = 0; i < count; ++i) {
    const std::int32_t empty = strength(random), occupied = strength(random);
    result.push_back({{place(random), place(random)}, {empty, occupied, std::min(empty, occupied)}});
  }
  return result;
}

EvidentialGrid grid_of(const std::vector<Contribution>& all) {
  EvidentialGrid grid;
  for (const Contribution& one : all) grid.add(one.cell, one.increment);
  return grid;
}

RC_GTEST_PROP(EvidentialGridLaws, TheOrderOfEvidenceDoesNotMatterToTheBit, (unsigned seed)) {
  std::mt19937 random(seed);
  std::vector<Contribution> all = contributions(random, 200, 100);
  const EvidentialGrid first = grid_of(all);
  std::shuffle(all.begin(), all.end(), random);
  RC_ASSERT(grid_of(all) == first);
}

RC_GTEST_PROP(EvidentialGridLaws, MergingIsTheSameAsMappingTogether, (unsigned seed)) {
  std::mt19937 random(seed);
  const auto a = contributions(random, 100, 150), b = contributions(random, 100, 150),
             c = contributions(random, 50, 150);
  std::vector<Contribution> all = a;
  all.insert(all.end(), b.begin(), b.end());
  all.insert(all.end(), c.begin(), c.end());

  EvidentialGrid left = grid_of(a);  // (a + b) + c
  left.merge(grid_of(b));
  left.merge(grid_of(c));
  EvidentialGrid right = grid_of(c);  // c + (b + a)
  EvidentialGrid inner = grid_of(b);
  inner.merge(grid_of(a));
  right.merge(inner);
  RC_ASSERT(left == grid_of(all));
  RC_ASSERT(left == right);
}

RC_GTEST_PROP(EvidentialGridLaws, RemovingRestores, (unsigned seed)) {
  std::mt19937 random(seed);
  const EvidentialGrid mine = grid_of(contributions(random, 100, 150)),
                       other = grid_of(contributions(random, 100, 150));
  EvidentialGrid merged = mine;
  merged.merge(other);
  RC_ASSERT(!(merged == mine));
  merged.remove(other);
  RC_ASSERT(merged == mine);
  RC_ASSERT(merged.tiles().size() == mine.tiles().size());
}

TEST(EvidentialGrid, IsVacuousWhereNothingWasAdded) {
  EvidentialGrid grid;
  EXPECT_TRUE(grid.bounding_box().empty());
  EXPECT_EQ(grid.at({-1'000'000, 7}), FixedLogCommonality{});
  EXPECT_TRUE(grid.tiles().empty());
  grid.add({-1, 64}, kSeenEmpty);
  EXPECT_EQ(grid.at({-1, 64}), kSeenEmpty);
  EXPECT_EQ(grid.at({0, 64}), FixedLogCommonality{});
  EXPECT_EQ(grid.tiles().size(), 1u);
}

TEST(EvidentialGrid, IsAValue) {
  EvidentialGrid a;
  a.add({1, 2}, kSeenEmpty);
  EvidentialGrid b = a;
  EXPECT_EQ(a, b);
  b.add({1, 2}, kSeenOccupied);
  EXPECT_FALSE(a == b);
  EXPECT_EQ(a.at({1, 2}), kSeenEmpty);
}

TEST(EvidentialGrid, AVacuousTileEqualsAnAbsentOne) {
  EvidentialGrid a, b;
  static_cast<void>(a.tile({3, -4}));
  EXPECT_EQ(a, b);
  a.prune();
  EXPECT_TRUE(a.tiles().empty());
}

TEST(EvidentialGrid, BoundsItsEvidenceAcrossTiles) {
  EvidentialGrid grid;
  grid.add({-70, 5}, kSeenEmpty);
  grid.add({130, -3}, kSeenOccupied);
  EXPECT_EQ(grid.bounding_box(), (CellBox{{-70, -3}, 201, 9}));
}

TEST(EvidentialGrid, RefusesToMergeOtherCells) {
  EvidentialGrid fine(Georeference{.resolution_m = 0.05}), coarse(Georeference{.resolution_m = 0.1});
  EvidentialGrid shifted(Georeference{.resolution_m = 0.05, .origin_x_m = 0.01});
  EXPECT_THROW(fine.merge(coarse), std::invalid_argument);
  EXPECT_THROW(fine.merge(shifted), std::invalid_argument);
  EXPECT_THROW(fine.remove(coarse), std::invalid_argument);
}

TEST(EvidentialGrid, RefusesToTakeOutWhatWasNeverMerged) {
  EvidentialGrid mine, other, elsewhere;
  mine.add({0, 0}, kSeenEmpty);
  other.add({0, 0}, kSeenOccupied);
  elsewhere.add({1000, 0}, kSeenEmpty);
  const EvidentialGrid before = mine;
  EXPECT_THROW(mine.remove(other), std::invalid_argument);
  EXPECT_THROW(mine.remove(elsewhere), std::invalid_argument);
  EXPECT_EQ(mine, before);
}

TEST(EvidentialGrid, MergingStopsAtTheFloorAsAddingDoes) {
  const FixedLogCommonality half{-(1 << 30), 0, -(1 << 30) - 5};
  EvidentialGrid added, merged, one;
  one.add({0, 0}, half);
  for (int i = 0; i < 3; ++i) {
    added.add({0, 0}, half);
    merged.merge(one);
  }
  EXPECT_TRUE(added.at({0, 0}).saturated());
  EXPECT_EQ(added, merged);
}

TEST(EvidentialGrid, ReportsTilesThatReachTheEndOfTheirRange) {
  EvidentialGrid grid;
  for (int i = 0; i < 444; ++i) grid.add({70, 3}, evidence::fixed_increment({1.0, 0.0, 0.0, 0.0}, 1.0));
  grid.add({-1, -1}, kSeenEmpty);
  EXPECT_TRUE(grid.saturated_tiles().empty());
  grid.add({70, 3}, evidence::fixed_increment({1.0, 0.0, 0.0, 0.0}, 1.0));
  ASSERT_EQ(grid.saturated_tiles().size(), 1u);
  EXPECT_EQ(grid.saturated_tiles().front(), tile_of({70, 3}));
}

TEST(EvidentialGrid, RefusesAResolutionThatIsNone) {
  for (const double resolution : {0.0, -0.05, kInf, kNan})
    EXPECT_THROW(EvidentialGrid(Georeference{.resolution_m = resolution}), std::invalid_argument) << resolution;
  EXPECT_THROW(EvidentialGrid(Georeference{.resolution_m = 0.05, .origin_x_m = kNan}), std::invalid_argument);
}

TEST(Georeference, FindsTheCellOfAPointAndBack) {
  const Georeference reference{.resolution_m = 0.05, .origin_x_m = -3.0, .origin_y_m = 2.0};
  EXPECT_EQ(reference.cell_at({-3.0, 2.0}), (CellIndex{0, 0}));
  EXPECT_EQ(reference.cell_at({-3.001, 2.049}), (CellIndex{-1, 0}));
  for (const CellIndex cell : {CellIndex{0, 0}, CellIndex{-1, -1}, CellIndex{-70'000'000, 12}, CellIndex{999, -999}})
    EXPECT_EQ(reference.cell_at(reference.centre(cell)), cell);
}

TEST(Georeference, RefusesPointsThatCannotBeAddressed) {
  const Georeference reference;
  EXPECT_THROW(static_cast<void>(reference.cell_at({kNan, 0.0})), std::out_of_range);
  EXPECT_THROW(static_cast<void>(reference.cell_at({0.0, -kInf})), std::out_of_range);
  EXPECT_THROW(static_cast<void>(reference.cell_at({1e9, 0.0})), std::out_of_range);
  EXPECT_NO_THROW(static_cast<void>(reference.cell_at({1e7, -1e7})));
}

TEST(CellBox, UnitesAndContains) {
  const CellBox a{{0, 0}, 2, 3}, b{{-5, 1}, 1, 1};
  EXPECT_EQ(a.united(b), (CellBox{{-5, 0}, 7, 3}));
  EXPECT_EQ(a.united(CellBox{}), a);
  EXPECT_EQ(CellBox{}.united(b), b);
  EXPECT_TRUE(a.contains({1, 2}));
  EXPECT_FALSE(a.contains({2, 2}));
  EXPECT_FALSE(a.contains({0, -1}));
}

TEST(EvidentialGrid, GrowsNoLargerThanItMay) {
  EvidentialGrid grid({}, 2), other;
  grid.add({0, 0}, {-1, -2, -3});
  grid.add({64, 0}, {-1, -2, -3});
  grid.add({1, 0}, {-1, -2, -3});
  other.add({128, 0}, {-1, -2, -3});
  EXPECT_THROW(grid.add({0, 64}, {-1, -2, -3}), std::length_error);
  EXPECT_THROW(grid.merge(other), std::length_error);
  EXPECT_EQ(grid.tiles().size(), 2u);
}

}  // namespace
}  // namespace credo::grids
