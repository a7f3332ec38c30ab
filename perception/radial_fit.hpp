// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace credo::perception {

/// One circle's word on where a radial line is.
struct RadialPoint {
  double azimuth = 0.0;  ///< relative to any reference near the line [rad]
  double sigma = 0.0;    ///< [rad]
  double lever = 0.0;    ///< 1/radius - 1/horizon radius [1/px]
  int row = 0;
  double step = 0.0;  ///< grey levels, >= 0
};

/// The points of one line, a few side by side, as a fit takes them. Keeps its memory.
class RadialPoints {
 public:
  static constexpr std::size_t kLanes = 4;
  using Lanes = Eigen::Array<double, kLanes, 1>;
  /// The last one is filled up with points that are too far from any line to count.
  struct Block {
    Lanes azimuth = Lanes::Constant(1e9);
    Lanes inverse_sigma = Lanes::Ones();
    Lanes lever = Lanes::Zero();
  };

  RadialPoints() = default;
  explicit RadialPoints(std::span<const RadialPoint> points);

  void reserve(std::size_t points);
  void clear();
  void push_back(const RadialPoint& point) {
    const auto lane = static_cast<Eigen::Index>(size() % kLanes);
    if (lane == 0) blocks_.emplace_back();
    Block& block = blocks_.back();
    block.azimuth[lane] = point.azimuth;
    block.inverse_sigma[lane] = 1.0 / point.sigma;
    block.lever[lane] = point.lever;
    rows_.push_back(point.row);
    steps_.push_back(point.step);
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] RadialPoint operator[](std::size_t i) const;
  [[nodiscard]] std::span<const Block> blocks() const { return blocks_; }
  [[nodiscard]] std::span<const int> rows() const { return rows_; }
  [[nodiscard]] std::span<const double> steps() const { return steps_; }

 private:
  std::vector<Block> blocks_;
  std::vector<int> rows_;
  std::vector<double> steps_;
};

struct RadialFitParams {
  double tukey = 4.685;          ///< where a point loses its weight, in robust standard deviations
  int iterations = 8;            ///< at most
  double settled_sigmas = 0.01;  ///< a step that small, in standard deviations of the azimuth, is the last
  double support_sigmas = 4.0;   ///< a point within this many standard deviations supports the line
  double error_inflation = 1.2;  ///< neighbouring circles share pixels and the sampling pattern
};

struct RadialFit {
  double azimuth = 0.0;  ///< at the horizon ring, relative as the points are [rad]
  double slope = 0.0;    ///< [rad px]
  double sigma = 0.0;    ///< of the azimuth [rad]
  double sigma_slope = 0.0;
  double scale = 1.0;     ///< of the residuals, in expected standard deviations, >= 1
  double contrast = 0.0;  ///< mean step of the supporting points [grey levels]
  int rows = 0;           ///< rows with a supporting point
  int first_row = 0;
  int last_row = 0;
};

/// azimuth(r) = azimuth + slope (1/r - 1/horizon radius) by iteratively reweighted least squares with Tukey's weights.
/// \param points       by row; without any, a fit without rows is returned
/// \param start        azimuth to start from [rad]
/// \param sigma_slope  1-sigma of the slope beforehand, about 0 [rad px], > 0
[[nodiscard]] RadialFit fit_radial_line(const RadialPoints& points, double start, double sigma_slope,
                                        const RadialFitParams& params);

}  // namespace credo::perception
