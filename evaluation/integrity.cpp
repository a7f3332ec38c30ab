// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/integrity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace credo::evaluation {
namespace {

using Suspicion = std::function<double(const Sample&)>;

/// [m^2]
double largest_position_variance(const Sample& s) {
  const Eigen::Matrix2d covariance = s.localization.estimate.covariance.topLeftCorner<2, 2>();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()[1];
}

/// The larger of the two levels, each in its limit; without a monitor there is none that the error must respect.
double protection_level(const Sample& s, const ScoreParams& params) {
  if (!is_monitored(s)) return std::numeric_limits<double>::infinity();
  const localization::ProtectionLevels& p = s.localization.protection;
  return std::max(p.position_high_m / params.available_level_m,
                  p.heading_high_rad / geometry::to_radians(params.available_level_deg));
}

std::vector<Detector> detectors_of(const std::vector<const Sample*>& placed, const std::vector<bool>& lost,
                                   const ScoreParams& params) {
  std::vector<std::pair<const char*, Suspicion>> suspicions{
      {"BetP(YES)", [](const Sample& s) { return -s.localization.belief.pignistic(); }},
      {"conflict", [](const Sample& s) { return s.localization.conflict; }},
      {"largest sigma", largest_position_variance}};
  if (std::any_of(placed.begin(), placed.end(), [](const Sample* s) { return is_monitored(*s); }))
    suspicions.emplace_back("protection level", [&](const Sample& s) { return protection_level(s, params); });
  std::vector<Detector> detectors;
  for (const auto& [name, suspicion] : suspicions) {
    std::vector<double> values;
    for (const Sample* s : placed) values.push_back(suspicion(*s));
    detectors.push_back({name, detection_curve(values, lost)});
  }
  return detectors;
}

ProtectionRegion region_of(bool localized, double error, double level, double limit) {
  if (!localized || level > limit) return ProtectionRegion::kUnavailable;
  if (error <= level) return ProtectionRegion::kNominal;
  return error <= limit ? ProtectionRegion::kMisleading : ProtectionRegion::kHazardous;
}

void add_protection_points(Integrity& result, const std::vector<const Sample*>& placed) {
  const auto add = [](ProtectionDiagram& diagram, bool localized, double error, double level) {
    diagram.points.push_back({error, level, region_of(localized, error, level, diagram.limit)});
  };
  for (const Sample* s : placed) {
    if (!is_monitored(*s)) continue;
    add(result.position, !is_alert(*s), s->position_m(), s->localization.protection.position_high_m);
    add(result.heading, !is_alert(*s), s->heading_rad(), s->localization.protection.heading_high_rad);
  }
}

void count(Integrity& result, const Sample& s, const ScoreParams& params) {
  const bool lost = is_lost(s, params);
  result.placed.add(s.placed());
  result.false_alert.add(is_false_alert(s, params));
  result.available->add(is_available(s, params));
  result.misleading->add(is_misleading(s, params));
  if (s.placed()) result.lost.add(lost);
  if (lost) result.unnoticed.add(!is_alert(s));
}

void add_run(Integrity& result, const EvaluatedRun& run, const ScoreParams& params) {
  result.events_known = result.events_known && run.events_known;
  for (const Sample& sample : run.samples) count(result, sample, params);
  for (const LostEpisode& episode : lost_episodes(run, params)) result.episodes.push_back(episode);
  for (const Kidnap& kidnap : kidnaps(run, params)) result.kidnaps.push_back(kidnap);
  const FalseAlarms alarms = false_alarms(run, params);
  result.false_alarms.count += alarms.count;
  result.false_alarms.hours += alarms.hours;
}

bool came_within(const std::optional<Response>& response, int acquisitions) {
  return response && response->acquisitions <= acquisitions;
}

std::optional<double> share_of(const std::optional<Proportion>& proportion) {
  return proportion ? proportion->share() : std::nullopt;
}

}  // namespace

const char* to_string(ProtectionRegion region) {
  switch (region) {
    case ProtectionRegion::kNominal: return "nominal";
    case ProtectionRegion::kUnavailable: return "unavailable";
    case ProtectionRegion::kMisleading: return "misleading";
    case ProtectionRegion::kHazardous: return "hazardous";
  }
  return "unknown";
}

Proportion ProtectionDiagram::in(ProtectionRegion region) const {
  const auto found = std::count_if(points.begin(), points.end(), [&](const auto& p) { return p.region == region; });
  return {.count = static_cast<std::size_t>(found), .of = points.size()};
}

Proportion Integrity::missed_episodes() const {
  Proportion result;
  for (const LostEpisode& episode : episodes) result.add(!episode.alert);
  return result;
}

std::optional<double> Integrity::false_alarms_per_hour() const {
  if (!(false_alarms.hours > 0.0)) return {};
  return false_alarms.count / false_alarms.hours;
}

Proportion Integrity::noticed(int within) const {
  Proportion result;
  for (const Kidnap& k : kidnaps) result.add(came_within(k.alert, within) || came_within(k.recovery, within));
  return result;
}

Proportion Integrity::recovered(int within) const {
  Proportion result;
  for (const Kidnap& k : kidnaps) result.add(came_within(k.recovery, within));
  return result;
}

Integrity integrity(std::span<const EvaluatedRun> runs, const ScoreParams& params) {
  Integrity result{.runs = static_cast<int>(runs.size()), .available = Proportion{}, .misleading = Proportion{}};
  result.position.limit = params.available_level_m;
  result.heading.limit = geometry::to_radians(params.available_level_deg);
  std::vector<const Sample*> placed;
  for (const EvaluatedRun& run : runs) {
    add_run(result, run, params);
    for (const Sample& sample : run.samples) {
      if (sample.placed()) placed.push_back(&sample);
    }
  }
  if (placed.empty()) throw std::invalid_argument("all acquisitions with a truth are initializing: nothing to judge");
  std::vector<double> probabilities;
  std::vector<evidence::BinaryMass> beliefs;
  std::vector<bool> lost, correct;
  for (const Sample* s : placed) {
    beliefs.push_back(s->localization.belief);
    probabilities.push_back(beliefs.back().pignistic());
    lost.push_back(is_lost(*s, params));
    correct.push_back(!lost.back());
  }
  result.detectors = detectors_of(placed, lost, params);
  result.reliability = reliability(probabilities, correct);
  result.belief_interval = interval_calibration(beliefs, correct);
  result.risk = risk_coverage(runs, params);
  add_protection_points(result, placed);
  if (result.position.points.empty()) result.available = result.misleading = std::nullopt;
  return result;
}

std::vector<NamedFigure> figures(const Integrity& i, const KidnapParams& kidnap) {
  const DetectionCurve belief = i.detectors.empty() ? DetectionCurve{} : i.detectors.front().curve;
  return {{"lost", i.lost.share()},
          {"available", share_of(i.available)},
          {"misleading", share_of(i.misleading)},
          {"misleading_upper_bound", i.misleading ? std::optional(i.misleading->upper_bound()) : std::nullopt},
          {"false_alert", i.false_alert.share()},
          {"unnoticed", i.unnoticed.share()},
          {"auroc", belief.auroc},
          {"average_precision", belief.average_precision},
          {"missed_episodes", i.missed_episodes().share()},
          {"false_alarms_per_hour", i.false_alarms_per_hour()},
          {"kidnap_noticed", i.noticed(kidnap.noticed_within).share()},
          {"kidnap_recovered", i.recovered(kidnap.recovered_within).share()},
          {"calibration_error", i.reliability.calibration_error},
          {"brier", i.reliability.brier},
          {"log_loss", i.reliability.log_loss},
          {"interval_coverage", i.belief_interval.covered.share()},
          {"interval_width", i.belief_interval.mean_width},
          {"area_under_risk", area_under_risk(i.risk)}};
}

}  // namespace credo::evaluation
