// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "mapping/knots.hpp"
#include "mapping/laser_model.hpp"

namespace credo::mapping {

/// What the weight of a hit depends on: linear between knots, constant beyond the first and the last one; but beyond
/// the last sigma it is as much less as the wall is less likely to be just there.
struct LaserKnots {
  static constexpr std::array<double, 5> kSigma{0.005, 0.01, 0.02, 0.04, 0.08};    ///< of the range [m]
  static constexpr std::array<double, 6> kReading{0.4, 1.0, 2.0, 3.5, 6.0, 10.0};  ///< [m]
  static constexpr std::size_t kCount = kSigma.size() * kReading.size();
};

/// A length of so much, or of so many sigma of the range, whichever is more.
struct NoiseLength {
  double least_m = 0.0;
  double sigmas = 0.0;

  [[nodiscard]] double of(double sigma_m) const { return std::max(least_m, sigmas * sigma_m); }
};

/// What a reading is worth.
struct LaserWeights {
  double free_weight = 0.0;         ///< of evidence for "empty"
  std::vector<double> hit_weights;  ///< for "occupied", LaserKnots::kCount of them; below 0 is none
};

/// How a cell takes a reading in: with all others that it has had, which repeat each other's errors, or by itself, as
/// rules do that forget (CellRule::kForgets).
enum class ReadingsTaken { kSummed, kAlone };

struct CalibratedLaserParams {
  NoiseLength free_margin;  ///< before the reading free space ends
  NoiseLength half_width;   ///< of the occupied interval, at most the margin
  LaserWeights summed;      ///< of a reading among all of a cell
  LaserWeights alone;       ///< of a reading by itself

  [[nodiscard]] const LaserWeights& weights(ReadingsTaken taken) const {
    return taken == ReadingsTaken::kAlone ? alone : summed;
  }
};

/// What `credo calibrate laser` learned in simulated buildings, with cells of 5 cm.
[[nodiscard]] CalibratedLaserParams default_calibrated_laser();

/// A laser model learned from readings whose truth is known: each reading adds a weight of evidence to a cell, the same
/// wherever space is free, and by range and sigma where it is occupied. The weights are those of a logistic regression
/// on all readings of a cell, which is Dempster's rule on simple masses (Denoeux 2019, "Logistic regression, neural
/// networks and Dempster-Shafer theory"), so that readings which repeat each other's errors count as what they are
/// worth together. Where free space ends and how wide a hit is are those under which the truth is likeliest. A rule
/// that forgets holds a few readings only, which are worth more each: its weights are those of a regression on cells in
/// single scans.
class CalibratedLaser {
 public:
  /// \throws std::invalid_argument if there are not LaserKnots::kCount finite weights, a weight or length is negative
  ///         (that of a hit may be), or the half-width exceeds the margin
  explicit CalibratedLaser(const CalibratedLaserParams& params = default_calibrated_laser(),
                           ReadingsTaken taken = ReadingsTaken::kSummed);

  [[nodiscard]] evidence::GridMass free_mass() const;
  [[nodiscard]] evidence::GridMass hit_mass() const;
  [[nodiscard]] double free_margin(double reading_m, const sensors::RangeNoise& noise) const {
    return free_margin_.of(noise.sigma(reading_m));
  }
  [[nodiscard]] double half_width(double reading_m, const sensors::RangeNoise& noise) const {
    return half_width_.of(noise.sigma(reading_m));
  }
  [[nodiscard]] double hit_share(double reading_m, const sensors::RangeNoise& noise) const;
  [[nodiscard]] double reliability() const;

 private:
  NoiseLength free_margin_, half_width_;
  LaserWeights weights_;
  double greatest_weight_ = 0.0;  // of a hit
};
static_assert(LaserModel<CalibratedLaser>);

/// Calls visit(index of the weight, share) for the weights of a hit that its evidence is the sum of.
template <typename Visit>
void for_each_hit_weight(double sigma_m, double reading_m, const Visit& visit) {
  const BetweenKnots noise = between(LaserKnots::kSigma, sigma_m), far = between(LaserKnots::kReading, reading_m);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double share =
          (i ? noise.share_of_high : 1.0 - noise.share_of_high) * (j ? far.share_of_high : 1.0 - far.share_of_high);
      if (share > 0.0) visit((noise.low + i) * LaserKnots::kReading.size() + far.low + j, share);
    }
}

}  // namespace credo::mapping
