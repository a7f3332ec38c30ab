// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "datasets/dataset.hpp"
#include "results/localization_table.hpp"

namespace credo::evaluation {

/// What the words of the table mean.
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

/// How good a localization is, and how well it knows that. Shares are of the acquisitions with truth; nothing where
/// there is nothing to take a share of.
struct LocalizationScore {
  int acquisitions = 0;
  int with_truth = 0;
  double mean_position_m = 0.0, median_position_m = 0.0, rmse_position_m = 0.0, max_position_m = 0.0;
  double mean_heading_rad = 0.0, median_heading_rad = 0.0, rmse_heading_rad = 0.0, max_heading_rad = 0.0;
  double success = 0.0;
  double localized = 0.0;  ///< status localized
  double lost = 0.0;
  double confidently_wrong = 0.0;
  double confidently_right = 0.0;
  double alert = 0.0;
  double false_alert = 0.0;
  bool degradation_known =
      false;  ///< else `false_alert` is an upper bound: a sensor may have been degraded at any time
  std::optional<double> available = {};  ///< nothing without protection levels
  std::optional<double> misleading = {};
  double anees = 0.0;           ///< over time, of this one run: correlated, so no verdict
  double inside_3_sigma = 0.0;  ///< x, y and heading all within 3 of their sigma
  int lost_count = 0;
  std::optional<double> auroc = {};  ///< of BetP(YES) against lost; nothing unless some are lost and some not
  std::optional<double> calibration_error = {};  ///< ECE of BetP(YES) against not lost, 10 bins of equal count
};

/// The true pose at a time: interpolated, or the nearest row, as ScoreParams says. Precondition: rows by time.
[[nodiscard]] std::optional<geometry::Pose2> truth_at(std::span<const datasets::TimedPose> truth,
                                                      sensors::Timestamp time, const ScoreParams& params = {});

/// A sensor is degraded from "..._degraded" or "..._failed" to the next "..._restored" of the same sensor, or for ever.
/// \param events  by time
[[nodiscard]] std::vector<Interval> degraded_intervals(const std::vector<datasets::Event>& events);

/// \param degraded  when sensors were degraded, all such times; nothing where nobody recorded them
/// \throws std::runtime_error if no row has a truth
[[nodiscard]] LocalizationScore score(std::span<const results::LocalizationRow> rows,
                                      std::span<const datasets::TimedPose> truth,
                                      const std::optional<std::vector<Interval>>& degraded = {},
                                      const ScoreParams& params = {});

/// Probability that a good one has the higher value than a bad one; equal values count half (Mann and Whitney).
/// \returns nothing if there are no good or no bad ones
[[nodiscard]] std::optional<double> auroc(std::span<const double> good, std::span<const double> bad);

/// Expected calibration error of probabilities against what came true, in bins of equal count.
[[nodiscard]] double calibration_error(std::span<const double> probabilities, const std::vector<bool>& came_true,
                                       int bins = 10);

/// The table with the meaning of its words.
[[nodiscard]] std::string to_text(const LocalizationScore& score, const ScoreParams& params = {});

}  // namespace credo::evaluation
