// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "evidence/belief_shapes.hpp"
#include "evidence/believed.hpp"
#include "localization/motion_prediction.hpp"
#include "localization/wall_filter.hpp"
#include "perception/scan_lines.hpp"

namespace credo::localization {

struct EgoMotionParams {
  perception::ScanLineParams lines;
  SystematicOdometry systematic;
  // What the fit of a line does not know of itself, and makes wrong again from the next place: skirting, a wall that
  // bulges, a door left ajar, the instrument's mounting. Chosen so that the NEES of simulated drives is about 3.
  double min_sigma_across_m = 0.015;
  double min_sigma_angle_rad = 0.004;
  double min_sigma_end_m = 0.03;
  // A line of the scan is a known wall where
  double wall_gate = 9.2;        ///< its squared Mahalanobis distance is below chi-square (2 degrees of freedom, 1 %),
  double apart_m = 0.3;          ///< it begins no farther than this beyond where the wall has been seen,
  double ambiguous_gate = 25.0;  ///< and no wall with another line is this near
  double same_line_m = 0.05;     ///< two walls nearer than this are on one line, and either will do
  double robust_scale = 1.5;     ///< Cauchy loss: a match this far off, in standard deviations, counts half
  double least_explained = 0.2;  ///< a scan of whose lines less is matched, by points, does not correct the pose
  double end_gate = 6.6;         ///< of an end: chi-square (1 degree of freedom, 1 %)
  // Wheels slip, a robot is pushed, and without odometry it turns unforeseen: where less than this share of what is
  // seen is explained, the walls are looked for from poses that are
  double search_below = 0.5;
  double search_sigma_m = 0.25;      ///< less certain by this, 1-sigma, and
  double slip_turn_rad = 0.3;        ///< turned by up to so much, or
  double unforeseen_turn_rad = 0.8;  ///< so much where there is no odometry,
  double search_step_rad = 0.1;      ///< in steps of this;
  double search_gain = 0.3;          ///< what is found is kept if it explains so much more,
  double search_least = 0.5;         ///< so much at all,
  int search_walls = 3;              ///< and by so many walls
  // A wall is let go of
  double most_unseen_m = 12.0;  ///< after this way without it: the robot may come back, but not from afar
  std::size_t most_walls = 40;  ///< or for newer ones, so that a scan takes bounded time
  /// Belief in the motion, by the share of the scan's lines, by points, that no known wall explains.
  evidence::RampBelief unexplained{.max_yes = 0.9,
                                   .yes_full_until = 0.3,
                                   .yes_zero_from = 0.9,
                                   .max_no = 0.5,
                                   .no_zero_until = 0.8,
                                   .no_full_from = 1.0};
};

/// Ego-motion from line features (Li X. 2006, sec. IV): where a robot without a map has got to since the start, by
/// odometry and by the walls that its range finder sees again. Each scan's lines are matched to the walls in sight, the
/// long ones first, as each match makes the pose surer for the next; then all of them correct the pose at once. What a
/// scan does not tell, as the way along a corridor, comes from odometry alone, and the covariance says so. Against the
/// first walls heading and place do not drift while these are in sight (Li X. 2007, sec. 5.1). Deterministic.
class EgoMotion {
 public:
  /// \param start  the pose at the first scan, in a frame of the caller's
  explicit EgoMotion(const geometry::PoseEstimate& start = {}, const EgoMotionParams& params = {},
                     const ConstantVelocityParams& constant_velocity = {});

  /// The next scan is taken from this pose, whatever came before. What was learned of odometry stays.
  void restart(const geometry::PoseEstimate& pose);

  /// One scan.
  /// \param motion  T_previous_current by odometry; nothing: the latest velocity goes on. Of no matter in the first scan
  void update(const perception::Scene& scene, const std::optional<geometry::PoseEstimate>& motion);
  /// The same with lines from elsewhere.
  /// \param carry_covariance  Scene::carry_covariance
  void update(sensors::Timestamp time, std::span<const perception::ScanLine> lines,
              const std::optional<geometry::PoseEstimate>& motion,
              const Eigen::Matrix3d& carry_covariance = Eigen::Matrix3d::Zero());

  /// The pose in the frame of the start. The belief is in the latest step: vacuous where nothing was seen, or nothing
  /// known before.
  [[nodiscard]] evidence::Believed<geometry::PoseEstimate> pose() const { return {filter_.pose(), belief_}; }
  /// T_previous_current of the latest step; the identity, exactly, in the first scan.
  [[nodiscard]] geometry::PoseEstimate step() const { return filter_.step(); }
  [[nodiscard]] const std::vector<FilteredWall>& walls() const { return filter_.walls(); }
  /// What odometry, as far as has been learned, does not notice of the turn on a way. [rad]
  [[nodiscard]] double systematic_turn(const geometry::Pose2& motion) const { return filter_.systematic_turn(motion); }
  /// Lines of the latest scan that were matched to walls known before.
  [[nodiscard]] int matched() const { return matched_; }

 private:
  struct Match {
    std::size_t line = 0;
    std::size_t wall = 0;
    double doubt = 1.0;  ///< by which the variances of the line count more
  };
  /// The lines of a scan held against the walls.
  struct Matching {
    WallFilter filter;  ///< with the matches brought in one by one
    std::vector<Match> matches;
    std::vector<std::size_t> appeared;  ///< lines of no known wall
    double explained = 0.0;             ///< share of the lines that are matched, by points
  };

  [[nodiscard]] Matching match(const WallFilter& predicted, std::span<const perception::ScanLine> lines) const;
  [[nodiscard]] std::vector<WallRow> rows(const WallFilter& filter, const perception::ScanLine& line,
                                          const FilteredWall& wall, double doubt) const;
  [[nodiscard]] Matching search(std::span<const perception::ScanLine> lines, double most_turn, Matching found);
  void correct(const Matching& matching, std::span<const perception::ScanLine> lines, const Eigen::Matrix3d& common);

  EgoMotionParams params_;
  WallFilter filter_;
  MotionPredictor predictor_;
  evidence::BinaryMass belief_ = evidence::BinaryMass::vacuous();
  std::optional<sensors::Timestamp> time_;  ///< of the latest scan
  int matched_ = 0;
};

}  // namespace credo::localization
