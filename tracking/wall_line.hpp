// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>

#include "geometry/angles.hpp"
#include "geometry/pose.hpp"
#include "geometry/segment.hpp"

namespace credo::tracking {

/// A wall in normal form: { p : normal . p = distance }, seen from `begin` to `end` along it. Under a motion of the
/// frame angle, distance and ends change by sums only.
struct WallLine {
  double angle = 0.0;     ///< direction of the wall [rad]
  double distance = 0.0;  ///< signed, along normal() = direction() turned by +90 degrees [m]
  double begin = 0.0;     ///< along direction(), from the foot of the origin's perpendicular [m]
  double end = 0.0;       ///< >= begin [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (angle, distance)
  double variance_along = 0.0;                           ///< of the motion along the wall since it was seen [m^2]

  [[nodiscard]] Eigen::Vector2d direction() const { return {std::cos(angle), std::sin(angle)}; }
  [[nodiscard]] Eigen::Vector2d normal() const { return {-std::sin(angle), std::cos(angle)}; }
  [[nodiscard]] Eigen::Vector2d middle() const { return 0.5 * (begin + end) * direction() + distance * normal(); }
};

/// Line and extent as perception gives them.
[[nodiscard]] WallLine wall_line(const geometry::LineEstimate& line, const geometry::Segment& extent);

/// The wall of frame `a` in frame `b`, with first-order covariance.
[[nodiscard]] WallLine carry(const WallLine& wall_a, const geometry::PoseEstimate& T_a_b);

/// The same wall with its direction turned by pi where that brings it nearer to `reference`.
[[nodiscard]] WallLine aligned_with(const WallLine& wall, const WallLine& reference);

/// How two walls lie to each other. Across is taken at the middle of what they share (or of the gap between them).
struct WallDifference {
  double angle = 0.0;    ///< seen - expected [rad]
  double across = 0.0;   ///< of `seen` from `expected`, along the normal of `expected` [m]
  double overlap = 0.0;  ///< length of the shared piece; minus the gap where there is none [m]
  double at = 0.0;       ///< where `across` was taken, along `expected` [m]
};
/// Precondition: `seen` is aligned with `expected`.
[[nodiscard]] WallDifference difference(const WallLine& seen, const WallLine& expected);

/// What even a perfect sensor and a perfect prediction leave: walls are not ideal lines. 1-sigma.
struct WallFloors {
  double angle_rad = geometry::to_radians(0.3);
  double across_m = 0.02;
  double gap_m = 0.10;  ///< ends move where something stands before the wall
};

/// Mahalanobis distance of the two lines (angle, distance across), and of the gap between their extents where they do
/// not overlap. Two walls that do overlap are no further apart for showing different pieces.
[[nodiscard]] double distance_in_sigmas(const WallLine& seen, const WallLine& expected,
                                        const WallDifference& difference, const WallFloors& floors);

}  // namespace credo::tracking
