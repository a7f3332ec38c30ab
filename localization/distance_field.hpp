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
/// Probabilistic Robotics, sec. 6.4. Made once for a plan.
class DistanceField {
 public:
  static constexpr double kReach_m = 0.5;  ///< what is farther from all walls is as far as this

  explicit DistanceField(std::span<const geometry::Segment> walls);

  /// At most kReach_m; exact to three quarters of a cell's side. [m]
  [[nodiscard]] double operator()(const Eigen::Vector2d& point) const {
    const double column = (point.x() - origin_.x()) * cells_per_m_, row = (point.y() - origin_.y()) * cells_per_m_;
    if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return kReach_m;
    return kUnit_m * cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column)];
  }
  /// Side of a cell: 5 cm, larger only where the plan would need more than 4 million. [m]
  [[nodiscard]] double resolution_m() const { return 1.0 / cells_per_m_; }

 private:
  static constexpr double kUnit_m = kReach_m / 255.0;

  void add(const geometry::Segment& wall);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cells_per_m_ = 20.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> cells_;  ///< by rows, distances in kUnit_m
};

}  // namespace credo::localization
