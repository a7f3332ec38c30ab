// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/pose.hpp"

namespace credo::sensors {

/// How dead reckoning drifts, 1-sigma.
struct OdometryNoise {
  double translation_per_metre = 0.03;
  double rotation_per_metre = 0.02;
  double rotation_per_radian = 0.03;

  /// Covariance of a measured motion T_from_to, in the frame `from`, plus a floor of 1 mm and 0.5 mrad so that a robot
  /// at rest keeps an invertible covariance.
  [[nodiscard]] geometry::PoseEstimate with_covariance(const geometry::Pose2& T_from_to) const;

  friend bool operator==(const OdometryNoise&, const OdometryNoise&) = default;
};

}  // namespace credo::sensors
