// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>

#include "sensors/odometry.hpp"
#include "sim/failures.hpp"
#include "sim/random.hpp"

namespace credo::sim {

/// Dead reckoning that drifts as OdometryNoise says, at whatever rate it is read: each of the three errors is in equal
/// parts constant for the drive (wheel diameters, track) and wandering over a metre of way (the floor).
class OdometrySimulator {
 public:
  OdometrySimulator(const sensors::OdometryNoise& noise, std::uint64_t seed);

  /// The odometry's pose after the true motion T_from_to; starts at the identity.
  /// \param condition  of the wheels: `noise` adds to the errors, `scale` is of the way counted
  /// \param slip_m     way that the wheels turned and the robot did not go
  geometry::Pose2 advance(const geometry::Pose2& T_from_to, const Condition& condition = {}, double slip_m = 0.0);

 private:
  struct Error {
    double fixed = 0.0, wandering = 0.0;
    [[nodiscard]] double value() const { return fixed + wandering; }
  };
  sensors::OdometryNoise noise_;
  Random random_, extra_;
  Error translation_, rotation_, turning_;
  geometry::Pose2 T_odom_base_;
};

}  // namespace credo::sim
