// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/run_report.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/output.hpp"
#include "results/calibration_file.hpp"

namespace credo::apps {
namespace {

using localization::Status;
using nlohmann::ordered_json;

std::map<std::string, int> status_counts(const results::History& history) {
  std::map<std::string, int> counts;
  for (const results::Moment& m : history) ++counts[localization::to_string(m.localization.status)];
  return counts;
}

struct Means {
  double detected = 0.0, matched = 0.0, tracked = 0.0;
};

Means means(const results::History& history) {
  Means result;
  for (const results::Moment& m : history) {
    const double n = static_cast<double>(history.size());
    result.detected += m.localization.detected / n;
    result.matched += m.localization.matched / n;
    result.tracked += m.localization.tracked / n;
  }
  return result;
}

/// What was missing or left out, sensor by sensor; empty where nothing was.
std::string degradation_text(const Outcome& outcome, const datasets::Dataset& dataset) {
  std::string text;
  if (outcome.without_image > 0)
    text += fmt::format("degraded: {} acquisitions without a usable image\n", outcome.without_image);
  if (outcome.without_scan > 0)
    text += fmt::format("degraded: {} acquisitions without a usable scan\n", outcome.without_scan);
  for (const datasets::SensorLog& log : dataset.log) {
    const std::size_t readings = log.below_range_min + log.above_range_max + log.negative;
    if (readings > 0)
      text += fmt::format("{}: {} readings outside of its range were taken as no measurement\n", log.sensor, readings);
    if (log.rows_without_value > 0)
      text += fmt::format("{}: {} rows hold no measurement\n", log.sensor, log.rows_without_value);
  }
  return text;
}

std::string conflict_text(const results::ConflictStatistics& conflict) {
  if (conflict.segments() == 0) return "";
  std::string text =
      fmt::format("Conflict of the five criteria over {} segments: mean {:.3f} (Clerentin et al. report 0.13)\n",
                  conflict.segments(), conflict.mean());
  constexpr auto names = results::ConflictStatistics::kCriteria;
  text += fmt::format("  {:<12}", "per pair");
  for (std::size_t j = 1; j < names.size(); ++j) text += fmt::format("{:>13}", names[j]);
  text += "\n";
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    text += fmt::format("  {:<12}", names[i]);
    for (std::size_t j = 1; j < names.size(); ++j) {
      text += j > i ? fmt::format("{:>13.3f}", conflict.of_pair(i, j)) : std::string(13, ' ');
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::optional<evaluation::LocalizationScore> score_of(const Outcome& outcome, const datasets::Dataset& dataset) {
  std::vector<results::LocalizationRow> rows;
  bool comparable = false;
  for (const results::Moment& m : outcome.history) {
    rows.push_back({.localization = m.localization});
    comparable = comparable || (m.truth && m.localization.status != Status::kInitializing);
  }
  if (!comparable) return {};
  std::optional<std::vector<evaluation::Interval>> degraded;
  if (dataset.events_recorded) degraded = evaluation::degraded_intervals(dataset.events);
  return evaluation::score(rows, dataset.truth, degraded);
}

std::string to_text(const Outcome& outcome, const datasets::Dataset& dataset) {
  const Means mean = means(outcome.history);
  std::string text = fmt::format("{}: {} acquisitions", dataset.header.name, outcome.history.size());
  const char* separator = " - ";
  for (const auto& [status, count] : status_counts(outcome.history)) {
    text += fmt::format("{}{} {}", separator, count, status);
    separator = ", ";
  }
  text +=
      fmt::format("\nper acquisition: {:.1f} primitives seen, {:.1f} matched to the plan, {:.1f} tracks, {:.2f} ms\n",
                  mean.detected, mean.matched, mean.tracked, 1e3 * outcome.seconds_per_acquisition);
  text += fmt::format("mapped: {} sonar sweeps, {} scans; {} refused as their pose was too unsure\n",
                      outcome.mapped.sweeps, outcome.mapped.scans, outcome.mapped.refused);
  text += degradation_text(outcome, dataset);
  if (!dataset.header.floor_plan)
    text += "no floor plan: poses are relative to the start, status initializing\n";
  else if (!dataset.header.initial_pose)
    text += "no initial pose: poses are relative to the start, status initializing\n";
  text += "\n" + conflict_text(outcome.conflict);
  const bool on_plan = dataset.header.floor_plan && dataset.header.initial_pose;
  if (on_plan) text += "\n" + results::to_text(outcome.calibration, dataset.header.rig);
  if (const auto score = score_of(outcome, dataset)) {
    text += "\n" + evaluation::to_text(*score);
    text += fmt::format(
        "  {:<24} {:>12}   of {} matches: predicted from the true pose it is off by > 5 sigma and > 1 deg or 0.1 m\n",
        "wrong match", fmt::format("{:.1f} %", 100.0 * outcome.matches.wrong_share()), outcome.matches.matches);
  }
  return text;
}

ordered_json to_json(const evaluation::LocalizationScore& s) {
  return {{"acquisitions", s.acquisitions},
          {"with_truth", s.with_truth},
          {"placed", s.placed},
          {"mean_position_m", number_or_null(s.mean_position_m)},
          {"median_position_m", number_or_null(s.median_position_m)},
          {"rmse_position_m", number_or_null(s.rmse_position_m)},
          {"max_position_m", number_or_null(s.max_position_m)},
          {"mean_heading_rad", number_or_null(s.mean_heading_rad)},
          {"median_heading_rad", number_or_null(s.median_heading_rad)},
          {"rmse_heading_rad", number_or_null(s.rmse_heading_rad)},
          {"max_heading_rad", number_or_null(s.max_heading_rad)},
          {"success", s.success},
          {"localized", s.localized},
          {"lost", s.lost},
          {"confidently_wrong", s.confidently_wrong},
          {"confidently_right", s.confidently_right},
          {"alert", s.alert},
          {"false_alert", s.false_alert},
          {"degradation_known", s.degradation_known},
          {"available", number_or_null(s.available)},
          {"misleading", number_or_null(s.misleading)},
          {"nees_over_time", number_or_null(s.anees)},
          {"inside_3_sigma", s.inside_3_sigma},
          {"lost_count", s.lost_count},
          {"auroc", number_or_null(s.auroc)},
          {"calibration_error", number_or_null(s.calibration_error)}};
}

ordered_json to_json(const Outcome& outcome, const datasets::Dataset& dataset) {
  const Means mean = means(outcome.history);
  ordered_json pairs = ordered_json::array();
  constexpr auto names = results::ConflictStatistics::kCriteria;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = i + 1; j < names.size(); ++j) {
      pairs.push_back({{"criteria", {names[i], names[j]}}, {"mean_conflict", outcome.conflict.of_pair(i, j)}});
    }
  }
  ordered_json result{
      {"dataset", dataset.header.name},
      {"acquisitions", outcome.history.size()},
      {"status", status_counts(outcome.history)},
      {"without_image", outcome.without_image},
      {"without_scan", outcome.without_scan},
      {"mean_detected", mean.detected},
      {"mean_matched", mean.matched},
      {"mean_tracked", mean.tracked},
      {"milliseconds_per_acquisition", 1e3 * outcome.seconds_per_acquisition},
      {"mapped",
       {{"sonar_sweeps", outcome.mapped.sweeps}, {"scans", outcome.mapped.scans}, {"refused", outcome.mapped.refused}}},
      {"conflict", {{"segments", outcome.conflict.segments()}, {"mean", outcome.conflict.mean()}, {"pairs", pairs}}}};
  const auto score = score_of(outcome, dataset);
  result["matches"] = {{"count", outcome.matches.matches}, {"wrong", outcome.matches.wrong}};
  result["score"] = score ? to_json(*score) : ordered_json(nullptr);
  return result;
}

}  // namespace credo::apps
