// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "geometry/segment.hpp"

namespace credo::localization {

/// What a ray meets first.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();  ///< infinity: nothing
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();          ///< of the wall, unit, towards where the ray comes from
};

/// The walls of a plan by the squares of a grid that they pass: what lies near a point or along a ray is found without
/// looking at the rest of the plan.
class WallGrid {
 public:
  explicit WallGrid(std::span<const geometry::Segment> walls);

  /// Distance to the first wall along a ray that is nearer than `reach_m`; infinity where there is none. [m]
  /// \param direction  unit vector
  [[nodiscard]] double first_crossing(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                      double reach_m) const {
    return first_wall(origin, direction, reach_m).range_m;
  }
  /// Whether there is one.
  [[nodiscard]] bool any_crossing(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                  double reach_m) const;
  /// The first one with its normal.
  [[nodiscard]] RayHit first_hit(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double reach_m) const;

  /// Whether any wall is at most that far from a point.
  [[nodiscard]] bool any_near(const Eigen::Vector2d& point, double distance_m) const;

  /// Indices of the walls that may be at most that far from a point, growing, each once: `indices` is cleared first.
  void list_near(const Eigen::Vector2d& point, double distance_m, std::vector<int>& indices) const;

 private:
  struct Entry {
    geometry::Segment wall;
    int index = 0;
  };
  struct Met {
    double range_m = std::numeric_limits<double>::infinity();
    const geometry::Segment* wall = nullptr;
  };
  struct Square {
    int column = 0;
    int row = 0;
  };
  struct Block {  // columns and rows, inclusive; empty where last < first
    Square first, last;
  };

  template <class Visit>
  void walk(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double reach_m, Visit&& visit) const;
  [[nodiscard]] Met first_wall(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double reach_m) const;
  template <class Visit>
  void for_each_square(const geometry::Segment& wall, Visit&& visit) const;
  [[nodiscard]] Block around(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;
  [[nodiscard]] std::size_t place(const Square& square) const {
    return static_cast<std::size_t>(square.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(square.column);
  }
  [[nodiscard]] std::span<const Entry> walls_in(const Square& square) const {
    const std::size_t at = place(square);
    return {entries_.data() + begin_[at], entries_.data() + begin_[at + 1]};
  }

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double side_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::size_t> begin_;  ///< by square, one more than there are: the first of its entries
  std::vector<Entry> entries_;
};

}  // namespace credo::localization
