// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/localization_score.hpp"

namespace credo::evaluation {

/// Standard deviations that a normal error exceeds, to either side, with a probability of 1e-5.
inline constexpr double kProtectionFactor = 4.417;

/// Protection levels of an estimate that is taken at its word: kProtectionFactor standard deviations, of the position
/// along the longest axis of its ellipse. Lower and upper level are the same.
[[nodiscard]] localization::ProtectionLevels gaussian_protection(const geometry::PoseEstimate& estimate);

/// What one localizer did in acquisitions that have a truth; drives add up.
struct LocalizerRecord {
  std::vector<double> position_m;   ///< error
  std::vector<double> heading_rad;  ///< error, >= 0
  std::vector<double> confidence;   ///< BetP(YES)
  std::vector<double> nees;
  std::vector<bool> lost;
  std::vector<bool> available;
  std::vector<bool> misleading;
  double seconds = 0.0;  ///< spent in all its updates

  LocalizerRecord& operator+=(const LocalizerRecord& other);
};

/// Rows without a truth are left out.
[[nodiscard]] LocalizerRecord record(std::span<const results::LocalizationRow> rows,
                                     std::span<const datasets::TimedPose> truth, double seconds,
                                     const ScoreParams& params = {});

/// A line of the table. Shares are of the acquisitions.
struct LocalizerSummary {
  int acquisitions = 0;
  double mean_position_m = 0.0;
  double p95_position_m = 0.0;  ///< 95 % of the errors are not larger
  double mean_heading_rad = 0.0;
  double lost = 0.0;
  double available = 0.0;
  double misleading = 0.0;
  double mean_nees = 0.0;
  int lost_count = 0;
  std::optional<double> auroc = {};  ///< of the confidence against lost; nothing unless some are lost and some not
  double ms_per_update = 0.0;
};

/// \throws std::invalid_argument if there is no acquisition
[[nodiscard]] LocalizerSummary summarise(const LocalizerRecord& record);

/// One localizer in the table; without a summary it did not run, and `note` says why.
struct LocalizerLine {
  std::string name;
  std::string note;
  std::optional<LocalizerSummary> summary = {};
};

[[nodiscard]] std::string to_text(std::span<const LocalizerLine> lines);
/// What the words of the table mean.
[[nodiscard]] std::string localizer_table_terms(const ScoreParams& params = {});

/// The header of the table as comma-separated values, and the lines of one dataset; with the lines' ends.
[[nodiscard]] std::string localizer_csv_header();
[[nodiscard]] std::string to_csv(const std::string& dataset, std::span<const LocalizerLine> lines);

}  // namespace credo::evaluation
