// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "evaluation/samples.hpp"

namespace credo::evaluation {

/// Probability that a good one has the higher value than a bad one; equal values count half (Mann and Whitney).
/// \returns nothing if there are no good or no bad ones
[[nodiscard]] std::optional<double> auroc(std::span<const double> good, std::span<const double> bad);

/// What comes of taking everything for lost whose suspicion is at least `threshold`.
struct OperatingPoint {
  double threshold = 0.0;
  double recall = 0.0;             ///< share of the lost that is caught
  double false_alarm_share = 0.0;  ///< share of the others that is caught, too
  double precision = 0.0;          ///< share of what is caught that is lost
};

/// How well a suspicion tells the lost from the others. Empty unless there are some of both.
struct DetectionCurve {
  std::vector<OperatingPoint> points = {};  ///< one for each different suspicion, falling: recall grows
  std::optional<double> auroc = {};
  /// Mean precision over recall: the sum of precision times the growth of recall, without interpolation. Of a
  /// suspicion that knows nothing it is the share of the lost.
  std::optional<double> average_precision = {};
};

/// \param suspicion  the higher, the more likely lost; may be infinite, not nan. Precondition: as many as `lost`
[[nodiscard]] DetectionCurve detection_curve(std::span<const double> suspicion, const std::vector<bool>& lost);

/// When something came after something else.
struct Response {
  int acquisitions = 0;  ///< 1: in the first acquisition
  double seconds = 0.0;
};

/// A stretch of acquisitions in which the pose is lost. Acquisitions without a pose in the map do not end it.
struct LostEpisode {
  sensors::Timestamp onset = 0;
  int acquisitions = 0;
  std::optional<Response> alert = {};  ///< from the onset; nothing if it was missed
};
[[nodiscard]] std::vector<LostEpisode> lost_episodes(const EvaluatedRun& run, const ScoreParams& params = {});

/// A robot that is carried without noticing: what it says, and when it knows again, before the next time or the end.
struct Kidnap {
  sensors::Timestamp time = 0;
  std::optional<Response> alert = {};
  std::optional<Response> recovery = {};  ///< localized, and not lost
};
[[nodiscard]] std::vector<Kidnap> kidnaps(const EvaluatedRun& run, const ScoreParams& params = {});

/// Stretches of false alerts (is_false_alert).
struct FalseAlarms {
  int count = 0;
  double hours = 0.0;  ///< from the first acquisition to the last
};
[[nodiscard]] FalseAlarms false_alarms(const EvaluatedRun& run, const ScoreParams& params = {});

}  // namespace credo::evaluation
