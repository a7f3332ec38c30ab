// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "localization/landmark_map.hpp"
#include "localization/pose_solver.hpp"

namespace credo::localization {

struct ObservationParams {
  double min_bearing_sigma_rad = 0.001;  ///< floor of a radial line's sigma: what its fit cannot know
  double min_wall_sigma_m = 0.002;       ///< floor of a wall's offset: skirting, wallpaper, interference of the beam
  double min_wall_sigma_rad = 0.002;
  /// How far a landmark is from where the plan's junctions have it, the same in every acquisition: plaster and frames,
  /// and what the instruments always make of it. Chosen so that the NEES of simulated drives is about 3.
  double as_built_sigma_m = 0.005;
  double as_built_sigma_rad = 0.001;  ///< of a wall
};

/// A primitive that is a wall of the map. The observation views the landmark's plan terms.
[[nodiscard]] Observation observe_wall(const perception::Primitive& wall, const WallLandmark& landmark,
                                       const geometry::Pose2& pose, double plan_uncertainty_m,
                                       const ObservationParams& params = {});

/// A primitive that is a point of the map. Where the walls that meet in it are used for the pose already
/// (`wall_in_use`, by segment), only what they do not say is taken: the camera's bearing if there is one, else the
/// position along them. The observation views the landmark's plan term.
[[nodiscard]] Observation observe_point(const perception::Scene& scene, const perception::Primitive& point,
                                        const PointLandmark& landmark, const std::vector<bool>& wall_in_use,
                                        double plan_uncertainty_m, const ObservationParams& params = {});

/// Derivative by the pose (x, y, theta) of where a fixed point of the map lies in the base frame.
/// \param in_base  the point in the base frame [m]
[[nodiscard]] Eigen::Matrix<double, 2, 3> base_coordinates_by_pose(const geometry::Pose2& pose,
                                                                   const Eigen::Vector2d& in_base);

}  // namespace credo::localization
