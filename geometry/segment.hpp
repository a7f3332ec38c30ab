// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <iosfwd>

#include "geometry/pose.hpp"

namespace credo::geometry {

/// The sine of the angle from a to b times their lengths: positive where b lies counter-clockwise of a.
[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A straight piece between two points. [m]
struct Segment {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();

  [[nodiscard]] double length() const { return (b - a).norm(); }
  [[nodiscard]] Eigen::Vector2d centre() const { return 0.5 * (a + b); }
  /// Unit vector from a to b. Precondition: length() > 0.
  [[nodiscard]] Eigen::Vector2d direction() const { return (b - a).normalized(); }
  /// direction() turned by +90 degrees.
  [[nodiscard]] Eigen::Vector2d normal() const {
    const Eigen::Vector2d d = direction();
    return {-d.y(), d.x()};
  }
  friend bool operator==(const Segment&, const Segment&) = default;
};

[[nodiscard]] Segment operator*(const Pose2& T_a_b, const Segment& segment_b);

/// Distance of p to the nearest point of the segment, ends included. [m]
[[nodiscard]] double distance(const Eigen::Vector2d& p, const Segment& segment);

/// A line estimated from points: through `centroid` with direction angle `angle`; the errors across the line at the
/// centroid and in the angle are independent (Pfister et al., ICRA 2003).
struct LineEstimate {
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double angle = 0.0;         ///< direction of the line, modulo pi [rad]
  double sigma_across = 0.0;  ///< 1-sigma of the centroid across the line [m]
  double sigma_angle = 0.0;   ///< 1-sigma [rad]

  [[nodiscard]] Eigen::Vector2d direction() const { return {std::cos(angle), std::sin(angle)}; }
  [[nodiscard]] Eigen::Vector2d normal() const { return {-std::sin(angle), std::cos(angle)}; }
  /// The point of the line that is nearest to `point`.
  [[nodiscard]] Eigen::Vector2d foot_of(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d along = direction();
    return centroid + along.dot(point - centroid) * along;
  }
};

std::ostream& operator<<(std::ostream& out, const Segment& segment);

}  // namespace credo::geometry
