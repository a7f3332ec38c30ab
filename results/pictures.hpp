// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "geometry/floor_plan.hpp"
#include "grids/evidential_grid.hpp"
#include "localization/landmark_map.hpp"
#include "perception/scene.hpp"
#include "results/history.hpp"
#include "sensors/acquisition.hpp"
#include "tracking/track.hpp"

// Pictures of a run, for people. All are CV_8UC3.
namespace credo::results {

/// The image with the radial lines that were found, in the colours of the primitives that they belong to, and around it
/// the belief in what was seen in each direction.
[[nodiscard]] cv::Mat omni_picture(const sensors::OmniImage& image, const sensors::OmniCamera& camera,
                                   const perception::Scene& scene);

/// The scan from above, heading up: points, segments in the colour of their belief, and the primitives.
[[nodiscard]] cv::Mat scan_picture(const perception::Scene& scene, double robot_radius_m);

/// What a plan picture is drawn from.
struct PlanView {
  const geometry::FloorPlan& plan;                       ///< without walls: the trail alone
  const localization::LandmarkMap* landmarks = nullptr;  ///< to mark those that are matched
  std::span<const Moment> history;                       ///< up to the moment that is shown, the last one; never empty
  std::span<const tracking::Track> tracks;               ///< of the last moment
  double robot_radius_m = 0.25;
};

/// The plan with the trail, the pose with its 3-sigma ellipse, the tracks and the landmarks that they are matched to.
[[nodiscard]] cv::Mat plan_picture(const PlanView& view);

/// Errors of x, y and heading over time, in 3 sigma. Precondition: some moment has a truth.
[[nodiscard]] cv::Mat error_picture(std::span<const Moment> history);

/// The belief in the localization and in each track over time.
[[nodiscard]] cv::Mat belief_picture(std::span<const Moment> history);

/// Decisions and layers of a map; with the way of the robot.
[[nodiscard]] cv::Mat map_picture(const grids::EvidentialGrid& grid, std::span<const geometry::Pose2> way = {});

/// The map as a relief, seen from above one of its corners: the height is the belief in "occupied" after Dempster's
/// normalisation, the colour too; grey where nothing is known ("belief layout", Li X. 2006 and 2007, who draw the
/// unnormalised belief, which rises over empty ground as conflict accumulates).
[[nodiscard]] cv::Mat belief_relief(const grids::EvidentialGrid& grid);

/// map.png (map_picture), map_relief.png (belief_relief), and a map_LAYER.png with legend and scale for each of empty,
/// occupied, contested, unknown, conflict, plausibility, pignistic and dsmp.
/// \throws std::runtime_error if a file cannot be written
void write_map_pictures(const std::filesystem::path& folder, const grids::EvidentialGrid& grid,
                        std::span<const geometry::Pose2> way = {});

/// \throws std::runtime_error if the file cannot be written
void write_png(const std::filesystem::path& file, const cv::Mat& picture);

}  // namespace credo::results
