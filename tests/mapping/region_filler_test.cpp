// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/region_filler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "geometry/segment.hpp"

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using Corner = RegionFiller::Corner;
using Contour = std::vector<Corner>;

Eigen::Vector2d exact(const Corner& corner) { return {corner.x, corner.y}; }

/// How often a contour winds around a point: crossings of the ray to the left of it.
int turns_around(const Eigen::Vector2d& point, const Contour& contour) {
  int turns = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Eigen::Vector2d a = exact(contour[i]), b = exact(contour[(i + 1) % contour.size()]);
    if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
    const bool up = a.y() < b.y();
    const double side = geometry::cross(b - a, point - a);  // positive: the point lies to the left of the edge
    if (up ? side < 0.0 : side > 0.0) turns += up ? 1 : -1;
  }
  return turns;
}

/// Whether rounding may put a point to either side of an edge.
bool is_on(const Eigen::Vector2d& point, const Contour& contour) {
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Eigen::Vector2d a = exact(contour[i]), b = exact(contour[(i + 1) % contour.size()]);
    if (std::abs(geometry::cross(b - a, point - a)) < 1e-4 * (b - a).norm()) return true;
  }
  return false;
}

RegionFiller::Increments increments_by_class() {
  RegionFiller::Increments increments;
  for (int c = 0; c < RegionFiller::kClasses; ++c) increments[c].increment = {-1 - c, -100 - c, -10'000 - c};
  return increments;
}

void fill(grids::EvidentialGrid& grid, RegionFiller& filler, const RegionFiller::Increments& increments,
          RegionFiller::Regions regions = RegionFiller::Regions::kMayOverlap) {
  PendingRegions pending;
  filler.fill(grid, pending, increments, regions);
  pending.settle(grid);
}

TEST(RegionFiller, EveryCellGetsTheHighestClassThatWindsAroundItsCentre) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-90.0F, 110.0F);
  const RegionFiller::Increments increments = increments_by_class();
  RegionFiller filler;
  int compared = 0;
  for (int round = 0; round < 12; ++round) {
    std::vector<std::pair<Contour, int>> contours;
    for (int k = 0; k < 4; ++k) {
      Contour contour(3 + random() % 6);  // crosses itself
      for (Corner& corner : contour) corner = {place(random), place(random)};
      contours.emplace_back(contour, static_cast<int>(random() % 3) * 31);
      filler.add_contour(contour, contours.back().second);
    }
    grids::EvidentialGrid grid;
    fill(grid, filler, increments);
    for (int y = -95; y < 115; ++y) {
      for (int x = -95; x < 115; ++x) {
        std::array<int, RegionFiller::kClasses> turns{};
        const Eigen::Vector2d centre(x + 0.5, y + 0.5);
        if (std::ranges::any_of(contours, [&](const auto& each) { return is_on(centre, each.first); })) continue;
        for (const auto& [contour, c] : contours) turns[c] += turns_around(centre, contour);
        ++compared;
        FixedLogCommonality expected;
        for (int c = 0; c < RegionFiller::kClasses; ++c)
          if (turns[c] != 0) expected = increments[c].increment;
        ASSERT_EQ(grid.at({x, y}), expected) << x << ' ' << y << " in round " << round;
      }
    }
  }
  EXPECT_GT(compared, 520'000);  // of 529 200
}

TEST(RegionFiller, ContoursThatShareAnEdgeLeaveNoCellBetweenThemAndFillNoneTwice) {
  const RegionFiller::Increments increments = increments_by_class();
  const Contour lower{{0.3F, 0.2F}, {70.1F, 3.7F}, {66.6F, 40.2F}}, upper{{0.3F, 0.2F}, {66.6F, 40.2F}, {-3.0F, 50.0F}};
  Contour both{lower[0], lower[1], lower[2], upper[2]};
  grids::EvidentialGrid apart, together;
  RegionFiller filler;
  filler.add_contour(lower, 5);
  fill(apart, filler, increments);
  filler.add_contour(upper, 5);
  fill(apart, filler, increments);
  filler.add_contour(both, 5);
  fill(together, filler, increments);
  EXPECT_EQ(apart, together);
}

TEST(RegionFiller, AChainBetweenTwoRegionsBoundsBoth) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> aside(-6.0F, 6.0F);
  const Contour around{{-70.2F, -5.1F}, {90.3F, -5.1F}, {90.3F, 81.4F}, {-70.2F, 81.4F}};  // of both regions
  const RegionFiller::Increments increments = increments_by_class();
  RegionFiller filler;
  for (int round = 0; round < 20; ++round) {
    Contour border;  // from the lower edge to the upper one, forth and back
    for (int k = 0; k <= 40; ++k) {
      const float middle = 38.0F + 2.0F * static_cast<float>(k - 20) + aside(random);
      border.push_back({10.0F + aside(random), k == 0 ? around[0].y : k == 40 ? around[2].y : middle});
    }
    Contour left = border, right = border;
    left.insert(left.end(), {around[3], around[0]});
    right.insert(right.end(), {around[2], around[1]});
    grids::EvidentialGrid apart, shared;
    filler.add_contour(left, 3);
    filler.add_contour(right, 40);
    fill(apart, filler, increments);

    const auto add_chain = [&](const Contour& corners, RegionFiller::Sides sides) {
      for (const Corner& corner : corners) filler.add_corner(corner);
      filler.end_chain(sides);
    };
    add_chain(border, {.left = 3, .right = 40});
    add_chain({border.back(), around[3], around[0], border.front()}, {.left = 3});
    add_chain({border.back(), around[2], around[1], border.front()}, {.right = 40});
    fill(shared, filler, increments);
    ASSERT_EQ(apart, shared) << "round " << round;
  }
}

TEST(RegionFiller, ForgetsItsContours) {
  RegionFiller filler;
  const Contour square{{0.0F, 0.0F}, {9.0F, 0.0F}, {9.0F, 9.0F}, {0.0F, 9.0F}};
  grids::EvidentialGrid grid;
  filler.add_contour(square, 0);
  filler.clear();
  fill(grid, filler, increments_by_class());
  EXPECT_TRUE(grid.tiles().empty());
  filler.add_contour(square, 0);
  fill(grid, filler, increments_by_class());
  fill(grid, filler, increments_by_class());
  EXPECT_EQ(grid.at({4, 4}), increments_by_class()[0].increment);
  EXPECT_EQ(grid.bounding_box(), (grids::CellBox{{0, 0}, 9, 9}));
}

TEST(RegionFiller, CountsCornersFromItsBase) {
  const Contour square{{0.25F, -2.5F}, {9.0F, -2.5F}, {9.0F, 9.75F}, {0.25F, 9.75F}};
  grids::EvidentialGrid here, there;
  RegionFiller filler;
  filler.add_contour(square, 0);
  fill(here, filler, increments_by_class());
  const grids::CellIndex base{-1'000'000'000, 12'345};
  filler.clear(base);
  filler.add_contour(square, 0);
  fill(there, filler, increments_by_class());
  EXPECT_EQ(here.bounding_box(), (grids::CellBox{{0, -3}, 9, 13}));
  EXPECT_EQ(there.bounding_box(), (grids::CellBox{{base.x, base.y - 3}, 9, 13}));
}

}  // namespace
}  // namespace credo::mapping
