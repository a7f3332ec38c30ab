// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "localization/localization.hpp"
#include "tracking/tracker.hpp"

namespace credo::localization {

struct LocalizerParams {  // the owner of this file completes it
  perception::Method method = perception::Method::kDefault;
  tracking::TrackerParams tracker;
};

/// Tracks + map -> Localization: the dynamic localization of Clerentin et al., sec. 4.
class Localizer {
 public:
  /// \param initial  the manual initial matching; absent: poses are relative to the start, status initializing
  Localizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const std::optional<geometry::PoseEstimate>& initial,
            const LocalizerParams& params = {});
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Gives an acquisition without odometry the path that the latest velocity predicts; leaves any other as it is.
  void with_path(sensors::Acquisition& acquisition) const;

  /// One scene. `motion` is Acquisition::motion.
  Localization update(const perception::Scene& scene, const std::optional<geometry::PoseEstimate>& motion);

  /// The pose at any time between the last two updates, and shortly after the latest; with its covariance and the belief.
  [[nodiscard]] evidence::Believed<geometry::PoseEstimate> pose_at(sensors::Timestamp time) const;

  [[nodiscard]] const std::vector<tracking::Track>& tracks() const;
  [[nodiscard]] const LocalizerParams& params() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::localization
