// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/annulus_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace credo::perception {
namespace {

constexpr int kWeightSum = 128;
constexpr int kWeightShift = 5;  // kWeightSum / AnnulusTable::kScale = 1 << kWeightShift
static_assert(kWeightSum >> kWeightShift == AnnulusTable::kScale);

// Eight pairs of neighbouring pixels as they lie in memory, or numbers of 16 bits for each.
using Pairs [[gnu::vector_size(16)]] = std::uint16_t;

constexpr int kLeftShift = std::endian::native == std::endian::little ? 0 : 8;
constexpr int kRightShift = 8 - kLeftShift;

std::uint16_t pair_at(const std::uint8_t* pixel) {
  std::uint16_t pair;
  std::memcpy(&pair, pixel, sizeof pair);
  return pair;
}

/// Straight into a register: through memory, the pairs would have to arrive there before they are read as one.
Pairs gather(const std::uint8_t* pixels, const std::array<std::int32_t, 8>& offsets) {
  const auto [a, b, c, d, e, f, g, h] = offsets;
  return Pairs{pair_at(pixels + a), pair_at(pixels + b), pair_at(pixels + c), pair_at(pixels + d),
               pair_at(pixels + e), pair_at(pixels + f), pair_at(pixels + g), pair_at(pixels + h)};
}

Pairs widen(const std::array<std::uint8_t, 8>& bytes) {
  Pairs wide;
  for (std::size_t i = 0; i < bytes.size(); ++i) wide[i] = bytes[i];
  return wide;
}

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
  blocks_.resize(total / kLanes);
  usable_.resize(total);
  recenter(camera, center_px);
}

void AnnulusTable::recenter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px) {
  center_px_ = center_px;
  for (const AnnulusRow& row : rows_) place_row(camera, row);
  all_usable_ = std::find(usable_.begin(), usable_.end(), std::uint8_t{0}) == usable_.end();
}

/// The direction of a sample is that of the one before it, turned: no sine, no cosine.
void AnnulusTable::place_row(const sensors::OmniCamera& camera, const AnnulusRow& row) {
  const double step = camera.azimuth_sign * 2.0 * std::numbers::pi / row.columns;
  const Eigen::Rotation2Dd turn(step);
  const Eigen::Matrix2d R = turn.toRotationMatrix();
  Eigen::Vector2d direction = camera.image_direction(-camera.T_base_camera.theta);
  for (int column = 0; column < row.columns; ++column) {
    place_sample(camera, center_px_ + row.radius_px * direction, row.first + static_cast<std::size_t>(column));
    direction = R * direction;
  }
}

void AnnulusTable::place_sample(const sensors::OmniCamera& camera, const Eigen::Vector2d& pixel, std::size_t sample) {
  const double u = std::clamp(pixel.x(), 0.0, camera.width_px - 1.0);
  const double v = std::clamp(pixel.y(), 0.0, camera.height_px - 1.0);
  const int u0 = std::min(static_cast<int>(u), camera.width_px - 2);
  const int v0 = std::min(static_cast<int>(v), camera.height_px - 2);
  const double fu = u - u0;
  const double fv = v - v0;
  const int right = static_cast<int>(kWeightSum * fu + 0.5);
  const int lower = static_cast<int>(kWeightSum * fv + 0.5);
  const int both = std::max(static_cast<int>(kWeightSum * fu * fv + 0.5), right + lower - kWeightSum);
  const std::array<int, 4> weights{kWeightSum - right - lower + both, right - both, lower - both, both};
  Block& block = blocks_[sample / kLanes];
  const std::size_t lane = sample % kLanes;
  bool usable = u == pixel.x() && v == pixel.y();
  for (int corner = 0; corner < 4; ++corner) {
    block.weights[corner][lane] = static_cast<std::uint8_t>(weights[corner]);
    if (camera.mask.empty() || weights[corner] == 0) continue;
    usable = usable && camera.mask.at<std::uint8_t>(v0 + corner / 2, u0 + corner % 2) != 0;
  }
  block.offsets[lane] = v0 * camera.width_px + u0;
  usable_[sample] = usable ? 1 : 0;
}

/// Arithmetic on 16 bits, where 255 * kWeightSum fits.
void AnnulusTable::sample(const std::uint8_t* pixels, int row, std::int16_t* out) const {
  const auto first = blocks_.begin() + static_cast<std::ptrdiff_t>(rows_[row].first / kLanes);
  const auto last = first + rows_[row].columns / kLanes;
  for (auto block = first; block != last; ++block, out += kLanes) {
    const auto& [w0, w1, w2, w3] = block->weights;
    const Pairs upper = gather(pixels, block->offsets), lower = gather(pixels + width_px_, block->offsets);
    const Pairs sum = widen(w0) * (upper >> kLeftShift & 255) + widen(w1) * (upper >> kRightShift & 255) +
                      widen(w2) * (lower >> kLeftShift & 255) + widen(w3) * (lower >> kRightShift & 255);
    const Pairs scaled = sum >> kWeightShift;
    std::memcpy(out, &scaled, sizeof scaled);
  }
}

std::vector<double> evenly_spaced_radii(double first, double last, double step) {
  std::vector<double> radii;
  for (int i = 0; first + i * step <= last; ++i) radii.push_back(first + i * step);
  return radii;
}

}  // namespace credo::perception
