// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "perception/observer.hpp"

namespace credo::evaluation {

/// One run of a campaign: a world played once and localized in.
struct RunKey {
  std::string world;  ///< as the specification names it
  std::uint64_t seed = 0;
  std::string degradation;  ///< sim/degradation.hpp

  friend bool operator==(const RunKey&, const RunKey&) = default;
};

/// What a campaign runs: every world with every seed in every degradation.
struct CampaignSpec {
  static constexpr int kMostRuns = 1'000'000;

  std::vector<std::string> worlds;  ///< files, names of worlds that come with credo, random, or random:KIND
  std::uint64_t first_seed = 1001;  ///< seeds follow each other; a `random` world is drawn from the seed of its run
  int seeds = 20;
  std::vector<std::string> degradations{"nominal"};
  perception::Method method = perception::Method::kDefault;

  friend bool operator==(const CampaignSpec&, const CampaignSpec&) = default;
};

/// What is wrong with the name of a world, for a person; empty where nothing is.
using WorldComplaint = std::function<std::string(const std::string& world)>;

/// Reads a campaign file (docs/campaigns.md).
/// \param complaint_about  tells worlds from other names; empty: any name is taken
/// \throws datasets::FormatError  with file and line: an unknown key or degradation, with the nearest known one; a
///   number out of its bounds; a world that is complained about; a world or degradation that is listed twice; no world;
///   more than kMostRuns runs
[[nodiscard]] CampaignSpec read_campaign(const std::filesystem::path& file, const WorldComplaint& complaint_about = {});

/// The same as a text that read_campaign takes.
[[nodiscard]] std::string to_yaml(const CampaignSpec& spec);

/// All runs, ordered so that a campaign that is cut short has a bit of everything: by seed, world, degradation.
[[nodiscard]] std::vector<RunKey> runs_of(const CampaignSpec& spec);

/// "office-1001-people": the name of a run, and of its files. Of a world's file it is the name without the folder; what
/// no file name takes becomes '_'.
[[nodiscard]] std::string name_of(const RunKey& key);

}  // namespace credo::evaluation
