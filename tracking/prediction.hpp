// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <optional>

#include "geometry/angles.hpp"
#include "perception/observer.hpp"
#include "tracking/extrapolation.hpp"
#include "tracking/polar_point.hpp"
#include "tracking/wall_line.hpp"

namespace credo::tracking {

/// How what was seen is carried to the coming scene.
struct PredictionParams {
  /// Observations that the azimuth is extrapolated from (N_mes): under the paper's method, and in the default one where
  /// there is no motion. Two follow a landmark that is passed closely better than three (docs/equations.md). 1..8
  int observations_paper = 2;
  int observations = 2;
  /// What is expected of a robot that reports no motion, from one acquisition to the next, 1-sigma: how far it drives
  /// (that of Clerentin et al., sec. 5), how far it turns, and by how much the turn differs from the one before.
  double expected_step_m = 0.3;
  double expected_turn_rad = geometry::to_radians(10.0);
  double expected_turn_change_rad = geometry::to_radians(2.0);
  /// A bearing without a range may belong to anything between here and infinity.
  double nearest_m = 0.5;
};

/// What a track is expected to look like, in the base frame of the scene to come (after an update: of the latest).
struct Prediction {
  PolarPoint point;  ///< of the position; a wall's is the middle of its extent
  WallLine wall;     ///< of a wall
  /// A junction's two faces, as far as they are known: what a wall may turn into, and back.
  std::array<WallLine, 2> faces;
  int known_faces = 0;
  /// The faces and the wall are where the robot saw them, not where it should see them now: no motion was known.
  bool unmoved = false;
};

/// A prediction with the past it rests on.
struct Memory {
  Prediction now;
  History azimuths;        ///< [rad]
  History wall_angles;     ///< [rad]
  History wall_distances;  ///< [m]
};

/// A point as it was seen, in the base frame: a range that was not measured is anything from `nearest_m` (3 sigma) to
/// infinity (1 sigma).
[[nodiscard]] PolarPoint seen_point(const perception::Primitive& primitive, const Eigen::Vector2d& camera_origin,
                                    const PredictionParams& params);

/// The lines of the segments that meet at a junction, one or two where the scene has them.
/// \returns their number
int known_faces(const perception::Primitive& primitive, const perception::Scene& scene, std::array<WallLine, 2>& faces);

/// Carries the memory one step on: along the motion where there is one (default method), otherwise by extrapolation.
/// \param step  number of the coming scene, growing by one
void predict(Memory& memory, const perception::Primitive& last_seen,
             const std::optional<geometry::PoseEstimate>& motion, int step, perception::Method method,
             const PredictionParams& params);

/// Takes in what was seen. A bearing without a range keeps and sharpens the range that was known before.
/// \param first  nothing is known from before
void observe(Memory& memory, const perception::Primitive& primitive, const perception::Scene& scene, int step,
             bool first, const PredictionParams& params);

}  // namespace credo::tracking
