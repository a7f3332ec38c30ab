// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/samples.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace credo::evaluation {
namespace {

using localization::Status;

bool within(std::span<const Interval> intervals, sensors::Timestamp time) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [time](const Interval& i) { return time >= i.first && time <= i.second; });
}

}  // namespace

std::optional<geometry::Pose2> truth_at(std::span<const datasets::TimedPose> truth, sensors::Timestamp time,
                                        const ScoreParams& params) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), time,
                       [](const datasets::TimedPose& row, sensors::Timestamp t) { return row.time < t; });
  if (after != truth.end() && after->time == time) return after->pose;
  if (after != truth.begin() && after != truth.end()) {
    const datasets::TimedPose &a = *(after - 1), &b = *after;
    const double gap = sensors::seconds_between(a.time, b.time);
    if (gap <= params.truth_max_gap_s)
      return geometry::interpolate(a.pose, b.pose, sensors::seconds_between(a.time, time) / gap);
  }
  const datasets::TimedPose* nearest = nullptr;
  if (after != truth.begin()) nearest = &*(after - 1);
  if (after != truth.end() && (nearest == nullptr || after->time - time < time - nearest->time)) nearest = &*after;
  if (nearest == nullptr || std::abs(sensors::seconds_between(nearest->time, time)) > params.truth_max_diff_s)
    return {};
  return nearest->pose;
}

std::vector<Interval> degraded_intervals(const std::vector<datasets::Event>& events) {
  constexpr sensors::Timestamp kNever = std::numeric_limits<sensors::Timestamp>::max();
  std::vector<Interval> intervals;
  std::map<std::string, std::size_t> open;  // by the sensor's name
  for (const datasets::Event& event : events) {
    const std::size_t cut = event.name.rfind('_');
    if (cut == std::string::npos) continue;
    const std::string sensor = event.name.substr(0, cut), what = event.name.substr(cut + 1);
    if (what == "degraded" || what == "failed") {
      if (open.contains(sensor)) continue;  // it gets worse
      open[sensor] = intervals.size();
      intervals.emplace_back(event.time, kNever);
    } else if (what == "restored" && open.contains(sensor)) {
      intervals[open[sensor]].second = event.time;
      open.erase(sensor);
    }
  }
  return intervals;
}

std::vector<Sample> samples_of(std::span<const results::LocalizationRow> rows,
                               std::span<const datasets::TimedPose> truth, std::span<const Interval> degraded,
                               const ScoreParams& params) {
  std::vector<Sample> samples;
  for (const results::LocalizationRow& row : rows) {
    const sensors::Timestamp time = row.localization.time;
    const auto pose = truth_at(truth, time, params);
    if (!pose) continue;
    samples.push_back({.localization = row.localization, .truth = *pose, .degraded = within(degraded, time)});
  }
  if (samples.empty()) {
    throw std::invalid_argument(
        "no acquisition has a ground truth at its time: do the result and the reference belong together?");
  }
  return samples;
}

EvaluatedRun evaluated_run(std::string name, std::span<const results::LocalizationRow> rows,
                           std::span<const datasets::TimedPose> truth,
                           const std::optional<std::vector<datasets::Event>>& events, const ScoreParams& params) {
  EvaluatedRun run{.name = std::move(name), .events_known = events.has_value()};
  std::vector<Interval> degraded;
  if (events) {
    degraded = degraded_intervals(*events);
    for (const datasets::Event& event : *events) {
      if (event.name == "kidnapped") run.kidnaps.push_back(event.time);
    }
  }
  run.samples = samples_of(rows, truth, degraded, params);
  return run;
}

bool is_beyond(const Sample& s, double limit_m, double limit_deg) {
  return s.placed() && (s.position_m() > limit_m || s.heading_rad() > geometry::to_radians(limit_deg));
}

bool is_lost(const Sample& s, const ScoreParams& p) { return is_beyond(s, p.lost_above_m, p.lost_above_deg); }

bool is_alert(const Sample& s) { return s.localization.status != Status::kLocalized; }

bool is_false_alert(const Sample& s, const ScoreParams& p) {
  return is_alert(s) && s.placed() && s.position_m() < p.lost_above_m &&
         s.heading_rad() < geometry::to_radians(p.lost_above_deg) && !s.degraded;
}

bool is_available(const Sample& s, const ScoreParams& p) {
  return s.localization.status == Status::kLocalized &&
         s.localization.protection.position_high_m <= p.available_level_m &&
         s.localization.protection.heading_high_rad <= geometry::to_radians(p.available_level_deg);
}

bool is_misleading(const Sample& s, const ScoreParams& p) {
  return is_available(s, p) && (s.position_m() > s.localization.protection.position_high_m ||
                                s.heading_rad() > s.localization.protection.heading_high_rad);
}

bool is_monitored(const Sample& s) { return !std::isnan(s.localization.protection.position_high_m); }

}  // namespace credo::evaluation
