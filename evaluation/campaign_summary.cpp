// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "evaluation/campaign_measures.hpp"

namespace credo::evaluation {
namespace {

RunRemark remark_on(const CampaignRun& run, const ScoreParams& words) {
  RunRemark remark{.key = run.key};
  for (const CampaignRow& row : run.rows) {
    const Sample& sample = row.sample;
    if (!sample.placed()) continue;
    remark.misleading += is_misleading(sample, words) ? 1 : 0;
    remark.confidently_wrong += is_confident(sample, words) && is_wrong(sample, words) ? 1 : 0;
    remark.lost += is_lost(sample, words) ? 1 : 0;
    remark.max_position_m = std::max(remark.max_position_m, sample.position_m());
    remark.max_heading_rad = std::max(remark.max_heading_rad, sample.heading_rad());
  }
  return remark;
}

std::vector<RunRemark> worst_of(std::span<const CampaignRun> runs, const SummaryParams& params) {
  std::vector<RunRemark> remarks;
  for (const CampaignRun& run : runs)
    if (!run.rows.empty()) remarks.push_back(remark_on(run, params.words));
  const auto rank = [](const RunRemark& r) {
    return std::tuple(r.misleading, r.confidently_wrong, r.lost, r.max_position_m);
  };
  std::stable_sort(remarks.begin(), remarks.end(),
                   [&](const RunRemark& a, const RunRemark& b) { return rank(a) > rank(b); });
  if (remarks.size() > params.worst_runs) remarks.resize(params.worst_runs);
  return remarks;
}

/// \param wanted  the degradation; empty: all
GroupSummary summarise_group(std::string name, const std::string& wanted, std::span<const CampaignRun> runs,
                             const SummaryParams& params) {
  GroupSummary group;
  group.name = std::move(name);
  std::vector<const CampaignRun*> members;
  for (const CampaignRun& run : runs) {
    if (!wanted.empty() && run.key.degradation != wanted) continue;
    ++(run.refused.empty() ? group.runs : group.refused);
    if (run.rows.empty()) continue;
    members.push_back(&run);
    group.acquisitions += static_cast<long>(run.rows.size());
    for (const CampaignRow& row : run.rows) {
      group.misleading += is_misleading(row.sample, params.words) ? 1 : 0;
      if (!is_alert(row.sample)) group.matches += row.matches;
    }
  }
  group.measures = measures_of(members, params);
  return group;
}

/// Empty where there is no number.
std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

std::string cells(const MatchCounts& counts) {
  const std::string text = fmt::format(",{},{}", counts.matches, counts.wrong);
  if (counts.matches == 0) return text + ",,,";
  const Bounds interval = counts.wrong_among_all().interval();
  return text + fmt::format(",{},{},{}", cell(counts.wrong_share()), cell(interval.lower), cell(interval.upper));
}

}  // namespace

const Measure& GroupSummary::measure(std::string_view wanted) const {
  const auto at =
      std::find_if(measures.begin(), measures.end(), [wanted](const Measure& m) { return m.name == wanted; });
  assert(at != measures.end());
  return *at;
}

CampaignSummary summarise(const CampaignSpec& spec, std::span<const CampaignRun> runs, const SummaryParams& params) {
  CampaignSummary summary;
  summary.runs_wanted = runs_of(spec).size();
  summary.worst = worst_of(runs, params);
  for (const std::string& degradation : spec.degradations)
    summary.groups.push_back(summarise_group(degradation, degradation, runs, params));
  summary.groups.push_back(summarise_group("all", "", runs, params));
  for (const CampaignRun& run : runs)
    if (!run.refused.empty()) summary.refused.push_back(run);
  return summary;
}

std::string to_csv(const CampaignSummary& summary) {
  std::string text = "#group,runs,refused,acquisitions";
  for (const Measure& m : summary.groups.front().measures)
    text += fmt::format(",{0}{1},{0}_low,{0}_high", m.name, m.unit.empty() ? "" : " [" + m.unit + "]");
  for (std::size_t i = 0; i < localization::kFaultClasses; ++i)
    text += fmt::format(",{0},wrong_{0},wrong_{0}_share,wrong_{0}_low,wrong_{0}_high", fault_class_name(i));
  for (const GroupSummary& group : summary.groups) {
    text += fmt::format("\n{},{},{},{}", group.name, group.runs, group.refused, group.acquisitions);
    for (const Measure& m : group.measures)
      text += m.estimate
                  ? fmt::format(",{},{},{}", cell(m.estimate->value), cell(m.estimate->low), cell(m.estimate->high))
                  : std::string(",,,");
    for (const MatchCounts& counts : group.matches.classes) text += cells(counts);
  }
  return text + "\n";
}

}  // namespace credo::evaluation
