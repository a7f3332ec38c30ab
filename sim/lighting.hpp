// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// How light the building is from place to place: lamps overhead, windows at the side. A table over the floor, about 1.
class LightMap {
 public:
  explicit LightMap(const World& world);
  /// Bilinear; the nearest value outside of the building.
  [[nodiscard]] float at(float x, float y) const;

 private:
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<float> values_;
};

/// Albedo of a surface of `material` at `along` metres from its start and height `z`, averaged over `footprint_m` along
/// it (a pattern too fine to be seen is grey); `surface` tells equal shelves apart.
[[nodiscard]] float albedo_at(const Material& material, int surface, float along, float z, float footprint_m,
                              float skirting_m);

/// The places along a panel, in metres from its start, where the pattern of its material changes, both ends excluded.
[[nodiscard]] std::vector<double> pattern_edges(const Material& material, double length_m);

/// The share of the light that a wall with this direction gets: |n . l| with the direction of the light.
[[nodiscard]] float facing_light(const Eigen::Vector2d& along, double light_rad);

}  // namespace credo::sim
