// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/belief_calibration.hpp"
#include "evaluation/lost_detection.hpp"
#include "evaluation/samples.hpp"

namespace credo::evaluation {

/// How good a localization is, and how well it knows that. Shares are of the acquisitions with truth, errors are of
/// those of them that have a pose in the map; nothing where there is nothing to take a share of.
struct LocalizationScore {
  int acquisitions = 0;
  int with_truth = 0;
  int placed = 0;  ///< of them, not initializing
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
  double inside_3_sigma = 0.0;  ///< x, y and heading all within 3 of their sigma; share of the placed
  int lost_count = 0;
  std::optional<double> auroc = {};  ///< of BetP(YES) against lost; nothing unless some are lost and some not
  std::optional<double> calibration_error = {};  ///< ECE of BetP(YES) against not lost, 10 bins of equal count
};

/// \param degraded  when sensors were degraded, all such times; nothing where nobody recorded them
/// \throws std::invalid_argument if no row has both a truth and a pose in the map
[[nodiscard]] LocalizationScore score(std::span<const results::LocalizationRow> rows,
                                      std::span<const datasets::TimedPose> truth,
                                      const std::optional<std::vector<Interval>>& degraded = {},
                                      const ScoreParams& params = {});

/// The table with the meaning of its words.
[[nodiscard]] std::string to_text(const LocalizationScore& score, const ScoreParams& params = {});

}  // namespace credo::evaluation
