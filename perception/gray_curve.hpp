// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "perception/annulus_table.hpp"
#include "perception/scene.hpp"

namespace credo::perception {

/// Clerentin et al., sec. 3.1: the grey levels on five concentric circles. Which ones is ours: evenly spaced about the
/// horizon ring, where a wall stays a wall at any distance.
struct GrayCurveParams {
  int circles = 5;
  double half_width =
      0.35;  ///< of the band they cover, as a share of the way from the horizon ring to the nearer border
  int bins = 1024;
};

/// The radii of the circles. [px]
[[nodiscard]] std::vector<double> gray_circles(const sensors::OmniCamera& camera, const GrayCurveParams& params);

/// Mean grey level over the rows of a table (gray_circles), by azimuth; of a circle's samples the one nearest to the
/// bin. \param scratch  at least table.max_columns() values
void read_gray_curve(const AnnulusTable& table, const std::uint8_t* pixels, double noise, int bins,
                     std::vector<std::int16_t>& scratch, GrayCurve& curve);

}  // namespace credo::perception
