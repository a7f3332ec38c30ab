// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <vector>

#include "localization/localizer.hpp"
#include "localization/pose_history.hpp"
#include "localization/repeated_module.hpp"
#include "localization/track_labels.hpp"

namespace credo::localization {

/// What a localizer knows, and the steps of an update: localizer.cpp has those of tracking a pose,
/// pose_search.cpp those of looking for it elsewhere.
struct Localizer::State {
  State(const geometry::FloorPlan& plan, const sensors::Rig& instruments,
        const std::optional<geometry::PoseEstimate>& initial, const LocalizerParams& p);

  LocalizerParams params;
  sensors::Rig rig;
  perception::MirrorEstimate mirror;  ///< the latest
  LandmarkMap map;
  SceneFitter fitter;
  tracking::Tracker tracker;
  TrackLabels labels;
  Continuity continuity;
  Misfit misfit;
  IntegrityMonitor monitor;
  RepeatedModules modules;
  GlobalSearch search;
  PoseHypotheses elsewhere;  ///< where the robot may be, while its pose is unknown or in doubt
  EgoMotion ego_motion;      ///< since the start, while the pose is not absolute
  bool absolute;             ///< poses are in the map frame, not relative to the start
  PoseTrust trust;
  SceneFit fit;              ///< the latest pose and what it rests on
  SceneFit other;            ///< another one that is tried
  CalibratedPose predicted;  ///< from the latest pose
  CalibratedPose wide;       ///< the same, less sure
  int matched_before = 0;    ///< primitives that the latest fix rests on
  int doubted = 0;           ///< acquisitions in a row in which the plan was not recognised
  bool broken_off = false;   ///< in this acquisition: much of what was followed is not seen any more
  bool jumped =
      false;  ///< in this acquisition: the pose was found some way from where it was expected, or may have been
  bool found_elsewhere = false;                       ///< in this acquisition: the pose is another one than was thought
  std::optional<geometry::PoseEstimate> set_by_hand;  ///< the pose at the next update
  PoseHistory history;
  MotionPredictor predictor;
  std::vector<int> observed_tracks;      ///< by observation, their ids, a workspace
  std::vector<double> landmark_beliefs;  ///< by observation, as the monitor took them

  [[nodiscard]] geometry::PoseEstimate predicted_motion(const std::optional<geometry::PoseEstimate>& motion,
                                                        sensors::Timestamp time) const;
  [[nodiscard]] geometry::PoseEstimate predict(const perception::Scene& scene,
                                               const std::optional<geometry::PoseEstimate>& motion);
  [[nodiscard]] geometry::PoseEstimate motion_to(const CalibratedPose& pose) const;
  [[nodiscard]] Eigen::Matrix3d doubt() const;
  void expect_landmarks(const CalibratedPose& from);
  void expect_young_tracks(const geometry::Pose2& step);
  [[nodiscard]] geometry::Pose2 likeliest_first_step(const perception::Scene& scene);
  geometry::PoseEstimate follow_walls(const perception::Scene& scene,
                                      const std::optional<geometry::PoseEstimate>& motion);
  void find_pose(const perception::Scene& scene, const std::vector<tracking::Match>& matches,
                 const geometry::PoseEstimate& step, bool odometry);
  void start_tracks(const perception::Scene& scene);
  [[nodiscard]] double quality(const SceneFit& of, const perception::Scene& scene) const;
  [[nodiscard]] bool lost_sight() const;
  void search_pose(const perception::Scene& scene, bool odometry);
  bool match_anew(const perception::Scene& scene, const CalibratedPose& expected);
  [[nodiscard]] bool doubtful() const;
  void look_elsewhere(const perception::Scene& scene, const geometry::PoseEstimate& motion);
  void go_to(const SceneFit& found);
  void report_hypotheses(Localization& fix) const;
  [[nodiscard]] Localization report(const perception::Scene& scene) const;
  void list_observed_tracks();
  [[nodiscard]] Integrity watch();
  void weigh(const perception::Scene& scene, Localization& fix);
  void start_from(const geometry::PoseEstimate& pose, const geometry::PoseEstimate& step);
  void believe_motion(Localization& fix) const;
  void remember(const Localization& fix);
};

}  // namespace credo::localization
