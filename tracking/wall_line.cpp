// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/wall_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace credo::tracking {

WallLine wall_line(const geometry::LineEstimate& line, const geometry::Segment& extent) {
  WallLine wall;
  wall.angle = geometry::wrap_angle(line.angle);
  const Eigen::Vector2d along = wall.direction();
  wall.distance = wall.normal().dot(line.centroid);
  std::tie(wall.begin, wall.end) = std::minmax({along.dot(extent.a), along.dot(extent.b)});
  // The errors at the centroid are independent; seen from the origin, an error of the angle moves the distance with the
  // centroid's arm: d = n(angle) . c, dn/dangle = -direction.
  const double arm = along.dot(line.centroid);
  const double angle_variance = line.sigma_angle * line.sigma_angle;
  wall.covariance << angle_variance, -arm * angle_variance, -arm * angle_variance,
      line.sigma_across * line.sigma_across + arm * arm * angle_variance;
  return wall;
}

WallLine carry(const WallLine& wall_a, const geometry::PoseEstimate& T_a_b) {
  const Eigen::Vector2d t = T_a_b.pose.translation(), along = wall_a.direction(), normal = wall_a.normal();
  WallLine wall_b = wall_a;
  const double shift_along = along.dot(t);
  wall_b.angle = geometry::wrap_angle(wall_a.angle - T_a_b.pose.theta);
  wall_b.distance = wall_a.distance - normal.dot(t);
  wall_b.begin -= shift_along;
  wall_b.end -= shift_along;
  Eigen::Matrix2d by_wall;
  by_wall << 1.0, 0.0, shift_along, 1.0;
  Eigen::Matrix<double, 2, 3> by_motion;
  by_motion << 0.0, 0.0, -1.0, -normal.x(), -normal.y(), 0.0;
  wall_b.covariance =
      by_wall * wall_a.covariance * by_wall.transpose() + by_motion * T_a_b.covariance * by_motion.transpose();
  wall_b.variance_along += along.dot(T_a_b.covariance.topLeftCorner<2, 2>() * along);
  return wall_b;
}

WallLine aligned_with(const WallLine& wall, const WallLine& reference) {
  if (std::abs(geometry::angle_difference(wall.angle, reference.angle)) <= 0.5 * std::numbers::pi) return wall;
  WallLine turned = wall;
  turned.angle = geometry::wrap_angle(wall.angle + std::numbers::pi);
  turned.distance = -wall.distance;
  turned.begin = -wall.end;
  turned.end = -wall.begin;
  turned.covariance(0, 1) = turned.covariance(1, 0) = -wall.covariance(0, 1);
  return turned;
}

WallDifference difference(const WallLine& seen, const WallLine& expected) {
  WallDifference result;
  result.angle = geometry::angle_difference(seen.angle, expected.angle);
  const double c = std::cos(result.angle), sine = std::sin(result.angle);
  // The ends of `seen`, along `expected`.
  const double begin = seen.begin * c - seen.distance * sine, end = seen.end * c - seen.distance * sine;
  const double from = std::max(begin, expected.begin), to = std::min(end, expected.end);
  result.overlap = to - from;
  result.at = 0.5 * (from + to);
  // The point x = at t + d n of the expected line is moved along n until n_seen . x = d_seen.
  result.across = (seen.distance - expected.distance * c + result.at * sine) / c;
  return result;
}

double distance_in_sigmas(const WallLine& seen, const WallLine& expected, const WallDifference& difference,
                          const WallFloors& floors) {
  // Covariance of (angle, across), from that of (angle, distance): across = distance + at * angle.
  const Eigen::Matrix2d P = seen.covariance + expected.covariance;
  const double s = difference.at;
  const double angle_variance = P(0, 0) + floors.angle_rad * floors.angle_rad;
  const double mixed = P(0, 1) + s * P(0, 0);
  const double across_variance = P(1, 1) + 2.0 * s * P(0, 1) + s * s * P(0, 0) + floors.across_m * floors.across_m;
  const double squared =
      (across_variance * difference.angle * difference.angle - 2.0 * mixed * difference.angle * difference.across +
       angle_variance * difference.across * difference.across) /
      (angle_variance * across_variance - mixed * mixed);
  const double gap = std::max(0.0, -difference.overlap);
  const double gap_variance = seen.variance_along + expected.variance_along + floors.gap_m * floors.gap_m;
  return std::sqrt(std::max(0.0, squared) + gap * gap / gap_variance);
}

}  // namespace credo::tracking
