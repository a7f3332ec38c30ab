// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/map_rule.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "mapping/sequential_mapper.hpp"

namespace credo::mapping {
namespace {

using grids::ReadOut;

const std::array kRules{
    NamedRule{"dempster", ReadOut::kDempster, "Dempster's rule, from the map that no order changes"},
    NamedRule{"dsmc", ReadOut::kDsmc, "DSm classic rule (TBM), from the same map"},
    NamedRule{"bayes", ReadOut::kBayes, "a log-odds filter of plausibilities, from the same map"},
    NamedRule{"bayes_betp", BayesFold{}, "a log-odds filter of each reading's pignistic probability"},
    NamedRule{"dempster_float", DempsterFloatFold{}, "Dempster's rule as a sum in floats, reading by reading"},
    NamedRule{"dempster_fold", DempsterFold{}, "Dempster's rule reading by reading, certain readings included"},
    NamedRule{"dsmc_fold", DsmcFold{}, "DSm classic rule reading by reading, in linear masses"},
    NamedRule{"pcr2", Pcr2Fold{}, "proportional conflict redistribution 2"},
    NamedRule{"pcr5", Pcr5Fold{}, "proportional conflict redistribution 5"},
    NamedRule{"dsmh", DsmhFold{}, "DSm hybrid rule: conflict to ignorance"},
    NamedRule{"adaptive", ApproximatedDempsterFold{}, "improved D-S rule of Zhu: readings approximated by history"},
    NamedRule{"fixed", ApproximatedDempsterFold{{.approximation = Approximation::kFixed}},
              "Dempster's rule, readings approximated alike"},
    NamedRule{"changing", ChangingFold{}, "DSm hybrid rule over time: what was empty may be occupied now"},
};

/// By time; those of equal times as they were given.
template <typename Reading>
std::vector<const Reading*> by_time(std::span<const Reading> readings) {
  std::vector<const Reading*> sorted;
  for (const Reading& reading : readings) sorted.push_back(&reading);
  std::ranges::stable_sort(sorted, {}, [](const Reading* reading) { return reading->time; });
  return sorted;
}

/// Calls insert(reading) in the order of the times; scans before sweeps.
template <typename Insert>
void in_order(std::span<const sensors::RangeScan> all_scans, std::span<const sensors::SonarSweep> all_sweeps,
              const Insert& insert) {
  const auto scans = by_time(all_scans);
  const auto sweeps = by_time(all_sweeps);
  std::size_t scan = 0, sweep = 0;
  while (scan < scans.size() || sweep < sweeps.size()) {
    const bool take_scan = sweep >= sweeps.size() || (scan < scans.size() && scans[scan]->time <= sweeps[sweep]->time);
    take_scan ? insert(*scans[scan++]) : insert(*sweeps[sweep++]);
  }
}

}  // namespace

std::span<const NamedRule> map_rules() { return kRules; }

const NamedRule& map_rule(std::string_view name) {
  std::string known;
  for (const NamedRule& rule : kRules) {
    if (rule.name == name) return rule;
    known += (known.empty() ? "" : ", ") + std::string(rule.name);
  }
  throw std::invalid_argument("no rule is called '" + std::string(name) + "': expected one of " + known);
}

namespace {

/// Empty for rules that keep none.
template <CellRule Rule>
std::vector<CellHistory> history_of([[maybe_unused]] const grids::CellGrid<typename Rule::Cell>& grid) {
  std::vector<CellHistory> history;
  if constexpr (std::is_same_v<Rule, ChangingFold>)
    grid.for_each([&](grids::CellIndex cell, const ChangingFold::Cell& content) {
      if (const auto since = since_when(content))
        history.push_back({cell, content.state == ChangingFold::State::kOccupied, *since, content.changes});
    });
  return history;
}

template <CellRule Rule>
RuleMap fold_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                   std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                   const TrajectoryMappingParams& params, const Rule& rule,
                   const std::function<void(double share)>& progress) {
  if (T_map_base.empty()) throw std::invalid_argument("the trajectory has no pose: nothing can be mapped along it");
  constexpr std::size_t kReportEvery = 64;
  SequentialMapper<Rule> mapper(rig, params.mapper, rule);
  const double all = static_cast<double>(scans.size() + sweeps.size());
  std::int64_t without_pose = 0;
  std::size_t done = 0;
  in_order(scans, sweeps, [&](const auto& reading) {
    if (progress && ++done % kReportEvery == 0) progress(static_cast<double>(done) / all);
    if (!covers(T_map_base, reading.time, params.max_gap_s)) {
      ++without_pose;
      return;
    }
    mapper.insert({{T_map_base.pose_at(reading.time), params.covariance}, params.belief}, reading, T_map_base);
  });
  return {mapper.masses(), mapper.counts(), without_pose, mapper.abandoned(), history_of<Rule>(mapper.grid())};
}

}  // namespace

RuleMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                  std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                  const TrajectoryMappingParams& params, const MapRule& rule,
                  const std::function<void(double share)>& progress) {
  return std::visit(
      [&](const auto& chosen) -> RuleMap {
        if constexpr (std::is_same_v<std::decay_t<decltype(chosen)>, ReadOut>) {
          const TrajectoryMap map = map_along(T_map_base, rig, scans, sweeps, params, progress);
          return {grids::mass_map(map.grid, chosen), map.counts, map.without_pose, 0, {}};
        } else {
          return fold_along(T_map_base, rig, scans, sweeps, params, chosen, progress);
        }
      },
      rule);
}

}  // namespace credo::mapping
