// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/annulus_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace credo::perception {
namespace {

constexpr int kWeightSum = 128;
constexpr int kWeightShift = 5;  // kWeightSum / AnnulusTable::kScale = 1 << kWeightShift
static_assert(kWeightSum >> kWeightShift == AnnulusTable::kScale);

int columns_of(double radius_px, double column_px) {
  const int least = static_cast<int>(std::ceil(2.0 * std::numbers::pi * radius_px / column_px));
  return std::max(16, (least + 15) / 16 * 16);
}

}  // namespace

AnnulusTable::AnnulusTable(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px,
                           std::span<const double> radii_px, double column_px)
    : center_px_(center_px), width_px_(camera.width_px) {
  if (camera.width_px < 2 || camera.height_px < 2) {
    throw std::invalid_argument("the camera's resolution must be at least 2 x 2 pixels");
  }
  if (!(column_px > 0.0)) throw std::invalid_argument("the distance of the annulus' columns must be positive");
  std::size_t total = 0;
  for (const double radius : radii_px) {
    if (!(radius > 0.0)) throw std::invalid_argument("the radii of the camera's annulus must be positive");
    const AnnulusRow row{.radius_px = radius, .columns = columns_of(radius, column_px), .first = total};
    rows_.push_back(row);
    total += static_cast<std::size_t>(row.columns);
    max_columns_ = std::max(max_columns_, row.columns);
  }
  taps_.reserve(total);
  usable_.reserve(total);
  for (const AnnulusRow& row : rows_) add_row(camera, row);
  if (std::find(usable_.begin(), usable_.end(), std::uint8_t{0}) == usable_.end()) usable_ = {};
}

void AnnulusTable::add_row(const sensors::OmniCamera& camera, const AnnulusRow& row) {
  for (int column = 0; column < row.columns; ++column) {
    const double azimuth = 2.0 * std::numbers::pi * column / row.columns - camera.T_base_camera.theta;
    const Eigen::Vector2d pixel = center_px_ + row.radius_px * camera.image_direction(azimuth);
    const double u = std::clamp(pixel.x(), 0.0, camera.width_px - 1.0);
    const double v = std::clamp(pixel.y(), 0.0, camera.height_px - 1.0);
    const int u0 = std::min(static_cast<int>(u), camera.width_px - 2);
    const int v0 = std::min(static_cast<int>(v), camera.height_px - 2);
    const double fu = u - u0;
    const double fv = v - v0;
    Tap tap{.offset = v0 * camera.width_px + u0, .weight = {}};
    const int right = static_cast<int>(std::lround(kWeightSum * fu));
    const int lower = static_cast<int>(std::lround(kWeightSum * fv));
    const int both = std::max(static_cast<int>(std::lround(kWeightSum * fu * fv)), right + lower - kWeightSum);
    tap.weight[3] = static_cast<std::uint8_t>(both);
    tap.weight[2] = static_cast<std::uint8_t>(lower - both);
    tap.weight[1] = static_cast<std::uint8_t>(right - both);
    tap.weight[0] = static_cast<std::uint8_t>(kWeightSum - right - lower + both);
    taps_.push_back(tap);
    bool usable = u == pixel.x() && v == pixel.y();
    for (int corner = 0; usable && corner < 4 && !camera.mask.empty(); ++corner) {
      usable = tap.weight[corner] == 0 || camera.mask.at<std::uint8_t>(v0 + corner / 2, u0 + corner % 2) != 0;
    }
    usable_.push_back(usable ? 1 : 0);
  }
}

void AnnulusTable::sample(const std::uint8_t* pixels, int row, std::int16_t* out) const {
  const Tap* tap = taps_.data() + rows_[row].first;
  const int columns = rows_[row].columns;
  for (int i = 0; i < columns; ++i, ++tap) {
    const std::uint8_t* upper = pixels + tap->offset;
    const std::uint8_t* lower = upper + width_px_;
    const int sum =
        tap->weight[0] * upper[0] + tap->weight[1] * upper[1] + tap->weight[2] * lower[0] + tap->weight[3] * lower[1];
    out[i] = static_cast<std::int16_t>(sum >> kWeightShift);
  }
}

std::vector<double> evenly_spaced_radii(double first, double last, double step) {
  std::vector<double> radii;
  for (int i = 0; first + i * step <= last; ++i) radii.push_back(first + i * step);
  return radii;
}

}  // namespace credo::perception
