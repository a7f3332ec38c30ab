// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "perception/annulus_table.hpp"
#include "perception/scene.hpp"

namespace credo::perception {

/// What tells the bars that hold the mirror from the world.
struct StrutParams {
  double least_share = 0.7;         ///< of the annulus' rows that support each of the two edges of a bar
  double largest_width_rad = 0.10;  ///< between its two edges
  double inner_from = 0.45;         ///< where the bar is looked for inside the annulus, as shares of the inner radius
  double inner_until = 0.92;
  double least_drop = 4.0;         ///< the bar is that much darker than both sides [grey levels]
  double least_drop_sigmas = 3.0;  ///< the same in expected standard deviations
  double least_inner_share = 0.6;  ///< of the inner circles on which it is darker
  double margin_rad = 0.008;       ///< lines that near to a bar's edges or inside it are the bar's
  double flank_px = 3.0;           ///< distance of the sides from the bar's edges
  int seen_to_believe = 1;         ///< images with a bar at a place before it is remembered
  int remembered_images = 20;      ///< for so long it hides lines without being seen again
  double same_place_rad = 0.006;   ///< bars of two images nearer than that are one
};

/// Finds the bars that hold the mirror, dark and thin, through the whole annulus and across the reflection of the
/// camera inside it, where the world is never seen; and takes their edges out of the lines.
class StrutFilter {
 public:
  StrutFilter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px, double column_px,
              const StrutParams& params);

  /// Makes its table anew about another centre; what it remembers stays.
  void recenter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px);

  /// Removes the lines of bars from `lines` (by azimuth, order kept).
  void remove(const std::uint8_t* pixels, double noise, std::vector<RadialLine>& lines);

 private:
  struct Strut {
    double from = 0.0;  ///< azimuth [rad]
    double width = 0.0;
    int seen = 0;
    int missed = 0;
  };

  [[nodiscard]] bool crosses_inside(double from, double width, double noise) const;
  void remember(double from, double width);

  StrutParams params_;
  AnnulusTable inner_;
  std::vector<std::vector<std::int16_t>> samples_;  ///< by inner row
  std::vector<Strut> struts_;
};

}  // namespace credo::perception
