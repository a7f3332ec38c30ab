// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/integrity_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/output.hpp"

namespace credo::apps {
namespace {

using nlohmann::ordered_json;

ordered_json counted(const evaluation::Proportion& p) {
  const evaluation::Bounds b = p.interval();
  return {{"count", p.count},
          {"of", p.of},
          {"share", number_or_null(p.share())},
          {"lower_95", b.lower},
          {"upper_95", b.upper}};
}

ordered_json counted(const std::optional<evaluation::Proportion>& p) { return p ? counted(*p) : ordered_json(nullptr); }

/// Every so many points of a curve, its first and its last.
template <typename Point, typename ToJson>
ordered_json thinned(const std::vector<Point>& curve, const ToJson& to_json) {
  constexpr std::size_t kMost = 200;
  ordered_json result = ordered_json::array();
  const std::size_t count = std::min(curve.size(), kMost);
  for (std::size_t k = 0; k < count; ++k)
    result.push_back(to_json(curve[count > 1 ? k * (curve.size() - 1) / (count - 1) : 0]));
  return result;
}

ordered_json detectors(const evaluation::Integrity& integrity) {
  ordered_json result = ordered_json::array();
  for (const evaluation::Detector& d : integrity.detectors) {
    result.push_back({{"name", d.name},
                      {"auroc", number_or_null(d.curve.auroc)},
                      {"average_precision", number_or_null(d.curve.average_precision)},
                      {"curve", thinned(d.curve.points, [](const evaluation::OperatingPoint& p) {
                         return ordered_json{
                             {"recall", p.recall}, {"false_alarms", p.false_alarm_share}, {"precision", p.precision}};
                       })}});
  }
  return result;
}

ordered_json response(const std::optional<evaluation::Response>& r) {
  return r ? ordered_json{{"acquisitions", r->acquisitions}, {"seconds", r->seconds}} : ordered_json(nullptr);
}

ordered_json events(const evaluation::Integrity& integrity) {
  ordered_json episodes = ordered_json::array(), kidnaps = ordered_json::array();
  for (const evaluation::LostEpisode& e : integrity.episodes)
    episodes.push_back({{"onset_ns", e.onset}, {"acquisitions", e.acquisitions}, {"alert", response(e.alert)}});
  for (const evaluation::Kidnap& k : integrity.kidnaps)
    kidnaps.push_back({{"time_ns", k.time}, {"alert", response(k.alert)}, {"recovery", response(k.recovery)}});
  return {{"lost", episodes}, {"kidnaps", kidnaps}};
}

ordered_json calibration(const evaluation::Integrity& integrity) {
  ordered_json reliability = ordered_json::array(), intervals = ordered_json::array();
  for (const evaluation::ReliabilityBin& bin : integrity.reliability.bins)
    reliability.push_back({{"probability", bin.probability}, {"came_true", counted(bin.came_true)}});
  for (const evaluation::BeliefBin& bin : integrity.belief_interval.bins)
    intervals.push_back({{"belief", bin.belief},
                         {"plausibility", bin.plausibility},
                         {"came_true", counted(bin.came_true)},
                         {"agrees", bin.agrees()}});
  return {{"reliability", reliability}, {"intervals", intervals}};
}

ordered_json regions(const evaluation::ProtectionDiagram& diagram) {
  using evaluation::ProtectionRegion;
  ordered_json result;
  for (const auto region : {ProtectionRegion::kNominal, ProtectionRegion::kUnavailable, ProtectionRegion::kMisleading,
                            ProtectionRegion::kHazardous})
    result[to_string(region)] = diagram.in(region).count;
  return result;
}

}  // namespace

ordered_json to_json(const evaluation::Integrity& integrity) {
  ordered_json named;
  for (const auto& [name, value] : evaluation::figures(integrity)) named[name] = number_or_null(value);
  ordered_json result{
      {"runs", integrity.runs},
      {"events_known", integrity.events_known},
      {"figures", named},
      {"placed", counted(integrity.placed)},
      {"lost", counted(integrity.lost)},
      {"available", counted(integrity.available)},
      {"misleading", counted(integrity.misleading)},
      {"false_alert", counted(integrity.false_alert)},
      {"unnoticed", counted(integrity.unnoticed)},
      {"detectors", detectors(integrity)},
      {"false_alarms", {{"count", integrity.false_alarms.count}, {"hours", integrity.false_alarms.hours}}}};
  result["events"] = events(integrity);
  result["calibration"] = calibration(integrity);
  result["risk"] = thinned(integrity.risk, [](const evaluation::RiskPoint& p) {
    return ordered_json{{"coverage", p.coverage},
                        {"lost", p.lost},
                        {"mean_position_m", p.mean_position_m},
                        {"mean_heading_rad", p.mean_heading_rad}};
  });
  result["protection"] = {{"position", regions(integrity.position)}, {"heading", regions(integrity.heading)}};
  return result;
}

}  // namespace credo::apps
