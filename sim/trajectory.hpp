// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <limits>
#include <vector>

#include "geometry/pose.hpp"
#include "geometry/segment.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// The true way of the robot: rests, straight pieces, curves and turns on the spot, each with its own profile of speed.
class Trajectory {
 public:
  /// \throws std::invalid_argument  for fewer than two waypoints that are apart.
  Trajectory(const std::vector<Waypoint>& path, const Drive& drive);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  /// T_map_base at `seconds` from the start; at rest before the start and after the end.
  [[nodiscard]] geometry::Pose2 pose_at(double seconds) const;
  /// The middle of each stop [s]; empty when driving continuously.
  [[nodiscard]] const std::vector<double>& stops() const { return stops_; }
  /// When the robot was carried away [s].
  [[nodiscard]] const std::vector<double>& carried() const { return carried_; }
  /// What is driven over in a part of the drive, without the times: straight lines, and chords of curves that are at
  /// most 0.05 rad long. A place where the robot is at first, or is set down, is a stretch of no length.
  [[nodiscard]] std::vector<geometry::Segment> stretches(double from_s = 0.0,
                                                         double to_s = std::numeric_limits<double>::infinity()) const;

 private:
  /// Moves `length` along a circle of `curvature` (0 = straight; or turns by `turn` on the spot) from `start`.
  struct Piece {
    double begin_s, duration_s;
    geometry::Pose2 start;
    double length_m, turn_rad;
    double ramp_s;  ///< time to reach full speed, and to stop again
  };
  void rest(double seconds);
  void stop(const Drive& drive);
  void turn_to(double heading, const Drive& drive);
  void drive_straight(double length_m, const Drive& drive);
  void drive_route(const std::vector<Eigen::Vector2d>& route, const Drive& drive);
  void drive_steps(double length_m, const Drive& drive);
  void add(double length_m, double turn_rad, double duration_s, double ramp_s);
  void end_at(double seconds);
  [[nodiscard]] static double share_at(const Piece& piece, double seconds);
  [[nodiscard]] static geometry::Pose2 at_end(const Piece& piece, double share);

  std::vector<Piece> pieces_;
  geometry::Pose2 here_;
  double duration_s_ = 0.0;
  double since_stop_m_ = 0.0;
  std::vector<double> stops_;
  std::vector<double> carried_;
};

}  // namespace credo::sim
