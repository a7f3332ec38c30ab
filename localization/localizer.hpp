// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "localization/continuity.hpp"
#include "localization/ego_motion.hpp"
#include "localization/integrity_monitor.hpp"
#include "localization/localization.hpp"
#include "localization/localization_belief.hpp"
#include "localization/misfit.hpp"
#include "localization/motion_prediction.hpp"
#include "localization/pose_hypotheses.hpp"
#include "localization/pose_trust.hpp"
#include "localization/rig_calibration.hpp"
#include "localization/scene_fit.hpp"
#include "tracking/tracker.hpp"

namespace credo::localization {

struct LocalizerParams {
  perception::Method method = perception::Method::kDefault;
  tracking::TrackerParams tracker;
  LandmarkMapParams map;
  SceneFitParams fit;
  LocalizationBeliefParams belief;
  ContinuityParams continuity;
  MisfitParams misfit;
  IntegrityParams integrity;
  GlobalSearchParams search;
  PoseHypothesesParams hypotheses;
  StatusParams status;
  PoseTrustParams trust;
  ConstantVelocityParams constant_velocity;
  EgoMotionParams ego_motion;
  CalibrationWalk calibration_walk;
  // When a pose is searched nearby, by the raw scan: where so little of the scan lies on the plan, or
  double search_below = 0.75;
  double search_matched_below = 0.7;       ///< so few are matched of those that the fix before rested on.
  double search_gain = 0.10;               ///< what was found is kept from this gain in quality on:
  double matched_share_weight = 0.5;       ///< BetP(YES) and, with this weight, the share of the scene that is matched
  double unforeseen_turn_sigma_rad = 0.6;  ///< of the search where there is no odometry
  double searched_sigma_m = 0.10;          ///< of a pose that was found
  double searched_sigma_rad = 0.02;

  double doubt_sigma_m = 0.3;  ///< how far the pose may be off where the points in sight are not recognised
  double doubt_sigma_rad = 0.05;
  int doubts_before_search =
      2;                        ///< acquisitions in a row without the plan recognised: then it is looked for everywhere
  double elsewhere_lead = 3.0;  ///< log plausibility by which another pose has to lead for the pose to be doubted
  int contradictions_allowed = 1;  ///< a track that contradicts the pose more often in a row loses its landmark

  /// The parameters with `method` handed down to every part.
  [[nodiscard]] LocalizerParams with_method(perception::Method chosen) const;
};

/// \throws std::invalid_argument  for parameters out of their range, with the name, what was found and what is expected
void check(const LocalizerParams& params);

/// Tracks + map -> Localization: the dynamic localization of Clerentin et al., sec. 4.
class Localizer {
 public:
  /// \param plan     empty: there is no plan, and poses are relative to the start with status initializing
  /// \param initial  the manual initial matching; absent: likewise relative to the start
  /// \throws std::invalid_argument for parameters out of their range
  Localizer(const geometry::FloorPlan& plan, const sensors::Rig& rig,
            const std::optional<geometry::PoseEstimate>& initial, const LocalizerParams& params = {});
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Before a scene is made of it: gives an acquisition without odometry the path that the latest velocity predicts,
  /// and remembers the path for pose_at.
  void with_path(sensors::Acquisition& acquisition);

  /// A pose set by hand: the next update starts from it, as the first one did from the initial pose, and it is not
  /// trusted before what is seen has borne it out. Without a plan, motion goes on from it.
  /// \param T_map_base  at the time of the next update; its covariance is positive definite
  void set_pose(const geometry::PoseEstimate& T_map_base);

  /// One scene. `motion` is Acquisition::motion.
  Localization update(const perception::Scene& scene, const std::optional<geometry::PoseEstimate>& motion);

  /// The pose at any time between the last two updates, and shortly before or after; with its covariance and the
  /// belief. Vacuous belief before the first update.
  [[nodiscard]] evidence::Believed<geometry::PoseEstimate> pose_at(sensors::Timestamp time) const;

  [[nodiscard]] const std::vector<tracking::Track>& tracks() const;
  [[nodiscard]] const LandmarkMap& map() const;
  /// What the latest pose rests on, and what came of each observation (PoseSolution::outlier).
  [[nodiscard]] const std::vector<Observation>& observations() const;
  [[nodiscard]] const PoseSolution& solution() const;
  /// Of each of observations(): BetP(YES) that its track exists, as the integrity monitor took it. Empty without a
  /// monitor: under the paper's method, and before there is a pose in the map.
  [[nodiscard]] const std::vector<double>& landmark_beliefs() const;
  [[nodiscard]] const LocalizerParams& params() const;
  /// What was learned about the instruments so far; as they came where there is no pose on a plan.
  [[nodiscard]] RigCalibration calibration() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::localization
