// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "datasets/dataset.hpp"
#include "results/localization_table.hpp"

namespace credo::evaluation {

/// What the words of every table mean.
struct ScoreParams {
  double lost_above_m = 0.25;
  double lost_above_deg = 5.0;
  double wrong_above_m = 0.3;  ///< "confidently wrong" and "confidently right"
  double wrong_above_deg = 10.0;
  double confident_belief = 0.8;   ///< belief_yes above this, and status localized
  double available_level_m = 0.5;  ///< upper protection level up to this, and status localized
  double available_level_deg = 5.0;
  double success_below_m = 0.45;
  double success_below_deg = 10.0;
  double truth_max_gap_s = 0.2;    ///< the truth is interpolated between rows that are at most this far apart
  double truth_max_diff_s = 0.01;  ///< else the nearest row counts, up to here
};

/// A stretch of time in which a sensor is known to be degraded; alerts in it are not false.
using Interval = std::pair<sensors::Timestamp, sensors::Timestamp>;

/// The true pose at a time: interpolated, or the nearest row, as ScoreParams says. Precondition: rows by time.
[[nodiscard]] std::optional<geometry::Pose2> truth_at(std::span<const datasets::TimedPose> truth,
                                                      sensors::Timestamp time, const ScoreParams& params = {});

/// A sensor is degraded from "..._degraded" or "..._failed" to the next "..._restored" of the same sensor, or for ever.
/// \param events  by time
[[nodiscard]] std::vector<Interval> degraded_intervals(const std::vector<datasets::Event>& events);

/// One acquisition with its truth.
struct Sample {
  localization::Localization localization;
  geometry::Pose2 truth;  ///< T_map_base
  bool degraded = false;  ///< a sensor is known to be

  /// There is a pose in the map. Without one, while initializing, there is no error either.
  [[nodiscard]] bool placed() const { return localization.status != localization::Status::kInitializing; }
  [[nodiscard]] double position_m() const {
    return (localization.estimate.pose.translation() - truth.translation()).norm();
  }
  [[nodiscard]] double heading_rad() const {
    return std::abs(geometry::angle_difference(localization.estimate.pose.theta, truth.theta));
  }
};

/// One drive: what was localized of it, and what is known to have happened.
struct EvaluatedRun {
  std::string name;
  std::vector<Sample> samples = {};              ///< the acquisitions that have a truth, by time
  std::vector<sensors::Timestamp> kidnaps = {};  ///< by time
  bool events_known = false;  ///< else sensors may have been degraded, and robots carried, at any time
};

/// The rows that have a truth.
/// \param degraded  all times when sensors were degraded
/// \throws std::invalid_argument if no row has one
[[nodiscard]] std::vector<Sample> samples_of(std::span<const results::LocalizationRow> rows,
                                             std::span<const datasets::TimedPose> truth,
                                             std::span<const Interval> degraded = {}, const ScoreParams& params = {});

/// \param events  by time; nothing where nobody recorded them
/// \throws std::invalid_argument if no row has a truth
[[nodiscard]] EvaluatedRun evaluated_run(std::string name, std::span<const results::LocalizationRow> rows,
                                         std::span<const datasets::TimedPose> truth,
                                         const std::optional<std::vector<datasets::Event>>& events = {},
                                         const ScoreParams& params = {});

/// Has a pose whose error is above one of the limits.
[[nodiscard]] bool is_beyond(const Sample& sample, double limit_m, double limit_deg);
[[nodiscard]] bool is_lost(const Sample& sample, const ScoreParams& params = {});
/// Says that it may be lost: any status but localized.
[[nodiscard]] bool is_alert(const Sample& sample);
/// An alert though the error is below both limits of lost and no sensor is known to be degraded.
[[nodiscard]] bool is_false_alert(const Sample& sample, const ScoreParams& params = {});
/// Localized, with upper protection levels within the limits.
[[nodiscard]] bool is_available(const Sample& sample, const ScoreParams& params = {});
/// Available, yet an error is above its protection level.
[[nodiscard]] bool is_misleading(const Sample& sample, const ScoreParams& params = {});
/// An integrity monitor has given it protection levels.
[[nodiscard]] bool is_monitored(const Sample& sample);

}  // namespace credo::evaluation
