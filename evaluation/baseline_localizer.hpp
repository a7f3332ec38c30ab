// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <optional>

#include "geometry/pose.hpp"
#include "localization/localizer.hpp"
#include "localization/motion_prediction.hpp"
#include "perception/scene.hpp"

namespace credo::evaluation {

/// What localizes on a scene and the motion since the scene before. How far it trusts itself is its belief's BetP(YES).
template <typename L>
concept Localizer = requires(L& localizer, const perception::Scene& scene,
                             const std::optional<geometry::PoseEstimate>& motion) {
  { localizer.update(scene, motion) } -> std::same_as<localization::Localization>;
};
static_assert(Localizer<localization::Localizer>);

/// How every baseline predicts: by odometry's motion, or where there is none by the latest velocity, as Credo does.
class BaselineMotion {
 public:
  explicit BaselineMotion(const geometry::PoseEstimate& initial) : latest_(initial) {}

  /// T_map_base expected at `time`; the initial pose for the first scene.
  [[nodiscard]] geometry::PoseEstimate predict(const std::optional<geometry::PoseEstimate>& motion,
                                               sensors::Timestamp time) const;
  /// T_previous_current that predict() appends; the identity, known exactly, for the first scene.
  [[nodiscard]] geometry::PoseEstimate step(const std::optional<geometry::PoseEstimate>& motion,
                                            sensors::Timestamp time) const;
  /// What came out at `time`.
  void correct(const geometry::PoseEstimate& estimate, sensors::Timestamp time);

 private:
  geometry::PoseEstimate latest_;
  std::optional<sensors::Timestamp> time_;
  localization::MotionPredictor velocity_;
};

/// A baseline's answer: always localized, with its confidence in [0, 1] as a Bayesian belief.
[[nodiscard]] localization::Localization baseline_fix(sensors::Timestamp time, const geometry::PoseEstimate& estimate,
                                                      double confidence);

}  // namespace credo::evaluation
