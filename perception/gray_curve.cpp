// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/gray_curve.hpp"

#include <algorithm>
#include <cmath>

namespace credo::perception {

std::vector<double> gray_circles(const sensors::OmniCamera& camera, const GrayCurveParams& params) {
  const double inner = camera.inner_radius_px;
  const double outer = camera.outer_radius_px;
  const bool horizon_inside = camera.horizon_radius_px > inner && camera.horizon_radius_px < outer;
  const double middle = horizon_inside ? camera.horizon_radius_px : 0.5 * (inner + outer);
  const double half = params.half_width * std::min(middle - inner, outer - middle);
  std::vector<double> radii;
  for (int i = 0; i < params.circles; ++i) {
    const double place = params.circles > 1 ? 2.0 * i / (params.circles - 1) - 1.0 : 0.0;
    radii.push_back(middle + place * half);
  }
  return radii;
}

void read_gray_curve(const AnnulusTable& table, const std::uint8_t* pixels, double noise, int bins,
                     std::vector<std::int16_t>& scratch, GrayCurve& curve) {
  curve.values.assign(static_cast<std::size_t>(bins), 0.0F);
  const auto circles = static_cast<int>(table.rows().size());
  for (int row = 0; row < circles; ++row) {
    table.sample(pixels, row, scratch.data());
    const int columns = table.rows()[row].columns;
    int column = 0, rest = bins;  // 2 bin columns + bins = 2 bins column + rest: rounded, without a division
    for (int bin = 0; bin < bins; ++bin, rest += 2 * columns) {
      for (; rest >= 2 * bins; rest -= 2 * bins) ++column;
      curve.values[bin] += scratch[column < columns ? column : 0];
    }
  }
  const float scale = 1.0F / static_cast<float>(AnnulusTable::kScale * circles);
  for (float& value : curve.values) value *= scale;
  curve.noise = noise / std::sqrt(static_cast<double>(circles));
}

}  // namespace credo::perception
