// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "mapping/laser_model.hpp"

namespace credo::mapping {

struct BayesLaserParams {
  Li2006LaserParams matched;  ///< one reading gives the same probability as this one's pignistic one
};

/// The baseline: the inverse sensor model of an occupancy grid, which adds log-odds. Free space, the occupied interval
/// and its widening are those of an evidential model, and its probabilities that one's pignistic ones, discounted by
/// its reliability. As masses: simple ones whose weight is the log-odds, so that the rule `bayes` reads the filter's
/// probability. Where a pose or a repetition discounts further, the mass is discounted.
class BayesLaser {
 public:
  /// \throws std::invalid_argument as Li2006Laser
  explicit BayesLaser(const BayesLaserParams& params = {});

  [[nodiscard]] evidence::GridMass free_mass() const { return free_; }
  [[nodiscard]] evidence::GridMass hit_mass() const { return hit_; }
  [[nodiscard]] double free_margin(double reading_m, const sensors::RangeNoise& noise) const {
    return matched_.free_margin(reading_m, noise);
  }
  [[nodiscard]] double half_width(double reading_m, const sensors::RangeNoise& noise) const {
    return matched_.half_width(reading_m, noise);
  }
  [[nodiscard]] double hit_share(double reading_m, const sensors::RangeNoise& noise) const;
  [[nodiscard]] double reliability() const;

 private:
  Li2006Laser matched_;
  evidence::GridMass free_, hit_;
};
static_assert(LaserModel<BayesLaser>);

}  // namespace credo::mapping
