// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

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
  LineVotes(const AnnulusTable& annulus, const sensors::OmniCamera& camera, double bin_rad);

  /// Sorts the hits into bins. The indices into `hits` hold until the next call.
  void count(const std::vector<EdgeHit>& hits);

  /// Local maxima of three neighbouring bins' votes, most votes first.
  /// \param least_share         of the usable circles
  /// \param least_chance_sigmas  votes beyond the expected number of scattered hits, in its standard deviations
  [[nodiscard]] const std::vector<LinePeak>& peaks(double least_share, double least_chance_sigmas);

  /// The unused hits near a peak as points relative to its azimuth, by row.
  /// \returns the median of those in the three bins.
  double gather(const std::vector<EdgeHit>& hits, const AnnulusTable& annulus, const LinePeak& peak, double window_rad,
                double horizon_px, std::vector<RadialPoint>& points);

  /// Takes the hits of a fitted line out of the game.
  void use_up(const std::vector<EdgeHit>& hits, const AnnulusTable& annulus, const LinePeak& peak, const RadialFit& fit,
              double window_rad, double own_rad, double horizon_px);

  /// Circles on which a line at this azimuth can be seen; at least 1.
  [[nodiscard]] double usable_rows(double azimuth) const;

  /// image_direction() of the middle of the bin.
  [[nodiscard]] const Eigen::Vector2d& image_direction(double azimuth) const { return in_image_[bin_of(azimuth)]; }
  /// Cosine and sine of the azimuth of the middle of the bin.
  [[nodiscard]] const Eigen::Vector2d& direction(double azimuth) const { return directions_[bin_of(azimuth)]; }

 private:
  [[nodiscard]] int bin_of(double azimuth) const;  ///< azimuth in [-2 pi, 4 pi)
  [[nodiscard]] int slot_of(int polarity, int bin) const { return (polarity > 0 ? bins_ : 0) + bin; }
  template <class Visit>
  void for_each_near(const LinePeak& peak, double window_rad, Visit&& visit) const;

  int bins_ = 0;
  std::vector<Eigen::Vector2d> in_image_;    ///< by bin
  std::vector<Eigen::Vector2d> directions_;  ///< by bin
  std::vector<int> usable_rows_;             ///< by bin
  std::vector<int> begin_;                   ///< by slot, one more than there are: first of its hits in order_
  std::vector<std::int32_t> order_;          ///< indices of hits, by slot, then row
  std::vector<std::uint8_t> used_;           ///< by hit
  std::vector<LinePeak> peaks_;
  std::vector<double> middle_;  ///< scratch of gather()
};

}  // namespace credo::perception
