// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/segment.hpp"

namespace credo::localization {

/// Distance to the nearest wall of a plan, looked up in cells: the likelihood field of Thrun, Burgard and Fox,
/// Probabilistic Robotics, sec. 6.4. Made once for a plan; only tiles with a wall within reach take memory.
class DistanceField {
 public:
  static constexpr double kReach_m = 0.5;  ///< what is farther from all walls is as far as this

  explicit DistanceField(std::span<const geometry::Segment> walls);

  /// At most kReach_m; exact to three quarters of a cell's side. [m]
  [[nodiscard]] double operator()(const Eigen::Vector2d& point) const {
    const double column = (point.x() - origin_.x()) * cells_per_m_, row = (point.y() - origin_.y()) * cells_per_m_;
    if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return kReach_m;
    const int x = static_cast<int>(column), y = static_cast<int>(row);
    const std::int32_t tile = directory_[directory_place(x, y)];
    return tile < 0 ? kReach_m : kUnit_m * cells_[cell_place(tile, x, y)];
  }
  /// Side of a cell: 5 cm, larger only for a plan of more than 3 km x 3 km. [m]
  [[nodiscard]] double resolution_m() const { return 1.0 / cells_per_m_; }

 private:
  static constexpr double kUnit_m = kReach_m / 255.0;
  static constexpr int kTileBits = 5;
  static constexpr int kTileSide = 1 << kTileBits;  ///< [cells]

  [[nodiscard]] std::size_t directory_place(int x, int y) const {
    return static_cast<std::size_t>(y >> kTileBits) * tiles_in_row_ + static_cast<std::size_t>(x >> kTileBits);
  }
  [[nodiscard]] static std::size_t cell_place(std::int32_t tile, int x, int y) {
    return (static_cast<std::size_t>(tile) << (2 * kTileBits)) +
           static_cast<std::size_t>(((y & (kTileSide - 1)) << kTileBits) + (x & (kTileSide - 1)));
  }
  void add(const geometry::Segment& wall);
  void lower(int x, int y, std::uint8_t units);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cells_per_m_ = 20.0;
  int columns_ = 0;  ///< whole tiles
  int rows_ = 0;
  std::size_t tiles_in_row_ = 0;
  std::vector<std::int32_t> directory_;  ///< of tiles, by rows; -1: far from all walls
  std::vector<std::uint8_t> cells_;      ///< by tile and rows, distances in kUnit_m
};

}  // namespace credo::localization
