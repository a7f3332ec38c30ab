// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "localization/bearing_agreement.hpp"
#include "localization/landmark_map.hpp"
#include "localization/localization_evidence.hpp"
#include "localization/map_matching.hpp"
#include "localization/observations.hpp"
#include "localization/pose_solver.hpp"
#include "localization/scan_agreement.hpp"
#include "tracking/track.hpp"

namespace credo::localization {

struct SceneFitParams {
  perception::Method method = perception::Method::kDefault;
  MapMatchingParams matching;
  ObservationParams observations;
  PoseSolverParams solver;
  ScanAgreementParams scan;
  LocalizationEvidenceParams evidence;
  BearingAgreementParams bearings;
  int matching_rounds = 3;  ///< map matching and pose in turn: each round knows the pose better
};

/// A pose and what it rests on in one scene.
struct SceneFit {
  SceneFit();  ///< with memory for what a scene usually has

  CalibratedPose pose;
  PoseSolution solution;
  std::vector<Observation> observations;  ///< that the solution is made of
  std::vector<MapMatch> new_matches;      ///< of primitives whose tracks had no landmark
  LocalizationEvidence evidence;          ///< about the pose; without the tracks

  [[nodiscard]] geometry::PoseEstimate estimate() const { return pose.estimate(); }
};

/// From a scene and an expected pose to the pose that the plan gives: what the tracks continue, then what the map has
/// for the rest, and the pose in turn (Clerentin et al., sec. 4.2). Keeps its memory.
class SceneFitter {
 public:
  /// \param map  must outlive this
  SceneFitter(const LandmarkMap& map, const sensors::Rig& rig, const SceneFitParams& params);

  /// \param matches   of the tracks with the scene's primitives
  /// \param expected  its covariance is positive definite
  /// \param given     the first scene: its matching is given by hand (Clerentin et al., sec. 5); here, by the default's
  ///   criteria
  void fit(const perception::Scene& scene, std::span<const tracking::Track> tracks,
           std::span<const tracking::Match> matches, const CalibratedPose& expected, bool given, SceneFit& fit);

  /// Everything matched anew, whatever the tracks say.
  /// \param from      where matching starts; the calibration is expected's
  /// \param expected  what the pose is held against; it may be far less sure
  void fit_anew(const perception::Scene& scene, const geometry::PoseEstimate& from, const CalibratedPose& expected,
                SceneFit& fit);

  /// A pose of which nothing is known but this; the instruments as they came. Stays valid until the next call.
  [[nodiscard]] const CalibratedPose& uncalibrated(const geometry::PoseEstimate& at);

  /// What speaks for and against the pose of a fit, the tracks left out, into fit.evidence.
  void gather(const perception::Scene& scene, SceneFit& fit) const;

  /// The expected pose as the walls alone correct it: they are few, long and far apart, so that even from a poor
  /// prediction none is taken for another. For looking for the rest, without covariances with the plan's errors;
  /// `expected` where no wall is matched.
  [[nodiscard]] const CalibratedPose& sharpen(const perception::Scene& scene, const CalibratedPose& expected);

  /// The raw scan against the plan.
  [[nodiscard]] ScanMatcher& scan_matcher() { return scan_matcher_; }

 private:
  void observe_tracks(const perception::Scene& scene, std::span<const tracking::Track> tracks,
                      std::span<const tracking::Match> matches, SceneFit& fit);
  void observe_landmark(const perception::Scene& scene, int primitive, tracking::LandmarkId landmark, int track,
                        SceneFit& fit);
  void list_unmatched(const perception::Scene& scene, const SceneFit& fit);
  /// What continues no track of the map, walls before points, from a pose that every round knows better.
  void match_map(const perception::Scene& scene, const CalibratedPose& expected, MapMatcher& matcher, int rounds,
                 SceneFit& fit);
  void solve(const perception::Scene& scene, const CalibratedPose& expected, SceneFit& fit);
  void conclude(SceneFit& fit);

  const LandmarkMap* map_;
  SceneFitParams params_;
  MapMatcher matcher_;
  MapMatcher first_matcher_;
  PoseSolver solver_;
  CalibratedPose uncalibrated_;  ///< the rig as it came
  ScanMatcher scan_matcher_;

  SceneFit by_walls_;

  // One fit's workspace.
  CalibratedPose start_;
  std::vector<bool> wall_in_use_;  ///< by segment
  std::vector<int> unmatched_;     ///< primitives
  std::vector<bool> used_;         ///< by primitive
  std::vector<tracking::LandmarkId> taken_;
};

}  // namespace credo::localization
