// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/campaign_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/shipped.hpp"
#include "geometry/angles.hpp"

namespace credo::apps {
namespace {

using evaluation::CampaignSummary;
using evaluation::GroupSummary;
using evaluation::MatchCounts;
using evaluation::Measure;
using nlohmann::ordered_json;

/// A column of the table by degradation.
struct Column {
  const char* measure;
  const char* title;
  double factor;  ///< from the measure's unit to that of the title
  int decimals;
};
constexpr Column kColumns[] = {{"mean_position", "pos cm", 100, 2},
                               {"p95_position", "p95 cm", 100, 2},
                               {"mean_heading", "head deg", 1, 3},
                               {"lost", "lost %", 100, 2},
                               {"available", "avail %", 100, 1},
                               {"false_alert", "false alert %", 100, 2},
                               {"confidently_wrong", "conf wrong %", 100, 2},
                               {"wrong_matches", "wrong match %", 100, 2},
                               {"auroc", "AUROC", 1, 3},
                               {"calibration_error", "ECE", 1, 3},
                               {"nees", "NEES", 1, 2},
                               {"displaced_alert", "alert %", 100, 0},
                               {"displaced_recovered", "recov %", 100, 0},
                               {"start_resolved", "start %", 100, 0}};

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "inf";
}

std::string degradation_table(const CampaignSummary& summary, const std::map<std::string, double>& milliseconds) {
  std::string text = fmt::format("{:<14}  {:>5}  {:>7}", "degradation", "runs", "acq");
  for (const Column& c : kColumns) text += fmt::format("  {}", c.title);
  text += "  misleading     ms\n";
  for (const GroupSummary& group : summary.groups) {
    text += fmt::format("{:<14}  {:>5}  {:>7}", group.name, group.runs, group.acquisitions);
    for (const Column& c : kColumns) {
      const auto& estimate = group.measure(c.measure).estimate;
      text += fmt::format("  {:>{}}", estimate ? fixed(c.factor * estimate->value, c.decimals) : "-",
                          std::string_view(c.title).size());
    }
    const auto ms = milliseconds.find(group.name);
    text += fmt::format("  {:>10}  {:>5}\n", group.misleading, ms != milliseconds.end() ? fixed(ms->second, 2) : "-");
  }
  return text;
}

std::string with_interval(const Measure& m) {
  if (!m.estimate) return "-";
  const std::string unit = m.unit.empty() ? "" : " " + m.unit;
  if (std::isnan(m.estimate->low)) return fmt::format("{:.4g}{}", m.estimate->value, unit);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]{}", m.estimate->value, m.estimate->low, m.estimate->high, unit);
}

std::string measure_lines(const GroupSummary& group) {
  std::string text = "\nall runs together, with 95 % intervals\n";
  for (const Measure& m : group.measures)
    text += fmt::format("  {:<29} {:<34} {} (over {})\n", m.name, with_interval(m), m.meaning, m.cases);
  return text;
}

std::string match_counts_line(const GroupSummary& group) {
  std::string text = fmt::format("  {:<18}", group.name);
  for (const MatchCounts& counts : group.matches.classes)
    text += fmt::format("  {:>16}", fmt::format("{} / {}", counts.wrong, counts.matches));
  return text + "\n";
}

/// By the classes in which the integrity monitor has its fault priors: over everything with intervals, then the counts
/// by degradation.
std::string match_tables(const CampaignSummary& summary) {
  std::string text =
      "\nwrong matches by the belief of their track where it is localized, all runs, with 95 % intervals\n";
  text +=
      fmt::format("  {:<18}  {:>9}  {:>7}  {:>9}  [Clopper and Pearson]\n", "class", "matches", "wrong", "frequency");
  std::string head = fmt::format("  {:<18}", "degradation");
  for (std::size_t i = 0; i < localization::kFaultClasses; ++i) {
    const MatchCounts& counts = summary.groups.back().matches.classes[i];
    const evaluation::Bounds interval = counts.wrong_among_all().interval();
    text += fmt::format("  {:<18}  {:>9}  {:>7}  {:>9}  [{:.2g}, {:.2g}]\n", evaluation::fault_class_name(i),
                        counts.matches, counts.wrong,
                        counts.matches > 0 ? fmt::format("{:.2g}", counts.wrong_share()) : "-", interval.lower,
                        interval.upper);
    head += fmt::format("  {:>16}", evaluation::fault_class_name(i));
  }
  text += "\nthe same by degradation: wrong / matches\n" + head + "\n";
  for (const GroupSummary& group : summary.groups) text += match_counts_line(group);
  return text;
}

std::string worst_lines(const CampaignSummary& summary, perception::Method method) {
  std::string text = "\nworst runs (misleading, confidently wrong, lost acquisitions; largest errors)\n";
  for (const evaluation::RunRemark& r : summary.worst)
    text += fmt::format("  {:<36} {:>3} {:>3} {:>3}   {:8.1f} cm {:7.2f} deg\n    {}\n", name_of(r.key), r.misleading,
                        r.confidently_wrong, r.lost, 100.0 * r.max_position_m, geometry::to_degrees(r.max_heading_rad),
                        replay_command(r.key, method));
  return text;
}

ordered_json match_json(const MatchCounts& counts) {
  ordered_json json{
      {"count", counts.matches}, {"wrong", counts.wrong}, {"share", nullptr}, {"low", nullptr}, {"high", nullptr}};
  if (counts.matches == 0) return json;
  const evaluation::Bounds interval = counts.wrong_among_all().interval();
  json["share"] = counts.wrong_share();
  json["low"] = interval.lower;
  json["high"] = interval.upper;
  return json;
}

ordered_json group_json(const GroupSummary& group) {
  ordered_json json{{"name", group.name},
                    {"runs", group.runs},
                    {"refused", group.refused},
                    {"acquisitions", group.acquisitions},
                    {"misleading_acquisitions", group.misleading}};
  for (const Measure& m : group.measures) {
    ordered_json& entry = json["measures"][m.name];
    entry = {{"value", nullptr}, {"low", nullptr}, {"high", nullptr}, {"unit", m.unit}, {"over", m.cases}};
    if (!m.estimate) continue;
    entry["value"] = m.estimate->value;
    entry["low"] = m.estimate->low;
    entry["high"] = m.estimate->high;
  }
  for (std::size_t i = 0; i < localization::kFaultClasses; ++i)
    json["matches"][evaluation::fault_class_name(i)] = match_json(group.matches.classes[i]);
  return json;
}

}  // namespace

std::string replay_command(const evaluation::RunKey& key, perception::Method method) {
  const std::string random = std::string(kRandomWorld) + ":";
  const bool of_a_kind = key.world.starts_with(random);
  const std::string world =
      of_a_kind ? kRandomWorld + std::string(" --kind ") + key.world.substr(random.size()) : key.world;
  const std::string folder = "replay/" + name_of(key);
  return fmt::format("credo simulate {} --seed {}{} --out {} && credo run {}{} --out {}/results", world, key.seed,
                     key.degradation == "nominal" ? "" : " --degraded " + key.degradation, folder, folder,
                     method == perception::Method::kPaper ? " --method paper" : "", folder);
}

std::string to_text(const CampaignSummary& summary, perception::Method method,
                    const std::map<std::string, double>& milliseconds) {
  const GroupSummary& all = summary.groups.back();
  std::string text = fmt::format("{} of {} runs are finished, {} of them refused; errors not aligned\n\n",
                                 all.runs + all.refused, summary.runs_wanted, all.refused);
  text += degradation_table(summary, milliseconds) + measure_lines(all);
  if (method == perception::Method::kDefault) text += match_tables(summary);  // the paper's has no such beliefs
  text += worst_lines(summary, method);
  if (!summary.refused.empty()) text += "\nrefused\n";
  for (const evaluation::CampaignRun& run : summary.refused)
    text += fmt::format("  {:<36} {}\n", name_of(run.key), run.refused);
  return text;
}

ordered_json to_json(const CampaignSummary& summary, perception::Method method) {
  const GroupSummary& all = summary.groups.back();
  ordered_json json{{"runs_wanted", summary.runs_wanted}, {"runs_finished", all.runs + all.refused},
                    {"groups", ordered_json::array()},    {"meanings", ordered_json::object()},
                    {"worst", ordered_json::array()},     {"refused", ordered_json::array()}};
  for (const GroupSummary& group : summary.groups) json["groups"].push_back(group_json(group));
  for (const Measure& m : all.measures) json["meanings"][m.name] = m.meaning;
  for (const evaluation::RunRemark& r : summary.worst)
    json["worst"].push_back({{"run", name_of(r.key)},
                             {"misleading", r.misleading},
                             {"confidently_wrong", r.confidently_wrong},
                             {"lost", r.lost},
                             {"max_position_m", r.max_position_m},
                             {"max_heading_rad", r.max_heading_rad},
                             {"replay", replay_command(r.key, method)}});
  for (const evaluation::CampaignRun& run : summary.refused)
    json["refused"].push_back({{"run", name_of(run.key)}, {"why", run.refused}});
  return json;
}

}  // namespace credo::apps
