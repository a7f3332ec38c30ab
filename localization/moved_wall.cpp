// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/moved_wall.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace credo::localization {

bool WallFootprint::carries(tracking::LandmarkId landmark) const {
  return std::any_of(corners.begin(), corners.end(), [landmark](const Corner& c) { return c.point == landmark; });
}

std::vector<WallFootprint> wall_footprints(const LandmarkMap& map) {
  std::vector<WallFootprint> footprints;
  for (std::size_t w = 0; w < map.walls().size(); ++w) {
    const WallLandmark& wall = map.walls()[w];
    WallFootprint footprint{wall.normal(), map.own_column(map.wall_id(w)), {}};
    for (std::size_t p = 0; p < map.points().size(); ++p) {
      const int junction = map.points()[p].plan_term.junction;
      const bool on_it = std::any_of(wall.plan_terms.begin(), wall.plan_terms.end(),
                                     [junction](const PlanTerm& term) { return term.junction == junction; });
      if (on_it) footprint.corners.push_back({map.point_id(p), map.own_column(map.point_id(p))});
    }
    footprints.push_back(std::move(footprint));
  }
  return footprints;
}

BelievedWall believed_wall(const WallFootprint& wall, const PoseSolution& solution,
                           const PoseState::Matrix& prior_covariance) {
  // 1 / s: an error of a thousand standard deviations.
  constexpr double kAnySize = 1e-6;
  PoseState::Pair c = solution.prior_with_plan[wall.column];
  for (const WallFootprint::Corner& corner : wall.corners)
    c.col(0) += solution.prior_with_plan[corner.column] * wall.normal;
  const PoseState::Pair drawn = solution.prior_information * c;  // P^-1 c
  const Eigen::Matrix2d size = drawn.transpose() * prior_covariance * drawn + kAnySize * Eigen::Matrix2d::Identity();
  BelievedWall believed;
  believed.by_state = drawn.transpose();
  believed.information = size.inverse();
  believed.weighted_residual = believed.information * (believed.by_state * solution.step);
  return believed;
}

}  // namespace credo::localization
