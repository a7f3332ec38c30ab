// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sensors/omni_camera.hpp"

namespace credo::perception {

/// One circle about the mirror axis, sampled at azimuths 2 pi i / columns in the directions of the base frame.
struct AnnulusRow {
  double radius_px = 0.0;
  int columns = 0;
  std::size_t first = 0;  ///< index of its first sample among all samples of the table
};

/// Where in the image the circles of an annulus lie: for every sample the offset of a pixel and the weights of the 2 x
/// 2 pixels from there. Made once for a camera and a centre; reading a circle is a gather, no angle is computed.
class AnnulusTable {
 public:
  static constexpr int kScale = 4;  ///< samples are grey levels times this

  /// \param radii_px   one row per radius, each > 0
  /// \param column_px  distance of the samples along the circle; the number of columns is the next multiple of 16
  /// \throws std::invalid_argument if the camera has no image size, or a radius or `column_px` is not positive.
  AnnulusTable(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px, std::span<const double> radii_px,
               double column_px);

  /// Makes the table anew about another centre, in the same memory.
  /// \param camera  as at construction
  void recenter(const sensors::OmniCamera& camera, const Eigen::Vector2d& center_px);

  [[nodiscard]] const std::vector<AnnulusRow>& rows() const { return rows_; }
  [[nodiscard]] const Eigen::Vector2d& center_px() const { return center_px_; }
  [[nodiscard]] int max_columns() const { return max_columns_; }
  [[nodiscard]] std::size_t samples() const { return usable_.size(); }

  /// Grey levels times kScale of a row's samples; samples outside the image repeat its border.
  /// \param pixels  first of the image's pixels, rows of width_px bytes without gaps
  /// \param out     at least rows()[row].columns values
  void sample(const std::uint8_t* pixels, int row, std::int16_t* out) const;

  /// False where a sample needs a pixel outside the image or one that the camera's mask forbids.
  [[nodiscard]] bool usable(int row, int column) const {
    return all_usable_ || usable_[rows_[row].first + column] != 0;
  }
  [[nodiscard]] bool all_usable() const { return all_usable_; }

 private:
  void place_row(const sensors::OmniCamera& camera, const AnnulusRow& row);
  void place_sample(const sensors::OmniCamera& camera, const Eigen::Vector2d& pixel, std::size_t sample);

  static constexpr int kLanes = 8;
  /// Samples that are read side by side, one cache line of the table.
  struct alignas(64) Block {
    std::array<std::int32_t, kLanes> offsets;
    /// Of the pixels at the offset, +1, +width, +width+1; each sample's sum to 128.
    std::array<std::array<std::uint8_t, kLanes>, 4> weights;
  };

  std::vector<AnnulusRow> rows_;
  std::vector<Block> blocks_;
  std::vector<std::uint8_t> usable_;
  bool all_usable_ = true;
  Eigen::Vector2d center_px_;
  int width_px_ = 0;
  int max_columns_ = 0;
};

/// The radii from `first` to at most `last` in steps of `step`. [px]
[[nodiscard]] std::vector<double> evenly_spaced_radii(double first, double last, double step);

}  // namespace credo::perception
