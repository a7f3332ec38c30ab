// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/localization_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include "evaluation/consistency.hpp"
#include "evaluation/pose_error.hpp"
#include "evaluation/table_row.hpp"

namespace credo::evaluation {
namespace {

using results::LocalizationRow;

template <typename Condition>
double share(const std::vector<Sample>& samples, const Condition& condition) {
  const auto count = std::count_if(samples.begin(), samples.end(), condition);
  return static_cast<double>(count) / static_cast<double>(samples.size());
}

bool inside_three_sigma(const Sample& s) {
  const geometry::PoseEstimate& estimate = s.localization.estimate;
  const Eigen::Vector3d error{s.truth.x - estimate.pose.x, s.truth.y - estimate.pose.y, s.heading_rad()};
  for (int i = 0; i < 3; ++i) {
    if (std::abs(error[i]) > 3.0 * std::sqrt(std::max(0.0, estimate.covariance(i, i)))) return false;
  }
  return true;
}

void add_errors(LocalizationScore& result, const std::vector<Sample>& samples) {
  std::vector<double> position, heading;
  for (const Sample& s : samples) {
    position.push_back(s.position_m());
    heading.push_back(s.heading_rad());
  }
  const Statistics p = statistics(position), h = statistics(heading);
  result.mean_position_m = p.mean, result.median_position_m = p.median;
  result.rmse_position_m = p.rmse, result.max_position_m = p.max;
  result.mean_heading_rad = h.mean, result.median_heading_rad = h.median;
  result.rmse_heading_rad = h.rmse, result.max_heading_rad = h.max;
}

void add_protection(LocalizationScore& result, const std::vector<Sample>& samples, const ScoreParams& params) {
  if (std::none_of(samples.begin(), samples.end(), is_monitored)) return;
  result.available = share(samples, [&](const Sample& s) { return is_available(s, params); });
  result.misleading = share(samples, [&](const Sample& s) { return is_misleading(s, params); });
}

void add_belief_quality(LocalizationScore& result, const std::vector<Sample>& placed, const ScoreParams& params) {
  std::vector<double> all, good, bad;
  std::vector<bool> not_lost;
  for (const Sample& s : placed) {
    const double probability = s.localization.belief.pignistic();
    const bool lost = is_lost(s, params);
    (lost ? bad : good).push_back(probability);
    all.push_back(probability);
    not_lost.push_back(!lost);
  }
  result.lost_count = static_cast<int>(bad.size());
  result.auroc = auroc(good, bad);
  result.calibration_error = calibration_error(all, not_lost);
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

LocalizationScore score(std::span<const LocalizationRow> rows, std::span<const datasets::TimedPose> truth,
                        const std::optional<std::vector<Interval>>& degraded, const ScoreParams& params) {
  const std::vector<Sample> samples =
      samples_of(rows, truth, degraded ? std::span<const Interval>(*degraded) : std::span<const Interval>(), params);
  std::vector<Sample> placed;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(placed), [](const Sample& s) { return s.placed(); });
  if (placed.empty())
    throw std::invalid_argument("all acquisitions with a truth are initializing: no pose in the map, no error");
  LocalizationScore result{.acquisitions = static_cast<int>(rows.size()),
                           .with_truth = static_cast<int>(samples.size()),
                           .placed = static_cast<int>(placed.size())};
  const auto confident = [&](const Sample& s) {
    return !is_alert(s) && s.localization.belief.yes > params.confident_belief;
  };
  const auto wrong = [&](const Sample& s) { return is_beyond(s, params.wrong_above_m, params.wrong_above_deg); };
  add_errors(result, placed);
  result.success = share(samples, [&](const Sample& s) {
    return s.placed() && s.position_m() < params.success_below_m &&
           s.heading_rad() < geometry::to_radians(params.success_below_deg);
  });
  result.localized = share(samples, [](const Sample& s) { return !is_alert(s); });
  result.lost = share(samples, [&](const Sample& s) { return is_lost(s, params); });
  result.confidently_wrong = share(samples, [&](const Sample& s) { return confident(s) && wrong(s); });
  result.confidently_right = share(samples, [&](const Sample& s) { return confident(s) && !wrong(s); });
  result.alert = share(samples, is_alert);
  result.false_alert = share(samples, [&](const Sample& s) { return is_false_alert(s, params); });
  result.degradation_known = degraded.has_value();
  add_protection(result, samples, params);
  for (const Sample& s : placed)
    result.anees += nees(s.localization.estimate, s.truth) / static_cast<double>(placed.size());
  result.inside_3_sigma = share(placed, inside_three_sigma);
  add_belief_quality(result, placed, params);
  return result;
}

std::string to_text(const LocalizationScore& s, const ScoreParams& p) {
  const auto cm = [](double m) { return formatted("%.2f cm", 100.0 * m); };
  const auto deg = [](double rad) { return formatted("%.3f deg", geometry::to_degrees(rad)); };
  const auto limits = [](double m, double d, const char* word = " or ") {
    return formatted("%g m", m) + word + formatted("%g deg", d);
  };
  const std::string lost = limits(p.lost_above_m, p.lost_above_deg), wrong = limits(p.wrong_above_m, p.wrong_above_deg);
  std::string text = "Localization against ground truth: " + std::to_string(s.with_truth) + " of " +
                     std::to_string(s.acquisitions) + " acquisitions have a truth (not aligned)\n";
  if (s.placed < s.with_truth)
    text +=
        "  " + std::to_string(s.with_truth - s.placed) + " of them are initializing: no pose in the map, no error\n";
  text += table_row(
      "mean position error", cm(s.mean_position_m),
      "median " + cm(s.median_position_m) + ", rmse " + cm(s.rmse_position_m) + ", max " + cm(s.max_position_m));
  text += table_row(
      "mean heading error", deg(s.mean_heading_rad),
      "median " + deg(s.median_heading_rad) + ", rmse " + deg(s.rmse_heading_rad) + ", max " + deg(s.max_heading_rad));
  text += table_row("success", percent(s.success),
                    "error below " + limits(p.success_below_m, p.success_below_deg, " and "));
  text += table_row("confidently wrong", percent(s.confidently_wrong),
                    "localized, belief_yes > " + formatted("%g", p.confident_belief) + ", yet error > " + wrong);
  text += table_row("confidently right", percent(s.confidently_right), "the same words, and error within both");
  text += table_row("lost", percent(s.lost), "error > " + lost);
  text += table_row("alert", percent(s.alert), "status other than localized");
  text += table_row(
      "false alert", percent(s.false_alert),
      std::string("an alert with error below both limits of lost, ") +
          (s.degradation_known ? "no sensor degraded" : "or less: no events.csv says when sensors were degraded"));
  text += table_row("available", percent(s.available),
                    "localized and protection levels within " +
                        limits(p.available_level_m, p.available_level_deg, " and ") +
                        (s.available ? "" : " (no integrity monitor)"));
  text += table_row("misleading", percent(s.misleading), "available, yet the error is above the protection level");
  text += table_row("NEES", formatted("%.2f", s.anees),
                    "mean over time of one run (3 expected); within 3 sigma: " + percent(s.inside_3_sigma));
  const bool enough = s.lost_count >= 200;
  text += table_row("AUROC", s.auroc ? formatted("%.3f", *s.auroc) : "-",
                    "BetP(YES) against lost, over " + std::to_string(s.lost_count) + " lost" +
                        (enough ? "" : " (at least 200 are asked for)"));
  text += table_row("calibration error", formatted("%.3f", s.calibration_error.value_or(0.0)),
                    "ECE of BetP(YES), 10 bins of equal count");
  return text;
}

}  // namespace credo::evaluation
