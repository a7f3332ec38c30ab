// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "localization/landmark_map.hpp"
#include "localization/pose_solver.hpp"

namespace credo::localization {

/// What a wall takes along when it does not stand where the plan has it: the points on its line, that is its ends and
/// where others meet it.
struct WallFootprint {
  struct Corner {
    tracking::LandmarkId point = tracking::kNoLandmark;
    int column = 0;  ///< of CalibratedPose::with_plan: the first of its own two errors
  };
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();
  int column = 0;  ///< likewise of the wall
  std::vector<Corner> corners;

  [[nodiscard]] bool carries(tracking::LandmarkId landmark) const;
};

/// By LandmarkMap::wall_id.
[[nodiscard]] std::vector<WallFootprint> wall_footprints(const LandmarkMap& map);

/// What a wall that stands aside, has always stood there and has been believed has told the prior, as an observation of
/// the state: one row for a shift of the wall and all it carries, one for a turn of the wall.
struct BelievedWall {
  PoseState::Jacobian by_state;
  Eigen::Matrix2d information;        ///< of all that the prior knows, what goes with the wall
  Eigen::Vector2d weighted_residual;  ///< of it, at the solution
};

/// The prior's covariance with the wall's error, c, is how far an error of one standard deviation has drawn the state.
/// Were it of any size, the prior's information would be (P + c c^T s)^-1, s growing: P^-1 - P^-1 c (c^T P^-1 c)^-1
/// c^T P^-1.
/// \param solution          with PoseSolution::prior_with_plan
/// \param prior_covariance  the inverse of PoseSolution::prior_information
[[nodiscard]] BelievedWall believed_wall(const WallFootprint& wall, const PoseSolution& solution,
                                         const PoseState::Matrix& prior_covariance);

}  // namespace credo::localization
