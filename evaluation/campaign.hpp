// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/campaign_run.hpp"
#include "evaluation/campaign_spec.hpp"
#include "sim/world.hpp"

namespace credo::evaluation {

inline constexpr std::string_view kPicturesFolder = "pictures";
/// What sums up the runs of a folder, in it.
inline constexpr std::string_view kSummaryFiles[] = {"summary.csv", "summary.json", "pictures/errors.png",
                                                     "pictures/availability.png", "pictures/protection.png"};

/// Makes the world that a specification names. Called from several threads at once.
/// \throws std::invalid_argument for one that cannot be
using WorldSource = std::function<sim::World(const std::string& world, std::uint64_t seed)>;

/// The folder of a campaign: what it was to be (campaign.yaml), what it is made with (config.yaml), a file for each
/// finished run (runs/), and how long each took (times.csv), which nothing else depends on.
class CampaignFolder {
 public:
  /// A folder to run in: made if it is not there.
  /// \param config  what the runs depend on beside the specification: the program, its parameters, the world files
  /// \param anew    what earlier runs left, their summary included, is taken away first
  /// \throws std::runtime_error  that says what to do: for a folder with something else in it, or with a campaign of
  ///   another specification or made with something else
  static CampaignFolder to_run(const std::filesystem::path& folder, const CampaignSpec& spec, const std::string& config,
                               bool anew);
  /// A folder with a campaign.
  /// \throws std::runtime_error  that says what to do, where there is none; as read_campaign for its specification
  static CampaignFolder to_read(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const CampaignSpec& spec() const { return spec_; }
  [[nodiscard]] std::filesystem::path file_of(const RunKey& key) const;
  [[nodiscard]] bool has(const RunKey& key) const { return std::filesystem::exists(file_of(key)); }
  [[nodiscard]] std::filesystem::path times_file() const { return path_ / "times.csv"; }

 private:
  CampaignFolder(std::filesystem::path folder, CampaignSpec spec) : path_(std::move(folder)), spec_(std::move(spec)) {}

  std::filesystem::path path_;
  CampaignSpec spec_;
};

struct CampaignParams {
  int threads = 1;                                                  ///< each plays runs of its own
  std::size_t most_runs = std::numeric_limits<std::size_t>::max();  ///< of those that are missing
};

/// How far a campaign has come.
struct CampaignProgress {
  std::size_t finished = 0;  ///< of the missing runs
  std::size_t missing = 0;   ///< when it started; at most CampaignParams::most_runs
  double share = 0.0;        ///< of the work, runs under way included
};

/// Who watches a campaign. Empty functions are not called.
struct CampaignWatch {
  std::function<double()> thread_seconds = {};                 ///< a clock of the calling thread
  std::function<void(const CampaignProgress&)> progress = {};  ///< called by one thread at a time
  std::function<void()> check = {};  ///< called by all threads; what it throws ends the campaign
};

/// Plays the runs that the folder lacks. The files of the runs are the same whatever the number of threads, and whether
/// or not the campaign was interrupted; a run that has not finished leaves none. A world that cannot be made is a
/// refused run, and no end. Where a run is missing, the summary of fewer runs is taken away first.
/// \returns what was finished and what was missing
CampaignProgress run_campaign(const CampaignFolder& folder, const WorldSource& world_of, const CampaignParams& params,
                              const CampaignWatch& watch = {});

/// The finished runs of a folder, in the order of runs_of.
[[nodiscard]] std::vector<CampaignRun> finished_runs(const CampaignFolder& folder);

/// Time per acquisition of the finished runs, by their names. [s]
[[nodiscard]] std::map<std::string, double> times_of(const CampaignFolder& folder);

}  // namespace credo::evaluation
