// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>

#include "evidence/believed.hpp"
#include "geometry/pose.hpp"

namespace credo::mapping {

struct PoseReliabilityParams {
  /// Below this pignistic probability of a right pose nothing is mapped: at 0.5, a pose with more belief against it
  /// than for it (lost) maps nothing, and one that nothing is known of maps at half strength.
  double min_pignistic = 0.5;
  /// A position error of this many cells (1-sigma, at the reading) halves what is mapped.
  double half_at_sigma_cells = 1.0;
};

/// Whether readings can be mapped from a pose at all.
/// \throws std::invalid_argument if the pose or its covariance is not finite or a variance is negative; the message
///         says to leave the reading out.
void require_usable(const geometry::PoseEstimate& T_map_base);

/// How far a reading taken from a pose is to be trusted in a grid: the discounting rates of that pose's readings by
/// range.
class PoseReliability {
 public:
  /// \param share  of the readings that counts, in [0, 1]: the reliability of their sensor, and how much of them is new
  /// \throws std::invalid_argument as require_usable, or if a parameter is out of range
  PoseReliability(const evidence::Believed<geometry::PoseEstimate>& T_map_base, double resolution_m,
                  const PoseReliabilityParams& params = {}, double share = 1.0);

  /// share * pignistic / (1 + (sigma / half)^2), with sigma^2 the larger variance of the position plus that of the
  /// heading times range^2; 0 where nothing is to be mapped. In [0, 1].
  template <std::floating_point Real>
  [[nodiscard]] Real at(Real range_m) const {
    return static_cast<Real>(belief_) /
           (Real{1} + static_cast<Real>(position_share_) + static_cast<Real>(heading_share_) * range_m * range_m);
  }
  [[nodiscard]] bool maps_nothing() const { return belief_ <= 0.0; }

 private:
  double belief_ = 0.0;  // and share
  double position_share_ = 0.0;
  double heading_share_ = 0.0;  // 1/m^2
};

}  // namespace credo::mapping
