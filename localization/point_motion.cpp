// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/point_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/segment.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

struct Centres {
  Vector2d before = Vector2d::Zero();
  Vector2d now = Vector2d::Zero();
};

Centres centres_of(std::span<const PointPair> pairs) {
  Centres sum;
  for (const PointPair& pair : pairs) {
    sum.before += pair.before;
    sum.now += pair.now;
  }
  const double n = static_cast<double>(pairs.size());
  return {sum.before / n, sum.now / n};
}

[[noreturn]] void refuse(std::span<const PointPair> pairs, const char* found) {
  throw std::invalid_argument("a motion needs matched points at two places or more, found " +
                              std::to_string(pairs.size()) + " pairs" + found);
}

/// Points nearer to their centre than rounding can tell are one: before the motion, or after it.
bool at_one_place(std::span<const PointPair> pairs, const Centres& centre) {
  double before = 0.0, now = 0.0, scale = 0.0;
  for (const PointPair& pair : pairs) {
    before = std::max(before, (pair.before - centre.before).norm());
    now = std::max(now, (pair.now - centre.now).norm());
    scale = std::max({scale, pair.before.norm(), pair.now.norm()});
  }
  return std::min(before, now) <= 1e-12 * scale;
}

}  // namespace

PointMotion point_motion(std::span<const PointPair> pairs) {
  if (pairs.size() < 2) refuse(pairs, "");
  const Centres centre = centres_of(pairs);
  if (!centre.before.allFinite() || !centre.now.allFinite()) refuse(pairs, ", not all finite");
  if (at_one_place(pairs, centre)) refuse(pairs, " at a single place");
  // Li X. 2006, eqs. (14), (15), solved: the turn about the centres, then the shift between them.
  double along = 0.0, across = 0.0;
  for (const PointPair& pair : pairs) {
    const Vector2d a = pair.now - centre.now, b = pair.before - centre.before;
    along += a.dot(b);
    across += geometry::cross(a, b);
  }
  const double dtheta = std::atan2(across, along);
  const Vector2d shift = centre.now - geometry::Pose2{0.0, 0.0, -dtheta} * centre.before;
  return {shift.x(), shift.y(), dtheta};
}

geometry::PoseEstimate point_motion_estimate(std::span<const PointPair> pairs) {
  const geometry::Pose2 T = point_motion(pairs).T_before_now();
  const Eigen::Matrix2d R = T.rotation();
  const Vector2d centre = R * centres_of(pairs).now;
  // Of the residual before - T now by T, turned about the centre: H^-1 (sum J^T C J) H^-1 with H = sum J^T J, diagonal.
  Eigen::Vector3d H = Eigen::Vector3d::Zero();
  Matrix3d spread = Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    const Vector2d turned = R * pair.now - centre;
    Eigen::Matrix<double, 2, 3> J;
    J << 1.0, 0.0, -turned.y(), 0.0, 1.0, turned.x();
    H += J.colwise().squaredNorm().transpose();
    spread += J.transpose() * (pair.before_covariance + R * pair.now_covariance * R.transpose()) * J;
  }
  // A turn about the centre shifts the origin.
  Matrix3d about_origin = Matrix3d::Identity();
  about_origin.topRightCorner<2, 1>() << centre.y(), -centre.x();
  const Matrix3d to_pose = about_origin * H.cwiseInverse().asDiagonal();
  return {T, to_pose * spread * to_pose.transpose()};
}

}  // namespace credo::localization
