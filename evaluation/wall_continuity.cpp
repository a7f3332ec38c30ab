// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/wall_continuity.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "evaluation/true_cells.hpp"

namespace credo::evaluation {
namespace {

using grids::CellBox;
using grids::CellIndex;
using State = TrueCells::State;

/// Yes or no for every cell of a rectangle; no outside.
class Mask {
 public:
  template <typename Holds>
  Mask(const CellBox& box, Holds holds) : box_(box) {
    yes_.reserve(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
    for (int y = box.min.y; y < box.min.y + box.height; ++y)
      for (int x = box.min.x; x < box.min.x + box.width; ++x) yes_.push_back(holds(CellIndex{x, y}));
  }

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] bool at(CellIndex cell) const { return box_.contains(cell) && yes_[place(cell)]; }
  void clear(CellIndex cell) { yes_[place(cell)] = false; }
  [[nodiscard]] bool near(CellIndex cell, int within) const {
    return any_within(cell, within, [&](CellIndex other) { return at(other); });
  }

 private:
  [[nodiscard]] std::size_t place(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;
  std::vector<bool> yes_;
};

enum class Neighbours { kSides, kSidesAndCorners };

/// Takes the region of `seed` out of the mask. \returns its cells
std::vector<CellIndex> take_region(Mask& mask, CellIndex seed, Neighbours neighbours) {
  std::vector<CellIndex> region{seed};
  mask.clear(seed);
  for (std::size_t i = 0; i < region.size(); ++i) {
    const CellIndex cell = region[i];
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{cell.x + dx, cell.y + dy};
        if ((neighbours == Neighbours::kSides && dx != 0 && dy != 0) || !mask.at(next)) continue;
        mask.clear(next);
        region.push_back(next);
      }
  }
  return region;
}

template <typename Visit>
void for_each_region(Mask mask, Neighbours neighbours, Visit visit) {
  const CellBox box = mask.box();
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x)
      if (mask.at({x, y})) visit(take_region(mask, {x, y}, neighbours));
}

CellBox box_of(const std::vector<CellIndex>& region) {
  CellBox box;
  for (const CellIndex cell : region) box = box.united({cell, 1, 1});
  return box;
}

bool on_rim(CellIndex cell, const CellBox& box) {
  return cell.x == box.min.x || cell.y == box.min.y || cell.x == box.min.x + box.width - 1 ||
         cell.y == box.min.y + box.height - 1;
}

/// Whether a blockage parts what is free around it.
bool parts(std::vector<CellIndex> blockage, const Mask& free, const WallContinuityParams& params) {
  const CellBox window = widened(box_of(blockage), params.around_cells);
  std::sort(blockage.begin(), blockage.end());
  const Mask is_blockage(window, [&](CellIndex c) { return std::binary_search(blockage.begin(), blockage.end(), c); });
  const Mask around(window, [&](CellIndex cell) { return free.at(cell) && !is_blockage.at(cell); });
  int sides = 0;
  for_each_region(around, Neighbours::kSides, [&](const std::vector<CellIndex>& region) {
    const bool touches = std::any_of(region.begin(), region.end(), [&](CellIndex c) { return is_blockage.near(c, 1); });
    const bool leaves = std::any_of(region.begin(), region.end(), [&](CellIndex c) { return on_rim(c, window); });
    sides += touches && leaves;
  });
  return sides > 1;
}

}  // namespace

WallContinuity wall_continuity(const grids::MassMap& map, const datasets::OccupancyMap& truth,
                               const WallContinuityParams& params) {
  const int tolerance = params.tolerance_cells;
  const CellBox box = widened(map.box, tolerance + params.around_cells);
  const TrueCells real(truth, map.georeference, box);
  const Mask seen(map.box, [&](CellIndex cell) { return map.saw(cell); });
  const Mask wall(map.box, [&](CellIndex cell) { return map.saw(cell) && map.at(cell).occupied > map.at(cell).empty; });
  const Mask reached(box, [&](CellIndex cell) {
    return real.at(cell) == State::kOccupied && real.near(cell, State::kEmpty, 1) && seen.near(cell, tolerance);
  });
  const double side_m = map.georeference.resolution_m;
  WallContinuity result;
  for_each_region(reached, Neighbours::kSidesAndCorners, [&](const std::vector<CellIndex>& surface) {
    result.surface_m += side_m * static_cast<double>(surface.size());
  });
  if (result.surface_m == 0.0)
    throw std::invalid_argument("the map reached no wall of the truth: are both in the same frame?");

  const Mask missing(box, [&](CellIndex cell) { return reached.at(cell) && !wall.near(cell, tolerance); });
  for_each_region(missing, Neighbours::kSidesAndCorners, [&](const std::vector<CellIndex>& gap) {
    const CellBox extent = box_of(gap);
    const int length = std::max(extent.width, extent.height);
    if (length <= params.torn_above_cells) return;
    ++result.torn;
    result.torn_m += side_m * length;
  });

  const Mask free(box, [&](CellIndex cell) {
    return real.at(cell) == State::kEmpty && !real.near(cell, State::kOccupied, tolerance);
  });
  const Mask blocking(box, [&](CellIndex cell) { return free.at(cell) && wall.at(cell); });
  for_each_region(blocking, Neighbours::kSidesAndCorners,
                  [&](const std::vector<CellIndex>& blockage) { result.joined += parts(blockage, free, params); });
  return result;
}

}  // namespace credo::evaluation
