// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "evaluation/integrity.hpp"
#include "evaluation/pose_error.hpp"
#include "evaluation/table_row.hpp"

namespace credo::evaluation {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

/// "3 of 40; 95 %: 1.6 to 20.4 %"
std::string with_interval(const Proportion& p) {
  const Bounds b = p.interval();
  return fmt::format("{} of {}; 95 %: {:.1f} to {:.1f} %", p.count, p.of, 100.0 * b.lower, 100.0 * b.upper);
}

std::string share_row(const char* name, const Proportion& p, const std::string& meaning) {
  return table_row(name, percent(p.share()), meaning + (p.of > 0 ? " (" + with_interval(p) + ")" : ""));
}

/// "median 1.5 s (acquisition 3), longest 4.0 s (acquisition 8)", over those that came.
template <typename Event>
std::string timing_text(const std::vector<Event>& events, std::optional<Response> Event::*response) {
  std::vector<double> seconds, acquisitions;
  for (const Event& event : events) {
    if (!(event.*response)) continue;
    seconds.push_back((event.*response)->seconds);
    acquisitions.push_back((event.*response)->acquisitions);
  }
  if (seconds.empty()) return "-";
  const Statistics s = statistics(seconds), a = statistics(acquisitions);
  return fmt::format("median {:.1f} s (acquisition {:g}), longest {:.1f} s (acquisition {:g})", s.median, a.median,
                     s.max, a.max);
}

std::string overview(const Integrity& i, const ScoreParams& p) {
  const auto limits = [](double m, double d, const char* word) { return fmt::format("{:g} m{}{:g} deg", m, word, d); };
  std::string text = fmt::format(
      "Integrity of {} run{}: {} acquisitions with a truth (not aligned), {} of them with a pose in the map\n", i.runs,
      i.runs == 1 ? "" : "s", i.placed.of, i.placed.count);
  text += share_row("lost", i.lost, "error > " + limits(p.lost_above_m, p.lost_above_deg, " or > "));
  const std::string available =
      "localized, protection levels within " + limits(p.available_level_m, p.available_level_deg, " and ");
  const std::string misleading = "available, yet the error is above the protection level";
  if (i.available) {
    text += share_row("available", *i.available, available);
    text += table_row("misleading", percent(i.misleading->share()),
                      fmt::format("{} ({} of {}; at most {:.4f} % at 95 %, one-sided)", misleading, i.misleading->count,
                                  i.misleading->of, 100.0 * i.misleading->upper_bound()));
  } else {
    text += table_row("available", "-", available + " (no integrity monitor)");
    text += table_row("misleading", "-", misleading);
  }
  return text + share_row("false alert", i.false_alert,
                          std::string("an alert with error below both limits of lost, ") +
                              (i.events_known ? "no sensor degraded" : "or less: not every run has an events.csv"));
}

std::string detection_text(const Integrity& i) {
  constexpr std::size_t kEnoughLost = 200;
  std::string text = fmt::format(
      "\nWhat tells the lost from the others: {} lost{}\n", i.lost.count,
      i.lost.count < kEnoughLost ? fmt::format(" (at least {} are asked for)", kEnoughLost) : std::string());
  text += fmt::format("  {:<24} {:>12}   {}\n", "", "AUROC", "average precision");
  for (const Detector& d : i.detectors)
    text += table_row(d.name, number(d.curve.auroc), number(d.curve.average_precision));
  return text;
}

std::string timing_text(const Integrity& i, const KidnapParams& kidnap) {
  std::string text = "\nIn time: an alert is any status but localized; acquisition 1 is the first after it happened\n";
  text += share_row("missed", i.missed_episodes(), "stretches of lost poses that end without an alert");
  text += table_row("detection delay", "", timing_text(i.episodes, &LostEpisode::alert));
  text += share_row("unnoticed", i.unnoticed, "lost acquisitions that say localized");
  text +=
      table_row("false alarms per hour", number(i.false_alarms_per_hour()),
                fmt::format("stretches of false alerts: {} in {:.2f} h", i.false_alarms.count, i.false_alarms.hours));
  if (i.kidnaps.empty()) return text;
  text += share_row("kidnap noticed", i.noticed(kidnap.noticed_within),
                    fmt::format("an alert, or localized and not lost, within {} acquisitions", kidnap.noticed_within));
  text += table_row("time to the alert", "", timing_text(i.kidnaps, &Kidnap::alert));
  text += share_row("kidnap recovered", i.recovered(kidnap.recovered_within),
                    fmt::format("localized and not lost within {} acquisitions", kidnap.recovered_within));
  return text + table_row("time to recover", "", timing_text(i.kidnaps, &Kidnap::recovery));
}

std::string belief_text(const Integrity& i) {
  const auto agreeing = std::count_if(i.belief_interval.bins.begin(), i.belief_interval.bins.end(),
                                      [](const BeliefBin& bin) { return bin.agrees(); });
  std::string text = "\nThe belief in \"the localization is correct\" against what is not lost\n";
  text += table_row("calibration error", number(i.reliability.calibration_error),
                    "ECE of BetP(YES), 10 bins of equal count");
  text += table_row("Brier score", number(i.reliability.brier), "mean (BetP(YES) - outcome)^2");
  text += table_row("log loss", number(i.reliability.log_loss), "mean -ln of the probability of the outcome");
  text += table_row("interval coverage", percent(i.belief_interval.covered.share()),
                    fmt::format("acquisitions in bins whose frequency meets [Bel, Pl]: {} of {} bins", agreeing,
                                i.belief_interval.bins.size()));
  return text + table_row("interval width", number(i.belief_interval.mean_width), "mean Pl - Bel");
}

std::string risk_text(const Integrity& i) {
  std::string text = "\nIf only the best believed poses are accepted (by BetP(YES), equal ones together)\n";
  text += fmt::format("  {:<24} {:>12}   {:>10} {:>12}\n", "coverage", "lost", "position", "heading");
  for (const double wanted : {0.5, 0.8, 0.9, 1.0}) {
    const auto point =
        std::find_if(i.risk.begin(), i.risk.end(), [&](const RiskPoint& r) { return r.coverage >= wanted - 1e-12; });
    text += fmt::format("  {:<24} {:>12}   {:>7.2f} cm {:>8.3f} deg\n", percent(point->coverage), percent(point->lost),
                        100.0 * point->mean_position_m, geometry::to_degrees(point->mean_heading_rad));
  }
  return text + table_row("area under risk", number(area_under_risk(i.risk)), "mean share of lost over coverage");
}

std::string protection_text(const Integrity& i) {
  if (!i.available) return "";
  std::string text =
      fmt::format("\nError against protection level, upper end: {} poses\n  {:<24}", i.position.points.size(), "");
  constexpr std::array kRegions{ProtectionRegion::kNominal, ProtectionRegion::kUnavailable,
                                ProtectionRegion::kMisleading, ProtectionRegion::kHazardous};
  for (const ProtectionRegion region : kRegions) text += fmt::format(" {:>12}", to_string(region));
  for (const auto& [name, diagram] : {std::pair{"position", &i.position}, {"heading", &i.heading}}) {
    text += fmt::format("\n  {:<24}", name);
    for (const ProtectionRegion region : kRegions) text += fmt::format(" {:>12}", diagram->in(region).count);
  }
  return text +
         "\n  nominal: error <= level; unavailable: not localized, or level > limit;"
         "\n  misleading: level < error <= limit; hazardous: level <= limit < error\n";
}

}  // namespace

std::string to_text(const Integrity& i, const ScoreParams& params, const KidnapParams& kidnap) {
  return overview(i, params) + detection_text(i) + timing_text(i, kidnap) + belief_text(i) + risk_text(i) +
         protection_text(i);
}

}  // namespace credo::evaluation
