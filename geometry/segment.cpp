// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/segment.hpp"

#include <algorithm>
#include <ostream>

namespace credo::geometry {

Segment operator*(const Pose2& T_a_b, const Segment& segment_b) { return {T_a_b * segment_b.a, T_a_b * segment_b.b}; }

double distance(const Eigen::Vector2d& p, const Segment& segment) {
  const Eigen::Vector2d along = segment.b - segment.a;
  const double squared_length = along.squaredNorm();
  if (squared_length == 0.0) return (p - segment.a).norm();
  const double share = std::clamp((p - segment.a).dot(along) / squared_length, 0.0, 1.0);
  return (p - segment.a - share * along).norm();
}

std::ostream& operator<<(std::ostream& out, const Segment& segment) {
  return out << "[" << segment.a.x() << ", " << segment.a.y() << " .. " << segment.b.x() << ", " << segment.b.y()
             << "]";
}

}  // namespace credo::geometry
