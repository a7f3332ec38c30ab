// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "grids/mass_map.hpp"
#include "mapping/cell_rules.hpp"
#include "mapping/changing_fold.hpp"
#include "mapping/mapper.hpp"

namespace credo::mapping {

/// How cells take readings in: a read-out of the map that no order changes, or a fold.
using MapRule = std::variant<grids::ReadOut, DsmcFold, DempsterFold, DempsterFloatFold, Pcr2Fold, Pcr5Fold, DsmhFold,
                             BayesFold, ApproximatedDempsterFold, ChangingFold>;

/// A rule with its name and what it is in a few words.
struct NamedRule {
  std::string_view name;
  MapRule rule;
  std::string_view what;
};

/// dempster, dsmc, bayes (read-outs of one map); dempster_float, dempster_fold, dsmc_fold, pcr2, pcr5, dsmh,
/// bayes_betp, adaptive, fixed, changing.
[[nodiscard]] std::span<const NamedRule> map_rules();
/// \throws std::invalid_argument for another name
[[nodiscard]] const NamedRule& map_rule(std::string_view name);

/// What a settled cell of the rule `changing` is, and since when.
struct CellHistory {
  grids::CellIndex cell;
  bool occupied = false;
  sensors::Timestamp since = 0;
  std::int32_t changes = 0;  ///< how often it was found in the other state

  friend bool operator==(const CellHistory&, const CellHistory&) = default;
};

/// A map of any rule.
struct RuleMap {
  grids::MassMap map;
  MappingCounts counts;
  std::int64_t without_pose = 0;       ///< readings left out for want of a pose near in time
  std::int64_t abandoned = 0;          ///< readings of a cell that a fold could not take in: total conflict
  std::vector<CellHistory> history{};  ///< of the rule `changing`: its settled cells, tile by tile
};

/// The map of a whole drive, as map_along of mapper.hpp. Folds take the readings in in the order of their times, those
/// of equal times scans first.
[[nodiscard]] RuleMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                                const TrajectoryMappingParams& params, const MapRule& rule,
                                const std::function<void(double share)>& progress = {});

}  // namespace credo::mapping
