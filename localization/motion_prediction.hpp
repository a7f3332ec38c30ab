// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "perception/scene.hpp"
#include "tracking/track.hpp"

namespace credo::localization {

/// How the pose is predicted where no odometry says how the robot moved: by its latest velocity.
struct ConstantVelocityParams {
  double translation_sigma_share = 0.5;  ///< of the distance that the velocity predicts
  double translation_sigma_m = 0.10;
  double rotation_sigma_share = 0.5;  ///< of the turn that the velocity predicts
  double rotation_sigma_rad = 0.10;
  double first_step_m = 0.6;  ///< what the robot may do before anything is known of its velocity
  double first_turn_rad = 0.2;
  double max_unforeseen_turn_rad = 0.8;  ///< looked for in the azimuths, beside what the velocity predicts
  double turn_bin_rad = 0.035;           ///< of the votes for such a turn: 2 degrees
  double turn_lead = 1.5;                ///< votes for it over those for no such turn, at least
  double turn_share = 0.25;              ///< of the tracks that vote, at least
};

/// The robot's latest steps, and what they say of the next one.
class MotionPredictor {
 public:
  explicit MotionPredictor(const ConstantVelocityParams& params = {}) : params_(params) { steps_.reserve(kSteps); }

  /// One step from fix to fix. \param seconds  > 0
  void add(const geometry::Pose2& motion, double seconds);
  /// No step is known yet.
  [[nodiscard]] bool empty() const { return steps_.empty(); }

  /// The component-wise median of the last three steps, scaled to `seconds`: one wrong pose makes two wrong steps of
  /// it, and neither is followed. Before any step: rest, with the covariance of not knowing.
  [[nodiscard]] geometry::PoseEstimate predict(double seconds) const;

 private:
  static constexpr std::size_t kSteps = 3;
  struct Step {
    geometry::Pose2 motion;
    double seconds = 0.0;
  };
  ConstantVelocityParams params_;
  std::vector<Step> steps_;
};

/// The turn beside `step` under which most of what the tracks saw in the scene before is seen again: the peak of all
/// differences of azimuth between a track and a primitive of its type. [rad]
/// \param before  the time of the scene before; tracks that were not seen then do not vote
/// \returns 0 where no turn leads clearly
[[nodiscard]] double unforeseen_turn(std::span<const tracking::Track> tracks, sensors::Timestamp before,
                                     const perception::Scene& scene, const geometry::Pose2& step,
                                     const ConstantVelocityParams& params = {});

}  // namespace credo::localization
