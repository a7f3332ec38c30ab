// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "geometry/pose.hpp"
#include "sensors/time.hpp"

namespace credo::sensors {

/// One row of dead reckoning: the pose of the robot base in the odometry's own, drifting frame.
struct OdometryReading {
  Timestamp time = 0;
  geometry::Pose2 T_odom_base;

  friend bool operator==(const OdometryReading&, const OdometryReading&) = default;
};

/// How the robot moved during a stretch of time, in a frame of its own: what carries a reading from when it was taken
/// to another moment. Interpolates between its rows; before the first and after the last row it continues with the
/// velocity of the neighbouring interval, for at most `kLongestExtrapolation`, and rests then.
class MotionPath {
 public:
  static constexpr Timestamp kLongestExtrapolation = 500'000'000;  // ns

  MotionPath() = default;
  /// \param rows  times that do not decrease; of equal times the last row counts.
  /// \throws std::invalid_argument if a time decreases or a pose is not finite.
  explicit MotionPath(std::vector<OdometryReading> rows);

  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] const std::vector<OdometryReading>& rows() const { return rows_; }

  /// The pose at `time` in the path's frame; the identity where the path is empty.
  [[nodiscard]] geometry::Pose2 pose_at(Timestamp time) const;

  /// T_from_to: coordinates in the base at `to` mapped into the base at `from`.
  [[nodiscard]] geometry::Pose2 motion(Timestamp from, Timestamp to) const {
    return pose_at(from).inverse() * pose_at(to);
  }

 private:
  std::vector<OdometryReading> rows_;
};

}  // namespace credo::sensors
