// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/lost_detection.hpp"

#include <algorithm>
#include <numeric>

namespace credo::evaluation {
namespace {

/// The first of the samples that fulfils the condition, timed from `since`.
template <typename Condition>
std::optional<Response> first(std::span<const Sample> samples, sensors::Timestamp since, const Condition& condition) {
  const auto found = std::find_if(samples.begin(), samples.end(), condition);
  if (found == samples.end()) return {};
  return Response{.acquisitions = static_cast<int>(found - samples.begin()) + 1,
                  .seconds = sensors::seconds_between(since, found->localization.time)};
}

}  // namespace

std::optional<double> auroc(std::span<const double> good, std::span<const double> bad) {
  if (good.empty() || bad.empty()) return {};
  std::vector<double> sorted(bad.begin(), bad.end());
  std::sort(sorted.begin(), sorted.end());
  double wins = 0.0;
  for (const double value : good) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
    wins += static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
  }
  return wins / (static_cast<double>(good.size()) * static_cast<double>(bad.size()));
}

DetectionCurve detection_curve(std::span<const double> suspicion, const std::vector<bool>& lost) {
  std::vector<double> of_lost, of_others;
  for (std::size_t i = 0; i < suspicion.size(); ++i) (lost[i] ? of_lost : of_others).push_back(suspicion[i]);
  DetectionCurve curve{.auroc = auroc(of_lost, of_others)};
  if (!curve.auroc) return {};
  std::vector<std::size_t> order(suspicion.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return suspicion[a] > suspicion[b]; });
  double caught = 0.0, caught_lost = 0.0, average = 0.0, recall_before = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    caught += 1.0;
    caught_lost += lost[order[k]] ? 1.0 : 0.0;
    const double threshold = suspicion[order[k]];
    if (k + 1 < order.size() && suspicion[order[k + 1]] == threshold) continue;  // equal ones are caught together
    const OperatingPoint point{.threshold = threshold,
                               .recall = caught_lost / static_cast<double>(of_lost.size()),
                               .false_alarm_share = (caught - caught_lost) / static_cast<double>(of_others.size()),
                               .precision = caught_lost / caught};
    average += (point.recall - recall_before) * point.precision;
    recall_before = point.recall;
    curve.points.push_back(point);
  }
  curve.average_precision = average;
  return curve;
}

std::vector<LostEpisode> lost_episodes(const EvaluatedRun& run, const ScoreParams& params) {
  std::vector<LostEpisode> episodes;
  const std::span<const Sample> samples = run.samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!is_lost(samples[i], params)) continue;
    std::size_t end = i + 1;
    while (end < samples.size() && (is_lost(samples[end], params) || !samples[end].placed())) ++end;
    const sensors::Timestamp onset = samples[i].localization.time;
    episodes.push_back({.onset = onset,
                        .acquisitions = static_cast<int>(end - i),
                        .alert = first(samples.subspan(i, end - i), onset, is_alert)});
    i = end;
  }
  return episodes;
}

std::vector<Kidnap> kidnaps(const EvaluatedRun& run, const ScoreParams& params) {
  std::vector<Kidnap> result;
  const auto first_from = [&](sensors::Timestamp time) {
    return std::lower_bound(run.samples.begin(), run.samples.end(), time,
                            [](const Sample& s, sensors::Timestamp t) { return s.localization.time < t; });
  };
  for (std::size_t k = 0; k < run.kidnaps.size(); ++k) {
    const sensors::Timestamp time = run.kidnaps[k];
    const auto end = k + 1 < run.kidnaps.size() ? first_from(run.kidnaps[k + 1]) : run.samples.end();
    const std::span<const Sample> after(first_from(time), end);
    result.push_back(
        {.time = time, .alert = first(after, time, is_alert), .recovery = first(after, time, [&](const Sample& s) {
                                                                return !is_alert(s) && !is_lost(s, params);
                                                              })});
  }
  return result;
}

FalseAlarms false_alarms(const EvaluatedRun& run, const ScoreParams& params) {
  FalseAlarms result;
  bool before = false;
  for (const Sample& sample : run.samples) {
    const bool now = is_false_alert(sample, params);
    result.count += now && !before ? 1 : 0;
    before = now;
  }
  if (!run.samples.empty()) {
    const double seconds =
        sensors::seconds_between(run.samples.front().localization.time, run.samples.back().localization.time);
    result.hours = seconds / 3600.0;
  }
  return result;
}

}  // namespace credo::evaluation
