// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/campaign_run.hpp"
#include "evaluation/campaign_statistics.hpp"
#include "evaluation/samples.hpp"

namespace credo::evaluation {

struct SummaryParams {
  ScoreParams words;  ///< what lost, confidently wrong, available ... mean
  int alert_within = 3;
  int recovered_within = 10;     ///< acquisitions, that of the kidnapping included
  double resolved_within_m = 5;  ///< of travel
  std::size_t worst_runs = 10;
  BootstrapParams bootstrap;
};

/// One number of a group of runs.
struct Measure {
  std::string name;                       ///< as in summary.csv: mean_position
  std::string unit;                       ///< of the estimate: m, deg, or empty
  std::string meaning;                    ///< in one line
  std::optional<Estimate> estimate = {};  ///< nothing where there was nothing to measure
  long cases = 0;                         ///< what the estimate is over: acquisitions, events, runs, indices
};

/// Runs taken together: those of one degradation, or all.
struct GroupSummary {
  std::string name;
  int runs = 0;
  int refused = 0;  ///< whose world could not be made
  long acquisitions = 0;
  long misleading = 0;  ///< acquisitions
  /// Matches of localized poses: what the fault priors of the integrity monitor are measured by.
  /// Elsewhere something else than the monitor speaks against the pose.
  ClassedMatchCounts matches;
  std::vector<Measure> measures;

  /// By its name. Precondition: there is one.
  [[nodiscard]] const Measure& measure(std::string_view name) const;
};

/// A run that deserves a look.
struct RunRemark {
  RunKey key;
  long misleading = 0;  ///< acquisitions
  long confidently_wrong = 0;
  long lost = 0;
  double max_position_m = 0.0;
  double max_heading_rad = 0.0;
};

struct CampaignSummary {
  std::size_t runs_wanted = 0;
  std::vector<GroupSummary> groups;  ///< by degradation, in the order of the specification, then "all"
  std::vector<RunRemark> worst;      ///< the worst first: by misleading, confidently wrong, lost, largest error
  std::vector<CampaignRun> refused;
};

/// The numbers of finished runs. Intervals hold at 95 %: over events and runs by Clopper and Pearson, over acquisitions
/// by resampling whole drives (a world with a seed; in all degradations at once, as they share calibration and plan).
/// \param spec  that the runs are of
[[nodiscard]] CampaignSummary summarise(const CampaignSpec& spec, std::span<const CampaignRun> runs,
                                        const SummaryParams& params = {});

/// summary.csv: a row for each group, three columns for each measure: its value and the ends of its interval; then five
/// for each class of matches: how many, wrong ones, their share and the ends of its interval (Clopper and Pearson).
[[nodiscard]] std::string to_csv(const CampaignSummary& summary);

}  // namespace credo::evaluation
