// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "geometry/angles.hpp"
#include "tracking/prediction.hpp"

namespace credo::tracking {

/// When a wall and a corner, an edge or an other are the same landmark: one face of it was seen before, both are seen
/// now, or the other way round (Clerentin et al., sec. 4.4, fig. 16).
struct TransitionParams {
  double max_distance_m = 0.15;  ///< across the wall, and of the junction from its end
  double max_angle_rad = geometry::to_radians(10.0);
  double unmoved_m = 0.3;  ///< added where no motion carried the prediction: the step between two acquisitions
};

/// A junction: where it is and the faces that meet there. Base frame.
struct Junction {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::array<WallLine, 2> faces;
  int known_faces = 0;
};

/// Whether the wall is one of the junction's faces: the junction lies on the wall's line and not amid its extent, and
/// one of its faces is a piece of that line. A junction whose faces are not known has to lie at the wall's end.
/// \param slack_m  added to the lengths allowed
/// \returns how far the junction is from the wall's nearer end [m]; nothing where the two do not belong together
[[nodiscard]] std::optional<double> distance_from_end(const WallLine& wall, const Junction& junction, double slack_m,
                                                      const TransitionParams& params);

/// The junction that a primitive is. Precondition: neither a wall nor bearing-only.
[[nodiscard]] Junction seen_junction(const perception::Primitive& primitive, const perception::Scene& scene);

}  // namespace credo::tracking
