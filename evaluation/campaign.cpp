// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "datasets/csv_table.hpp"
#include "datasets/text_file.hpp"
#include "sim/degradation.hpp"
#include "sim/together.hpp"

namespace credo::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpecFile = "campaign.yaml";
constexpr const char* kConfigFile = "config.yaml";
constexpr const char* kRunsFolder = "runs";
constexpr const char* kTimesHeader = "#milliseconds per acquisition,run\n";

/// \throws std::runtime_error where the folder holds a campaign that this one cannot go on with
void require_same(const fs::path& file, const std::string& expected, const char* what) {
  if (datasets::read_text_file(file) == expected) return;
  throw std::runtime_error(fmt::format(
      "{}: {}; runs of both would be mixed: choose another --out, or start anew with --force", file.string(), what));
}

bool is_campaign(const fs::path& folder) { return fs::exists(folder / kSpecFile); }

std::string what_is_there_instead(const fs::path& folder) {
  if (!fs::exists(folder)) return "there is no such folder";
  if (!fs::is_directory(folder)) return "is a file";
  return fs::is_empty(folder) ? "is empty" : fmt::format("holds no campaign ({} is missing)", kSpecFile);
}

/// And the folder of the pictures, where nothing else is in it.
void remove_summary(const fs::path& folder) {
  for (const std::string_view file : kSummaryFiles) fs::remove(folder / file);
  const fs::path pictures = folder / kPicturesFolder;
  if (fs::is_directory(pictures) && fs::is_empty(pictures)) fs::remove(pictures);
}

void remove_runs(const fs::path& folder) {
  fs::remove_all(folder / kRunsFolder);
  remove_summary(folder);
  for (const char* file : {"times.csv", kConfigFile, kSpecFile}) fs::remove(folder / file);
}

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Plays run after run and tells how far all are.
class Player {
 public:
  Player(const CampaignFolder& folder, const WorldSource& world_of, const CampaignWatch& watch, std::size_t missing)
      : folder_(&folder),
        world_of_(&world_of),
        watch_(&watch),
        params_(RunParams::of(folder.spec().method)),
        progress_{.finished = 0, .missing = missing} {}

  void play_into_file(const RunKey& key) {
    CampaignRun run{.key = key, .rows = {}, .refused = {}};
    double shown = 0.0;
    const auto simulation = simulate(key, run.refused);
    if (simulation) {
      const RunWatch run_watch{.seconds = watch_->thread_seconds, .progress = [&](double share) {
                                 if (watch_->check) watch_->check();
                                 advance(share - std::exchange(shown, share), 0);
                               }};
      Played played = play(*simulation, params_, run_watch);
      run.rows = std::move(played.rows);
      note_time(key, played.seconds_per_acquisition);
    }
    write_run(folder_->file_of(key), run);
    advance(1.0 - shown, 1);
  }
  [[nodiscard]] const CampaignProgress& progress() const { return progress_; }

 private:
  [[nodiscard]] std::optional<sim::Simulation> simulate(const RunKey& key, std::string& refused) const {
    try {
      return sim::Simulation(sim::degraded((*world_of_)(key.world, key.seed), key.degradation, key.seed), key.seed);
    } catch (const std::invalid_argument& error) {
      refused = in_one_line(error.what());
      return std::nullopt;
    }
  }

  void advance(double share_of_run, std::size_t finished) {
    const std::lock_guard lock(mutex_);
    progress_.finished += finished;
    progress_.share += share_of_run / static_cast<double>(progress_.missing);
    if (watch_->progress) watch_->progress(progress_);
  }
  void note_time(const RunKey& key, double seconds) {
    if (!watch_->thread_seconds) return;
    const std::lock_guard lock(mutex_);
    const bool is_new = !fs::exists(folder_->times_file());
    std::ofstream file(folder_->times_file(), std::ios::app);
    if (is_new) file << kTimesHeader;
    file << fmt::format("{:.4f},{}\n", 1e3 * seconds, name_of(key));
  }

  const CampaignFolder* folder_;
  const WorldSource* world_of_;
  const CampaignWatch* watch_;
  RunParams params_;
  std::mutex mutex_;
  CampaignProgress progress_;
};

}  // namespace

CampaignFolder CampaignFolder::to_run(const fs::path& folder, const CampaignSpec& spec, const std::string& config,
                                      bool anew) {
  if (fs::exists(folder) && !(fs::is_directory(folder) && (is_campaign(folder) || fs::is_empty(folder))))
    throw std::runtime_error(folder.string() + ": is there and holds no campaign; choose another --out");
  if (is_campaign(folder) && anew) remove_runs(folder);
  if (is_campaign(folder)) {
    require_same(folder / kSpecFile, to_yaml(spec), "the campaign there has another specification");
    require_same(folder / kConfigFile, config,
                 "the campaign there was made with another program, other parameters or other world files");
  } else {
    fs::create_directories(folder);
    datasets::write_file_whole(folder / kConfigFile, config);
    datasets::write_file_whole(folder / kSpecFile, to_yaml(spec));
  }
  fs::create_directories(folder / kRunsFolder);
  return {folder, spec};
}

CampaignFolder CampaignFolder::to_read(const fs::path& folder) {
  if (is_campaign(folder)) return {folder, read_campaign(folder / kSpecFile)};
  throw std::runtime_error(
      fmt::format("{}: {}; expected the folder of a campaign: make one with credo campaign SPEC --out {}",
                  folder.string(), what_is_there_instead(folder), folder.string()));
}

fs::path CampaignFolder::file_of(const RunKey& key) const { return path_ / kRunsFolder / (name_of(key) + ".csv"); }

CampaignProgress run_campaign(const CampaignFolder& folder, const WorldSource& world_of, const CampaignParams& params,
                              const CampaignWatch& watch) {
  std::vector<RunKey> missing;
  for (RunKey& key : runs_of(folder.spec()))
    if (missing.size() < params.most_runs && !folder.has(key)) missing.push_back(std::move(key));
  if (!missing.empty()) remove_summary(folder.path());
  Player player(folder, world_of, watch, missing.size());
  sim::run_together(params.threads, missing.size(), [&](sim::NextIndex& next) {
    while (const auto i = next()) player.play_into_file(missing[*i]);
  });
  return player.progress();
}

std::vector<CampaignRun> finished_runs(const CampaignFolder& folder) {
  std::vector<CampaignRun> runs;
  for (const RunKey& key : runs_of(folder.spec()))
    if (folder.has(key)) runs.push_back(read_run(folder.file_of(key), key));
  return runs;
}

std::map<std::string, double> times_of(const CampaignFolder& folder) {
  std::map<std::string, double> times;
  if (!fs::exists(folder.times_file())) return times;
  datasets::CsvTable table(folder.times_file(), {"milliseconds per acquisition", "run"});
  while (table.next_row()) {
    const double milliseconds = table.finite(0.0, 1e9);
    times[std::string(table.text())] = 1e-3 * milliseconds;
  }
  return times;
}

}  // namespace credo::evaluation
