// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "evidence/believed.hpp"
#include "geometry/pose.hpp"
#include "grids/cell_grid.hpp"
#include "grids/evidential_grid.hpp"

namespace credo::mapping {

struct PoseBlurParams {
  /// From this spread on (1-sigma, at the farthest reading) evidence is blurred; what is less stays within the cells
  /// and discounts. Infinity: never.
  double from_cells = 0.5;
  /// The largest spread that evidence is blurred by. Of a pose that knows less the rest of the variance discounts: what
  /// is spread so thin says next to nothing, and would ask for more poses.
  double most_cells = 8.0;
};

/// Poses, all as probable, that stand for an unsure one: their mean is its pose, and their covariance that part of its
/// covariance that evidence is blurred by. Each carries the rest of the covariance, and the belief. They lie evenly
/// along any direction, about a cell apart at the farthest reading, in pairs to either side.
/// \returns none where the spread is at most `from_cells`: the pose itself does
/// \param ranges_m  of the reading: the farthest within `range_max_m` is where the heading counts most
/// \throws std::invalid_argument as require_usable, or if a parameter is out of range
[[nodiscard]] std::vector<evidence::Believed<geometry::PoseEstimate>> poses_for_blur(
    const evidence::Believed<geometry::PoseEstimate>& T_map_base, std::span<const float> ranges_m, double range_max_m,
    double resolution_m, const PoseBlurParams& params = {});

/// The evidence of a reading whose pose is one of several, cell by cell the mean of the masses: q(A) = E[q(A) | pose].
/// Where no pose sees a cell nothing is said of it.
class EvidenceMean {
 public:
  /// What is said from one of the poses. Its tiles may differ from those of the others.
  void add(const grids::EvidentialGrid& from_one_pose);
  /// Combines the mean of all that was added into a grid.
  /// \throws std::length_error as EvidentialGrid::tile; a part may be in it then.
  void combine_into(grids::EvidentialGrid& grid) const;

 private:
  /// The sums of 1 - q, in which what was not seen is nothing.
  struct Sums {
    std::vector<double> empty, occupied, unknown;
  };
  std::map<grids::TileIndex, Sums> tiles_;
  int poses_ = 0;
};

/// Adds to a grid the mean of what is said from each of some poses.
/// \returns what paint(grid, pose) does, which is the same from all of them
template <typename Paint>
auto paint_mean(grids::EvidentialGrid& grid, std::span<const evidence::Believed<geometry::PoseEstimate>> poses,
                const Paint& paint) {
  EvidenceMean mean;
  decltype(paint(grid, poses.front())) painted{};
  for (const evidence::Believed<geometry::PoseEstimate>& pose : poses) {
    grids::EvidentialGrid from_here(grid.georeference());
    painted = paint(from_here, pose);
    mean.add(from_here);
  }
  mean.combine_into(grid);
  return painted;
}

/// As EvidenceMean, in linear masses, which may hold no ignorance.
class MassMean {
 public:
  explicit MassMean(const grids::Georeference& georeference) : sums_(georeference) {}

  /// What a reading says of a cell from one of the poses.
  void add(grids::CellIndex cell, const evidence::GridMass& mass) {
    evidence::GridMass& sum = sums_.see(cell);
    sum.empty += mass.empty;
    sum.occupied += mass.occupied;
    sum.conflict += mass.conflict;
  }
  /// Calls take_in(cell, mean) for each cell that was seen from one of so many poses.
  template <typename TakeIn>
  void for_each(std::size_t poses, const TakeIn& take_in) const {
    const double share = 1.0 / static_cast<double>(poses);
    sums_.for_each([&](grids::CellIndex cell, const evidence::GridMass& sum) {
      const double unknown = std::max(0.0, 1.0 - share * (sum.empty + sum.occupied + sum.conflict));
      take_in(cell, evidence::GridMass{share * sum.empty, share * sum.occupied, share * sum.conflict, unknown});
    });
  }

 private:
  grids::CellGrid<evidence::GridMass> sums_;  // but for ignorance
};

}  // namespace credo::mapping
