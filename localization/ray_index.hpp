// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
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

/// Walls sorted into the square cells that they pass, so that a ray looks only at those on its way (Amanatides and Woo
/// 1987). Made once for a plan; a cast among hundreds of walls takes some tenths of a microsecond.
class RayIndex {
 public:
  explicit RayIndex(std::span<const geometry::Segment> walls);

  /// \param direction    unit vector
  /// \param max_range_m  nothing beyond is met
  [[nodiscard]] RayHit cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double max_range_m) const;

 private:
  struct Wall {
    Eigen::Vector2d a;
    Eigen::Vector2d along;   ///< b - a
    Eigen::Vector2d normal;  ///< unit
  };
  [[nodiscard]] std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  void meet(std::size_t cell, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, RayHit& first) const;

  std::vector<Wall> walls_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;    ///< into `members_`, for each cell and one past the last
  std::vector<std::uint32_t> members_;  ///< walls, by cell
};

}  // namespace credo::localization
