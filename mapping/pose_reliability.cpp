// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/pose_reliability.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/principal_axes.hpp"

namespace credo::mapping {

void require_usable(const geometry::PoseEstimate& T_map_base) {
  const auto& [pose, covariance] = T_map_base;
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.theta))
    throw std::invalid_argument("a pose that readings are mapped from is not finite: leave its readings out");
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0.0)
    throw std::invalid_argument(
        "the covariance of a pose is not finite or has a negative variance: leave its readings out");
}

PoseReliability::PoseReliability(const evidence::Believed<geometry::PoseEstimate>& T_map_base, double resolution_m,
                                 const PoseReliabilityParams& params, double share) {
  require_usable(T_map_base.value);
  const Eigen::Matrix3d& covariance = T_map_base.value.covariance;
  if (!(params.half_at_sigma_cells > 0.0)) throw std::invalid_argument("half_at_sigma_cells must be above 0");

  const double pignistic = T_map_base.belief.pignistic();
  if (!(pignistic >= params.min_pignistic)) return;
  belief_ = share * std::min(pignistic, 1.0);
  const double position_variance = geometry::largest_variance(covariance.topLeftCorner<2, 2>());
  const double half = params.half_at_sigma_cells * resolution_m;
  constexpr double kMost = 1e30;  // as good as infinite, also as a float
  position_share_ = std::min(position_variance / (half * half), kMost);
  heading_share_ = std::min(covariance(2, 2) / (half * half), kMost);
}

}  // namespace credo::mapping
