// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/strut_filter.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using geometry::kTurn;

std::vector<double> inner_radii(const sensors::OmniCamera& camera, const StrutParams& params) {
  return evenly_spaced_radii(std::max(2.0, params.inner_from * camera.inner_radius_px),
                             params.inner_until * camera.inner_radius_px, 2.0);
}

constexpr std::size_t kUsualStruts = 16;

double counter_clockwise(double from, double to) {
  const double turn = std::fmod(to - from, kTurn);
  return turn < 0.0 ? turn + kTurn : turn;
}

}  // namespace

StrutFilter::StrutFilter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px, double column_px,
                         const StrutParams& params)
    : params_(params), inner_(camera, center_px, inner_radii(camera, params), column_px) {
  for (const AnnulusRow& row : inner_.rows()) samples_.emplace_back(row.columns);
  struts_.reserve(kUsualStruts);
}

void StrutFilter::recenter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px) {
  inner_.recenter(camera, center_px);
}

bool StrutFilter::crosses_inside(double from, double width, double noise) const {
  const double least = AnnulusTable::kScale * std::max(params_.least_drop, params_.least_drop_sigmas * noise);
  int darker = 0;
  for (std::size_t row = 0; row < samples_.size(); ++row) {
    const AnnulusRow& circle = inner_.rows()[row];
    const auto level = [&](double azimuth) {
      const auto column = static_cast<int>(std::lround(counter_clockwise(0.0, azimuth) / kTurn * circle.columns));
      return static_cast<double>(samples_[row][column % circle.columns]);
    };
    const double flank = params_.flank_px / circle.radius_px;
    const double middle = level(from + 0.5 * width);
    if (std::min(level(from - flank), level(from + width + flank)) - middle >= least) ++darker;
  }
  return darker >= params_.least_inner_share * static_cast<double>(samples_.size());
}

void StrutFilter::remember(double from, double width) {
  for (Strut& strut : struts_) {
    if (std::abs(geometry::angle_difference(strut.from, from)) > params_.same_place_rad) continue;
    if (std::abs(strut.width - width) > params_.same_place_rad) continue;
    strut = {.from = from, .width = width, .seen = strut.seen + 1, .missed = -1};
    return;
  }
  struts_.push_back({.from = from, .width = width, .seen = 1, .missed = -1});
}

void StrutFilter::remove(const std::uint8_t* pixels, double noise, std::vector<RadialLine>& lines) {
  if (samples_.empty()) return;
  bool sampled = false;
  for (const RadialLine& dark : lines) {  // the edge where a bar begins
    if (dark.polarity > 0 || dark.visible_share < params_.least_share) continue;
    for (const RadialLine& bright : lines) {
      if (bright.polarity < 0 || bright.visible_share < params_.least_share) continue;
      const double width = counter_clockwise(dark.azimuth, bright.azimuth);
      if (width > params_.largest_width_rad) continue;
      for (int row = 0; !sampled && row < static_cast<int>(samples_.size()); ++row) {
        inner_.sample(pixels, row, samples_[row].data());
      }
      sampled = true;
      if (crosses_inside(dark.azimuth, width, noise)) remember(dark.azimuth, width);
    }
  }
  for (Strut& strut : struts_) ++strut.missed;
  std::erase_if(struts_, [&](const Strut& strut) { return strut.missed > params_.remembered_images; });
  std::erase_if(lines, [&](const RadialLine& line) {
    return std::any_of(struts_.begin(), struts_.end(), [&](const Strut& strut) {
      const double inside = counter_clockwise(strut.from - params_.margin_rad, line.azimuth);
      return strut.seen >= params_.seen_to_believe && inside <= strut.width + 2.0 * params_.margin_rad;
    });
  });
}

}  // namespace credo::perception
