// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// Where a horizontal ray meets a panel.
struct RayHit {
  double range_m = 0.0;
  int panel = 0;
  double cos_incidence = 1.0;  ///< |cosine| of the angle between the ray and the panel's normal
};

/// The panels cut at one height, in a uniform grid: first hits of horizontal rays.
class RayCaster {
 public:
  RayCaster(const World& world, double height_m);

  /// The nearest panel along a unit direction, within `max_range_m`; nothing where there is none.
  /// \param ignore  a panel that is not met: the one that the ray has just left; -1 = none
  [[nodiscard]] std::optional<RayHit> cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                           double max_range_m, int ignore = -1) const;

  /// Indices into World::panels of the panels at this height.
  [[nodiscard]] const std::vector<int>& panels() const { return panels_; }

 private:
  void fill_cells();
  [[nodiscard]] bool meets(int panel, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double& range,
                           double& cos_incidence) const;

  const World* world_;
  std::vector<int> panels_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<int> cell_start_;
  std::vector<int> cell_panels_;
};

}  // namespace credo::sim
