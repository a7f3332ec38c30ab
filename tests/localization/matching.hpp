// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <numeric>
#include <vector>

#include "localization/map_matching.hpp"
#include "tests/localization/sightings.hpp"

// A room and what of a scene is matched to it.
namespace credo::localization::test {

/// A room of 6 m x 4 m. Its walls are landmarks 0 to 3, its corners 4 to 7 from (0, 0) counter-clockwise; marks follow.
inline geometry::FloorPlan room(const std::vector<Eigen::Vector2d>& marks = {}) {
  geometry::FloorPlan plan;
  plan.walls = {{{0, 0}, {6, 0}}, {{6, 0}, {6, 4}}, {{6, 4}, {0, 4}}, {{0, 4}, {0, 0}}};
  plan.verticals = marks;
  return plan;
}
inline constexpr tracking::LandmarkId kFirstCorner = 4, kFirstMark = 8;

inline geometry::PoseEstimate believed(const geometry::Pose2& pose, double sigma_m = 0.03, double sigma_rad = 0.01) {
  geometry::PoseEstimate estimate{pose, Eigen::Matrix3d::Zero()};
  estimate.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return estimate;
}

/// One matching of a scene that holds nothing else than `seen`.
struct Matching {
  geometry::FloorPlan plan = room();
  geometry::PoseEstimate pose = believed(kPose);
  MapMatchingParams params;
  LandmarkMapParams map_params;
  Eigen::Vector2d camera_origin = Eigen::Vector2d::Zero();

  [[nodiscard]] std::vector<MapMatch> walls(const std::vector<Primitive>& seen) const {
    const LandmarkMap map(plan, map_params);
    return MapMatcher(map, params).match_walls(scene(seen), all(seen), pose);
  }
  [[nodiscard]] std::vector<MapMatch> points(const std::vector<Primitive>& seen,
                                             const std::vector<tracking::LandmarkId>& taken = {}) const {
    const LandmarkMap map(plan, map_params);
    return MapMatcher(map, params).match_points(scene(seen), all(seen), pose, taken);
  }

 private:
  [[nodiscard]] perception::Scene scene(const std::vector<Primitive>& seen) const {
    perception::Scene result;
    result.camera_origin = camera_origin;
    result.primitives = seen;
    return result;
  }
  static std::vector<int> all(const std::vector<Primitive>& seen) {
    std::vector<int> indices(seen.size());
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
  }
};

inline Matching by(perception::Method method) {
  Matching matching;
  matching.params.method = method;
  return matching;
}

}  // namespace credo::localization::test
