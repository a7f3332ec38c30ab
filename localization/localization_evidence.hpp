// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>

#include "localization/landmark_map.hpp"
#include "localization/pose_solver.hpp"
#include "perception/observer.hpp"
#include "tracking/track.hpp"

namespace credo::localization {

/// What the belief in a localization rests on.
struct LocalizationEvidence {
  int matched = 0;         ///< primitives that the pose rests on
  double detected = 0.0;   ///< against which the ratio is taken
  double explained = 0.0;  ///< of them, matched
  int in_sight = 0;        ///< points of the plan that should be seen from the pose
  int recognised = 0;      ///< of them, matched
  /// ScanAgreement::share of the raw scan; nothing where there is no scan to tell, and under the paper's method.
  std::optional<double> scan_agreement;
  /// Share of the camera's votes that the pose gets against the best other heading (BearingAgreement); nothing where
  /// too few are cast, and under the paper's method.
  std::optional<double> bearing_agreement;
  bool camera_seen = false;  ///< it says something, be it too little to tell the heading
  bool range_finder_seen = false;
  /// Integrity::separation; nothing for few landmarks, and under the paper's method.
  std::optional<double> separation;
  std::span<const tracking::Track> tracks;
};

struct LocalizationEvidenceParams {
  perception::Method method = perception::Method::kDefault;
  double on_plan_sigmas = 3.0;      ///< something this near to a wall of the plan, or
  double on_plan_m = 0.05;          ///< this near, lies on it;
  double on_plan_at_most_m = 0.15;  ///< but nothing farther, however unsure the pose is
  double on_plan_weight = 0.5;      ///< of something that lies on a wall of the plan without being a landmark
  double unmapped_weight = 0.25;    ///< of something in the plan's free space, against the localization
  double sight_m = 4.0;             ///< a point of the plan this near should be seen where nothing hides it:
  double clutter_m = 0.15;          ///< something so much nearer than the point hides it, where the beams beside it
  double beside_rad = 0.06;         ///< say so, which pass no farther aside
};

/// Holds a scene against the plan as seen from a pose. Under the paper's method a primitive is matched or not. Under
/// the default method one counts against the localization as far as the plan denies it: in full where it stands behind
/// a wall, little where something may have been put before one, and not at all where it lies on a wall of the plan, as
/// the face of a curve or a mark that the plan does not list does.
/// \param observations  what the pose rests on, made of the scene
/// \param solution      the solver's answer to them
[[nodiscard]] LocalizationEvidence gather_evidence(const perception::Scene& scene, const LandmarkMap& map,
                                                   std::span<const Observation> observations,
                                                   const PoseSolution& solution,
                                                   const LocalizationEvidenceParams& params = {});

}  // namespace credo::localization
