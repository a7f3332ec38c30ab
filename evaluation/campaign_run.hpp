// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/campaign_spec.hpp"
#include "evaluation/match_check.hpp"
#include "evaluation/samples.hpp"
#include "localization/localizer.hpp"
#include "perception/observer.hpp"
#include "sim/simulation.hpp"

namespace credo::evaluation {

// What befell the robot, beside the events of the simulation.
inline constexpr std::string_view kToldNothing = "told_nothing";  ///< where it starts
inline constexpr std::string_view kToldWrong = "told_wrong";      ///< a start that is off by more than "lost" allows
inline constexpr std::string_view kKidnapped = "kidnapped";

/// One acquisition of a run, with what is truly so.
struct CampaignRow {
  Sample sample;               ///< its localization is without hypotheses
  double travelled_m = 0.0;    ///< driven since the start; being carried does not count
  ClassedMatchCounts matches;  ///< that the pose rests on
  std::vector<std::string> events = {};
  /// Whether the range finder can tell this place from every other: where the robot has to find out where it is.
  std::optional<bool> decidable = std::nullopt;

  [[nodiscard]] bool has_event(std::string_view name) const;
};

/// What came of one run.
struct CampaignRun {
  RunKey key;
  std::vector<CampaignRow> rows;
  std::string refused;  ///< why the world could not be made; then there are no rows
};

struct RunParams {
  perception::ObserverParams observer;
  localization::LocalizerParams localizer;

  /// The parameters of a method, each part told.
  [[nodiscard]] static RunParams of(perception::Method method);
};

/// Who watches a run. An empty function is not called.
struct RunWatch {
  std::function<double()> seconds = {};             ///< a clock, for the time per acquisition
  std::function<void(double share)> progress = {};  ///< what it throws ends the run
};

/// What a run leaves.
struct Played {
  std::vector<CampaignRow> rows;
  double seconds_per_acquisition = 0.0;  ///< from the image in memory to the localization; 0 without a clock
};

/// Plays a drive in memory and localizes in it, on this thread. The rows are a function of the simulation and the
/// parameters alone.
[[nodiscard]] Played play(const sim::Simulation& simulation, const RunParams& params, const RunWatch& watch = {});

/// A run as a file: a localization.csv with more columns (docs/campaigns.md), written whole or not at all.
void write_run(const std::filesystem::path& file, const CampaignRun& run);
/// \throws datasets::FormatError with file and line
[[nodiscard]] CampaignRun read_run(const std::filesystem::path& file, const RunKey& key);

}  // namespace credo::evaluation
