// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/campaign_report.hpp"
#include "apps/campaign_worlds.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/shipped.hpp"
#include "apps/terminal.hpp"
#include "datasets/text_file.hpp"
#include "evaluation/campaign.hpp"
#include "evaluation/campaign_pictures.hpp"
#include "evaluation/campaign_summary.hpp"
#include "results/config.hpp"
#include "results/pictures.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::CampaignFolder;
using evaluation::CampaignSpec;

struct CampaignOptions {
  std::string spec;
  std::string out;
  std::string summarize;  ///< a folder; empty: run
  int seeds = 0;          ///< 0: as the specification says
  int threads = 0;        ///< 0: one for each core
  std::size_t limit = std::numeric_limits<std::size_t>::max();
  bool force = false;
  bool pictures = false;
  OutputFormat format;
};

/// FNV-1a of 64 bits: tells one file from another.
std::string checksum(const fs::path& file) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (const char c : datasets::read_binary_file(file)) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", sum);
}

/// Everything that the runs depend on beside the specification.
std::string config_of(const CampaignSpec& spec) {
  const auto params = evaluation::RunParams::of(spec.method);
  std::string text = results::to_yaml(results::RunConfig{.version = CREDO_VERSION,
                                                         .dataset = "every run of campaign.yaml",
                                                         .observer = params.observer,
                                                         .localizer = params.localizer});
  text += "made_with:  # runs of another program or of other worlds are not mixed with these\n";
  text += "  program: " + checksum("/proc/self/exe") + "\n";
  for (const std::string& world : spec.worlds)
    if (!is_drawn(world)) text += fmt::format("  {}: {}\n", world, checksum(find_shipped(world, kWorlds)));
  return text;
}

/// Of this thread, busy: other threads and programs do not count.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int threads_of(const CampaignOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

CampaignFolder run_missing(const CampaignOptions& options) {
  CampaignSpec spec = evaluation::read_campaign(find_shipped(options.spec, kCampaigns), complaint_about_world);
  if (options.seeds > 0) spec.seeds = options.seeds;
  const Interruptible interruptible;
  const CampaignFolder folder = CampaignFolder::to_run(options.out, spec, config_of(spec), options.force);
  Progress bar("campaign");
  const Stopwatch watch;
  const auto show = [&](const evaluation::CampaignProgress& p) {
    const double per_minute = 60.0 * static_cast<double>(p.missing) * p.share / std::max(watch.seconds(), 1e-3);
    bar.update(p.share, fmt::format("{} of {} runs, {:.1f} a minute", p.finished, p.missing, per_minute));
  };
  try {
    (void)evaluation::run_campaign(folder, campaign_world, {.threads = threads_of(options), .most_runs = options.limit},
                                   {.thread_seconds = thread_seconds, .progress = show, .check = Interruptible::check});
  } catch (const Interrupted&) {
    say_warning("the runs that are finished are kept: the same command goes on from there");
    throw;
  }
  return folder;
}

/// The mean over the runs of each degradation, and of all. [ms]
std::map<std::string, double> milliseconds(const CampaignFolder& folder) {
  const auto times = evaluation::times_of(folder);
  std::map<std::string, std::pair<double, int>> sums;
  for (const evaluation::RunKey& key : evaluation::runs_of(folder.spec())) {
    const auto time = times.find(evaluation::name_of(key));
    if (time == times.end()) continue;
    for (const std::string& group : {key.degradation, std::string("all")}) {
      sums[group].first += 1e3 * time->second;
      ++sums[group].second;
    }
  }
  std::map<std::string, double> means;
  for (const auto& [group, sum] : sums) means[group] = sum.first / sum.second;
  return means;
}

void draw_pictures(const CampaignFolder& folder, const std::vector<evaluation::CampaignRun>& runs) {
  const fs::path pictures = folder.path() / evaluation::kPicturesFolder;
  fs::create_directories(pictures);
  results::write_png(pictures / "errors.png", evaluation::error_picture(folder.spec(), runs));
  results::write_png(pictures / "availability.png", evaluation::availability_picture(folder.spec(), runs));
  results::write_png(pictures / "protection.png", evaluation::protection_picture(runs));
}

void execute(const CampaignOptions& options) {
  const CampaignFolder folder =
      options.summarize.empty() ? run_missing(options) : CampaignFolder::to_read(options.summarize);
  const std::vector<evaluation::CampaignRun> runs = evaluation::finished_runs(folder);
  if (runs.empty())
    throw std::runtime_error(folder.path().string() +
                             ": no run is finished: play some with credo campaign SPEC --out " +
                             folder.path().string());
  const evaluation::CampaignSummary summary = evaluation::summarise(folder.spec(), runs);
  const nlohmann::ordered_json json = to_json(summary, folder.spec().method);
  datasets::write_file_whole(folder.path() / "summary.csv", evaluation::to_csv(summary));
  datasets::write_file_whole(folder.path() / "summary.json", json.dump(2) + "\n");
  if (options.pictures) draw_pictures(folder, runs);
  if (options.format.json())
    print(json);
  else
    std::printf("%s", to_text(summary, folder.spec().method, milliseconds(folder)).c_str());
}

/// What tells how to run, beside the wish to run nothing.
void refuse_to_be_told_how_to_run(const CLI::App& command) {
  for (const char* option : {"SPEC", "--out", "--seeds", "--threads", "--limit", "--force"}) {
    if (command.count(option) == 0) continue;
    throw CLI::ValidationError(
        "campaign", std::string(option) + " says how to run, but --summarize sums up what is there and runs nothing: " +
                        "expected one of them, not both");
  }
}

void check_combination(const CampaignOptions& options, const CLI::App& command) {
  if (!options.summarize.empty()) refuse_to_be_told_how_to_run(command);
  if (options.summarize.empty() && options.spec.empty())
    throw CLI::ValidationError("campaign", "expected either SPEC with --out, or --summarize DIR");
  if (!options.spec.empty() && options.out.empty())
    throw CLI::ValidationError("campaign", "--out is missing: the folder for the runs");
}

}  // namespace

void add_campaign(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("campaign", "Plays worlds x seeds x degradations and sums up how well they were localized.");
  command->footer(
      "  credo campaign nominal --seeds 20 --out campaigns/nominal      a campaign that comes with credo\n"
      "  credo campaign my_campaign.yaml --out campaigns/mine           the same command goes on where it was stopped\n"
      "  credo campaign --summarize campaigns/mine --pictures");
  auto options = std::make_shared<CampaignOptions>();
  command->add_option("SPEC", options->spec, "a campaign file (YAML), or the name of one that comes with credo")
      ->check(a_path());
  command->add_option("-o,--out", options->out, "folder for the runs and their summary")->check(a_path());
  command->add_option("--summarize", options->summarize, "a folder with runs: sums up what is there, and runs nothing")
      ->check(a_path());
  command->add_option("--seeds", options->seeds, "how many, instead of as many as the campaign says")
      ->check(number_in(1, CampaignSpec::kMostRuns));
  command->add_option("--threads", options->threads, "runs at the same time; default: one for each core")
      ->check(number_in(1, 1024));
  command->add_option("--limit", options->limit, "runs of those that are missing; the others stay for another time")
      ->check(number_in<std::size_t>(1, CampaignSpec::kMostRuns));
  command->add_flag("-f,--force", options->force, "start anew where the folder holds another campaign");
  command->add_flag("--pictures", options->pictures, "draws errors, availability and protection levels into pictures/");
  add_format_option(*command, options->format);
  command->callback([options, command] {
    check_combination(*options, *command);
    execute(*options);
  });
}

}  // namespace credo::apps
