// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/angles.hpp"
#include "perception/azimuth_edges.hpp"
#include "perception/radial_fit.hpp"

namespace credo::perception {

/// Where many circles have a step of one sign.
struct LinePeak {
  double azimuth = 0.0;  ///< middle of the bin [rad]
  int polarity = 0;
  int votes = 0;
  int bin = 0;
};

/// Hits by azimuth and sign: a histogram over the azimuth that keeps the hits of each bin together.
class LineVotes {
 public:
  /// \param horizon_px  radius of the ring where a line's azimuth is taken
  LineVotes(const AnnulusTable& annulus, const sensors::OmniCamera& camera, double bin_rad, double horizon_px);

  /// Memory for so many hits, and as many lines as they can be expected to make.
  void reserve(std::size_t hits);

  /// On how many circles a line can be seen, by azimuth: again where the table has been made anew.
  void count_usable_rows(const AnnulusTable& annulus);

  /// Sorts the hits into bins.
  void count(std::span<const EdgeHit> hits);

  /// Local maxima of three neighbouring bins' votes, most votes first.
  /// \param least_share         of the usable circles
  /// \param least_chance_sigmas  votes beyond the expected number of scattered hits, in its standard deviations
  [[nodiscard]] const std::vector<LinePeak>& peaks(double least_share, double least_chance_sigmas);

  /// The unused hits near a peak as points relative to its azimuth, by row.
  /// \returns the median of those in the three bins.
  double gather(const LinePeak& peak, double window_rad, RadialPoints& points);

  /// Takes the hits of a fitted line out of the game.
  void use_up(const LinePeak& peak, const RadialFit& fit, double window_rad, double own_rad);

  /// Circles on which a line at this azimuth can be seen; at least 1.
  [[nodiscard]] double usable_rows(double azimuth) const;

  /// Where an azimuth points to.
  struct Direction {
    Eigen::Vector2d in_image;  ///< image_direction()
    Eigen::Vector2d in_base;
  };
  /// Of the middle of the azimuth's bin.
  [[nodiscard]] const Direction& direction(double azimuth) const { return directions_[bin_of(azimuth)]; }

 private:
  /// \param azimuth  in [-2 pi, 4 pi)
  [[nodiscard]] int bin_of(double azimuth) const {
    const int turned = static_cast<int>(azimuth * (bins_ / geometry::kTurn) + bins_);  // rounded down: not below 0
    return wrapped(turned - bins_);
  }
  [[nodiscard]] int wrapped(int bin) const { return bin < 0 ? bin + bins_ : bin < bins_ ? bin : bin - bins_; }
  [[nodiscard]] int slot_of(int polarity, int bin) const { return (polarity > 0 ? bins_ : 0) + bin; }
  void sort_near_by_row();
  template <class Visit>
  void for_each_near(const LinePeak& peak, double window_rad, Visit&& visit) const;

  int bins_ = 0;
  std::vector<Direction> directions_;  ///< by bin
  std::vector<int> usable_rows_;       ///< by bin
  std::vector<double> levers_;         ///< RadialPoint::lever by row
  std::vector<std::int32_t> slots_;    ///< by hit as counted
  std::vector<int> begin_;             ///< by slot, one more than there are: first of its hits in hits_
  std::vector<EdgeHit> hits_;          ///< by slot, then row
  std::vector<std::uint8_t> used_;     ///< by hit
  std::vector<LinePeak> peaks_;
  // Scratch of gather().
  std::vector<double> middle_;
  std::vector<std::int32_t> near_, by_row_;  ///< indices into hits_
  std::vector<int> begin_of_row_;
};

}  // namespace credo::perception
