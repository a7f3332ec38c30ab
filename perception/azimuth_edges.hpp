// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "perception/annulus_table.hpp"

namespace credo::perception {

/// The filter that finds steps of brightness along a circle.
struct EdgeFilterParams {
  double sigma_px = 1.0;             ///< of the Gaussian whose derivative is taken, along the circle
  double expected_blur_px = 0.7;     ///< of the lens, for the contrast of a step
  double least_step = 3.0;           ///< smallest step of a hit [grey levels]
  double least_step_sigmas = 3.5;    ///< the same in expected standard deviations of the filter's noise
  double saturated_level = 250.0;    ///< [grey levels]
  double model_sigma_px = 0.10;      ///< of a hit besides noise: sampling, unequal blur
  double saturated_sigma_px = 0.50;  ///< of a hit beside saturated pixels
  double neighbour_reach = 4.0;      ///< steps nearer than that shift each other's extremum [widths of an answer]
  double neighbour_share = 0.5;      ///< of the shift that is taken out of a hit, which stays as its uncertainty
  double broad_from = 1.15;          ///< an answer that much broader than the image's is no single sharp step
  double broad_share = 0.5;          ///< of what its breadth has in excess, that is its uncertainty
  int noise_row_step = 8;            ///< every which row grey levels, noise and widths are measured in
};

/// One step of brightness across one circle.
struct EdgeHit {
  float azimuth = 0.0F;  ///< directions of the base frame, [0, 2 pi) [rad]
  float sigma = 0.0F;    ///< [rad]
  float step = 0.0F;     ///< signed: + where brighter towards growing azimuth [grey levels]
  std::int16_t row = 0;  ///< of the table
  bool saturated = false;
};

/// Derivative of a Gaussian along circles, local extrema, and their place between the columns.
class AzimuthEdgeFilter {
 public:
  AzimuthEdgeFilter(const EdgeFilterParams& params, double column_px, int max_columns);

  /// Reads circle after circle and appends its hits, by row and column. Keeps `hits`' memory. The answers of steps
  /// close to each other overlap and shift each other's extrema; that is taken out, for the widths measured by
  /// measure().
  void find(const AnnulusTable& table, const std::uint8_t* pixels, std::vector<EdgeHit>& hits);

  /// Measures the grey levels, the noise and the width of the filter's answers in every noise_row_step-th circle of an
  /// image; noise and width are for find().
  void measure(const AnnulusTable& table, const std::uint8_t* pixels);

  /// How often each grey level was met, where the table is usable.
  [[nodiscard]] const std::array<int, 256>& levels() const { return levels_; }
  /// 1-sigma of the grey levels, from the median of the filter's answers: fine texture counts as noise.
  [[nodiscard]] double noise() const { return noise_; }

 private:
  static constexpr int kReach = 4;   ///< taps on each side
  static constexpr int kMargin = 8;  ///< wrapped samples on each side of a row

  void filter_row(const AnnulusTable& table, const std::uint8_t* pixels, int row);
  void measure_widths(int columns, std::int16_t least);
  [[nodiscard]] bool usable(const AnnulusTable& table, int row, int column) const;
  [[nodiscard]] bool saturates(int column) const;
  void add_hits(const AnnulusRow& circle, int row, std::span<const int> columns, std::vector<EdgeHit>& hits) const;
  void separate(const AnnulusRow& circle, std::span<EdgeHit> hits);
  void part(std::span<const int> pairs, double width, std::span<const EdgeHit> hits);

  EdgeFilterParams params_;
  std::array<std::int16_t, kReach> taps_{};
  double column_px_ = 1.0;
  double nominal_width_ = 1.0;  ///< answer to a step with the expected blur, 1-sigma [columns]
  double width_columns_ = 1.0;  ///< the same as measured in the image, a median
  double noise_ = 0.0;
  std::array<int, 256> levels_{};
  double gain_ = 1.0;                   ///< filter answer per grey level of a step
  double noise_gain_ = 1.0;             ///< 1-sigma of the filter's answer per grey level of noise
  double extremum_gain_ = 1.0;          ///< see hit sigma
  std::vector<std::int16_t> samples_;   ///< kMargin + columns + kMargin
  bool row_saturates_ = false;          ///< the row that is looked at
  std::vector<std::uint8_t> marks_;     ///< by column: whether there is an extremum
  std::vector<float> widths_;           ///< scratch of measure()
  std::vector<int> columns_;            ///< of the row's hits, and room for two more
  std::vector<int> pairs_;              ///< hits of the row whose next one is near
  std::vector<double> shifts_;          ///< of the row's hits by their neighbours [rad]
  std::vector<std::int16_t> response_;  ///< kMargin + columns + kMargin
};

}  // namespace credo::perception
