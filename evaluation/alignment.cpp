// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/alignment.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

namespace credo::evaluation {
namespace {

Eigen::Matrix3Xd positions(const Trajectory& trajectory, std::size_t n) {
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) columns.col(static_cast<Eigen::Index>(i)) = trajectory.poses[i].position;
  return columns;
}

/// The rotation nearest to `covariance` among those of the plane: the angle that maximises trace(R^T C).
Eigen::Matrix3d planar_rotation(const Eigen::Matrix3d& covariance) {
  const double angle = std::atan2(covariance(1, 0) - covariance(0, 1), covariance(0, 0) + covariance(1, 1));
  return lift(0, {0.0, 0.0, angle}).rotation;
}

Eigen::Matrix3d spatial_rotation(const Eigen::JacobiSVD<Eigen::Matrix3d>& svd) {
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

Alignment umeyama(const Trajectory& reference, const Trajectory& estimate, bool with_scale, int n) {
  const std::size_t available = std::min(reference.poses.size(), estimate.poses.size());
  const std::size_t used = n < 0 ? available : std::min(available, static_cast<std::size_t>(n));
  if (used < 2) throw std::runtime_error("an alignment needs at least two poses: give a larger --n_to_align");
  const Eigen::Matrix3Xd x = positions(estimate, used), y = positions(reference, used);
  const Eigen::Vector3d mean_x = x.rowwise().mean(), mean_y = y.rowwise().mean();
  const Eigen::Matrix3Xd dx = x.colwise() - mean_x, dy = y.colwise() - mean_y;
  const Eigen::Matrix3d covariance = dy * dx.transpose() / static_cast<double>(used);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()[1] <= 1e-12 * std::max(1.0, svd.singularValues()[0])) {
    throw std::runtime_error(
        "the positions lie on a straight line (or do not move): an alignment cannot be found from them; use "
        "--align_origin, or no alignment");
  }
  Alignment fit;
  fit.rotation = is_planar(reference) && is_planar(estimate) ? planar_rotation(covariance) : spatial_rotation(svd);
  if (with_scale) {
    const double variance_x = dx.squaredNorm() / static_cast<double>(used);
    fit.scale = (fit.rotation.transpose() * covariance).trace() / variance_x;
  }
  fit.translation = mean_y - fit.scale * fit.rotation * mean_x;
  return fit;
}

Alignment align(AssociatedPair& pair, const AlignmentParams& params) {
  Alignment fit;
  if (params.align || params.correct_scale) {
    fit = umeyama(pair.reference, pair.estimate, params.correct_scale, params.n_to_align);
    if (!params.align) fit = {.scale = fit.scale};
  }
  for (StampedPose& pose : pair.estimate.poses) {
    pose.position = fit.scale * fit.rotation * pose.position + fit.translation;
    pose.rotation = fit.rotation * pose.rotation;
  }
  if (params.align_origin && !pair.estimate.poses.empty()) {
    const StampedPose first = pair.estimate.poses.front(), goal = pair.reference.poses.front();
    const Eigen::Matrix3d turn = goal.rotation * first.rotation.transpose();
    const Eigen::Vector3d shift = goal.position - turn * first.position;
    for (StampedPose& pose : pair.estimate.poses) {
      pose.position = turn * pose.position + shift;
      pose.rotation = turn * pose.rotation;
    }
    fit = {.scale = fit.scale, .rotation = turn * fit.rotation, .translation = turn * fit.translation + shift};
  }
  return fit;
}

std::string describe(const AlignmentParams& params) {
  std::string text;
  if (params.align && params.correct_scale)
    text = "(with Sim(3) Umeyama alignment)";
  else if (params.align)
    text = "(with SE(3) Umeyama alignment)";
  else if (params.correct_scale)
    text = "(scale corrected)";
  else if (!params.align_origin)
    text = "(not aligned)";
  if ((params.align || params.correct_scale) && params.n_to_align >= 0) {
    text += " (aligned poses: " + std::to_string(params.n_to_align) + ")";
  }
  if (params.align_origin) text += (text.empty() ? "" : "\n") + std::string("(with origin alignment)");
  return text;
}

}  // namespace credo::evaluation
