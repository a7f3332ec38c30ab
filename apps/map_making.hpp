// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>
#include <variant>
#include <vector>

#include "apps/map_files_options.hpp"
#include "apps/map_source.hpp"
#include "apps/output.hpp"
#include "mapping/judge_instruments.hpp"
#include "mapping/map_rule.hpp"

// The work of `credo map`: from readings and poses to a map.
namespace credo::apps {

struct MapOptions {
  MapSource from;
  SonarChoice sonar;
  LaserChoice laser;
  bool printed = false;
  std::string rule;  ///< empty: the map that no order changes, of which most rules are read-outs
  std::string out, pictures;
  MapFilesOptions files;
  std::vector<std::string> reliability;  ///< --reliability
  bool large = false;
  bool force = false;
  mapping::TrajectoryMappingParams params;
  OutputFormat format;
};

struct MadeMap {
  std::variant<mapping::TrajectoryMap, mapping::RuleMap> map;
  std::vector<mapping::InstrumentVerdict> verdicts;  ///< of each instrument, where there are several to judge

  [[nodiscard]] const mapping::MappingCounts& counts() const;
  [[nodiscard]] std::int64_t without_pose() const;
  [[nodiscard]] grids::CellBox box() const;
};

/// What instruments say is kept apart, to judge each by the others, where the maps of all do not take more [bytes]: by
/// the ground that is seen, which they do not fill.
inline constexpr double kMostInstrumentBytes = 1e9;

/// --reliability: "judged", or NAME=SHARE of instruments: range, range/1, sonar, sonar/0 (a ring), sonar/0/3 (its
/// fourth transducer).
void add_reliability_option(CLI::App& command, std::vector<std::string>& reliability);

/// Judges the instruments where there is no reason not to; that there is no room for it is a warning.
/// \throws std::runtime_error where the ground is too large for pictures, the rule asks for poses of one frame, or
///         --reliability names an instrument that the rig has not, or is to be judged where there is nobody to judge
///         by, or no room for it
[[nodiscard]] MadeMap make_map(MapOptions& options, const std::vector<MapPart>& parts);

}  // namespace credo::apps
