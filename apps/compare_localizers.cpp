// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/compare.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/pipeline.hpp"
#include "apps/terminal.hpp"
#include "datasets/acquisitions.hpp"
#include "datasets/staged_folder.hpp"
#include "evaluation/baseline_ekf.hpp"
#include "evaluation/baseline_icp.hpp"
#include "evaluation/baseline_mcl.hpp"
#include "evaluation/baseline_mrpt.hpp"
#include "evaluation/baseline_table.hpp"
#include "results/pictures.hpp"
#include "results/plot.hpp"
#include "results/results_folder.hpp"
#include "sim/random.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::LocalizerLine;
using evaluation::LocalizerRecord;
using geometry::PoseEstimate;
using nlohmann::ordered_json;

struct LocalizersOptions {
  std::vector<std::string> datasets;
  OutputFile out;
  std::string pictures;  ///< empty: none
  std::uint64_t seed = 1;
  OutputFormat format;
};

/// What a localizer is given for one acquisition.
struct Reading {
  std::size_t index = 0;
  const perception::Scene& scene;
  const perception::Scene& paper_scene;
  const std::optional<PoseEstimate>& motion;
  const std::optional<geometry::Pose2>& truth;
};

/// A localizer under comparison, and what it answered.
struct Contender {
  std::string name;
  std::string note;
  std::function<localization::Localization(const Reading&)> update;
  std::vector<results::LocalizationRow> rows = {};
  double seconds = 0.0;
};

template <evaluation::Localizer L>
Contender contender(std::string name, L localizer, std::string note = "") {
  const auto shared = std::make_shared<L>(std::move(localizer));
  return {std::move(name), std::move(note),
          [shared](const Reading& reading) { return shared->update(reading.scene, reading.motion); }};
}

/// A start 2 cm and 0.5 degrees off the truth, in a direction drawn anew for each acquisition.
PoseEstimate near_truth(const geometry::Pose2& truth, std::uint64_t seed, std::size_t index) {
  constexpr double kOff_m = 0.02;
  const double off_rad = geometry::to_radians(0.5);
  sim::Random random(seed, 0, index);
  const double direction = random.uniform(0.0, geometry::kTurn);
  const double turn = random.chance(0.5) ? off_rad : -off_rad;
  PoseEstimate start{{truth.x + kOff_m * std::cos(direction), truth.y + kOff_m * std::sin(direction),
                      geometry::wrap_angle(truth.theta + turn)},
                     Eigen::Matrix3d::Zero()};
  start.covariance.diagonal() << 0.5 * kOff_m * kOff_m, 0.5 * kOff_m * kOff_m, off_rad * off_rad;
  return start;
}

Contender oracle_icp(const datasets::DatasetHeader& header, std::uint64_t seed) {
  const auto icp = std::make_shared<evaluation::IcpLocalizer>(*header.floor_plan, header.rig, *header.initial_pose);
  return {"ICP, oracle start", "(oracle: started 2 cm and 0.5 deg off the truth)", [icp, seed](const Reading& reading) {
            return reading.truth ? icp->update_from(near_truth(*reading.truth, seed, reading.index), reading.scene)
                                 : icp->update(reading.scene, reading.motion);
          }};
}

/// Without an update where MRPT is missing: the table says so.
Contender mrpt(const datasets::DatasetHeader& header, std::uint64_t seed) {
  const char* const name = "MRPT, 500 particles";
  evaluation::MrptParams params;
  params.seed = static_cast<std::uint32_t>(seed);
  auto filter = evaluation::MrptLocalizer::create(*header.floor_plan, header.rig, *header.initial_pose, params);
  if (!filter) return {name, "built without MRPT (libmrpt-slam-dev)", nullptr};
  return contender(name, std::move(*filter));
}

std::vector<Contender> baselines(const datasets::DatasetHeader& header, std::uint64_t seed) {
  using namespace evaluation;
  const geometry::FloorPlan& plan = *header.floor_plan;
  const PoseEstimate& initial = *header.initial_pose;
  const auto ekf = [&](EkfAssociation association) {
    EkfParams params;
    params.association = association;
    return EkfLocalizer(plan, header.rig, initial, params);
  };
  const auto mcl = [&](int particles) {
    MclParams params;
    params.particles = particles;
    params.seed = seed;
    return MclLocalizer(plan, header.rig, initial, params);
  };
  std::vector<Contender> all;
  all.push_back(contender("EKF, nearest neighbour", ekf(EkfAssociation::kNearestNeighbour)));
  all.push_back(contender("EKF, JCBB", ekf(EkfAssociation::kJointCompatibility)));
  all.push_back(contender("MCL, 500 particles", mcl(500)));
  all.push_back(contender("MCL, 2000 particles", mcl(2000)));
  all.push_back(mrpt(header, seed));
  all.push_back(contender("ICP, odometry start", IcpLocalizer(plan, header.rig, initial)));
  all.push_back(oracle_icp(header, seed));
  return all;
}

/// Credo's two methods, each with its own perception.
struct Credo {
  Credo(const datasets::DatasetHeader& header, perception::Method method)
      : params(PipelineParams::of(method)),
        observer(header.rig, params.observer),
        localizer(std::make_shared<localization::Localizer>(*header.floor_plan, header.rig, header.initial_pose,
                                                            params.localizer)) {}

  const perception::Scene& observe(sensors::Acquisition acquisition) {
    localizer->with_path(acquisition);
    return observer.observe(acquisition);
  }

  PipelineParams params;
  perception::Observer observer;
  std::shared_ptr<localization::Localizer> localizer;
};

/// Every localizer over the same readings. Without odometry the scenes are made along the path that Credo's velocity
/// predicts.
std::vector<Contender> compete(const datasets::Dataset& dataset, std::uint64_t seed) {
  const datasets::DatasetHeader& header = dataset.header;
  Credo credo(header, perception::Method::kDefault), paper(header, perception::Method::kPaper);
  std::vector<Contender> all = baselines(header, seed);
  all.push_back({"Credo, paper", "", [&paper](const Reading& reading) {
                   return paper.localizer->update(reading.paper_scene, reading.motion);
                 }});
  all.push_back({"Credo", "",
                 [&credo](const Reading& reading) { return credo.localizer->update(reading.scene, reading.motion); }});

  const datasets::Acquisitions acquisitions(dataset);
  Progress progress("comparing on " + header.name);
  for (std::size_t i = 0; i < acquisitions.size(); ++i) {
    Interruptible::check();
    const sensors::Acquisition acquisition = acquisitions.read(i);
    const perception::Scene& scene = credo.observe(acquisition);
    const perception::Scene& paper_scene = paper.observe(acquisition);
    const auto truth = evaluation::truth_at(dataset.truth, scene.time);
    for (Contender& c : all) {
      if (!c.update) continue;
      const Stopwatch watch;
      localization::Localization fix = c.update({i, scene, paper_scene, acquisition.motion, truth});
      c.seconds += watch.seconds();
      // Who has no integrity monitor is as sure as its covariance says.
      if (std::isnan(fix.protection.position_high_m)) fix.protection = evaluation::gaussian_protection(fix.estimate);
      c.rows.push_back({fix});
    }
    progress.update(static_cast<double>(i + 1) / static_cast<double>(acquisitions.size()));
  }
  for (Contender& c : all) c.update = nullptr;  // it refers to what ends here
  return all;
}

/// Distance to the truth over time. Baselines that fail go far: the chart ends at ten times the median of all.
cv::Mat picture(const datasets::Dataset& dataset, const std::vector<Contender>& all) {
  using namespace results;
  constexpr Color kColors[] = {colors::kMuted, colors::kPurple, colors::kYellow, colors::kOrange, colors::kGreen,
                               colors::kSky,   colors::kFaint,  colors::kRed,    colors::kBlue};
  Plot plot("Position error on " + dataset.header.name, "time [s]", "error [cm]");
  std::vector<LegendEntry> entries;
  std::vector<double> everything;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].rows.empty()) continue;
    entries.push_back({kColors[k % std::size(kColors)], all[k].name});
    std::vector<double> time, error;
    for (const LocalizationRow& row : all[k].rows) {
      const auto truth = evaluation::truth_at(dataset.truth, row.localization.time);
      if (!truth) continue;
      time.push_back(sensors::seconds_between(all[k].rows.front().localization.time, row.localization.time));
      error.push_back(100.0 * (row.localization.estimate.pose.translation() - truth->translation()).norm());
    }
    everything.insert(everything.end(), error.begin(), error.end());
    plot.line(time, error, entries.back().color, "", k + 1 == all.size() ? 2.4 : 1.4);
  }
  if (!everything.empty()) {
    std::ranges::sort(everything);
    plot.y_limits(0.0, std::max(1.0, std::min(everything.back(), 10.0 * everything[everything.size() / 2])));
  }
  constexpr int kWidth = 1100, kChart = 420, kLegend = 26;
  Canvas canvas(kWidth, kChart + kLegend);
  plot.draw(canvas, {0.0, 0.0}, {kWidth, kChart});
  legend(canvas, {60.0, kChart + 12.0}, entries);
  return canvas.finish();
}

ordered_json json_of(const LocalizerLine& line) {
  ordered_json json{{"localizer", line.name}};
  if (!line.note.empty()) json["note"] = line.note;
  if (!line.summary) return json;
  const evaluation::LocalizerSummary& s = *line.summary;
  json["acquisitions"] = s.acquisitions;
  json["mean_position_m"] = s.mean_position_m;
  json["p95_position_m"] = s.p95_position_m;
  json["mean_heading_rad"] = s.mean_heading_rad;
  json["lost"] = s.lost;
  json["available"] = s.available;
  json["misleading"] = s.misleading;
  json["mean_nees"] = s.mean_nees;
  json["lost_count"] = s.lost_count;
  json["auroc"] = s.auroc ? ordered_json(*s.auroc) : ordered_json(nullptr);
  json["ms_per_update"] = s.ms_per_update;
  return json;
}

/// One table for each dataset, and one of all together where there are several.
struct Tables {
  std::vector<std::string> titles = {};
  std::vector<std::vector<LocalizerLine>> tables = {};

  void add(const std::string& title, const std::vector<Contender>& names, const std::vector<LocalizerRecord>& records) {
    titles.push_back(title);
    std::vector<LocalizerLine>& lines = tables.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k)
      lines.push_back({names[k].name, names[k].note,
                       names[k].rows.empty() ? std::nullopt : std::optional(evaluation::summarise(records[k]))});
  }
};

void print_tables(const Tables& all, const LocalizersOptions& options) {
  if (options.format.json()) {
    ordered_json report = ordered_json::array();
    for (std::size_t t = 0; t < all.tables.size(); ++t) {
      ordered_json lines = ordered_json::array();
      for (const LocalizerLine& line : all.tables[t]) lines.push_back(json_of(line));
      report.push_back({{"dataset", all.titles[t]}, {"localizers", lines}});
    }
    print(report);
    return;
  }
  for (std::size_t t = 0; t < all.tables.size(); ++t)
    std::printf("%s: %d acquisitions\n%s\n", all.titles[t].c_str(), all.tables[t].back().summary->acquisitions,
                evaluation::to_text(all.tables[t]).c_str());
  std::printf("%s", evaluation::localizer_table_terms().c_str());
}

void execute(const LocalizersOptions& options) {
  require_writable(options.out);
  const Interruptible interruptible;
  std::optional<datasets::StagedFolder> pictures;
  if (!options.pictures.empty()) pictures.emplace(options.pictures, refuse_older_pictures);
  Tables tables;
  std::vector<LocalizerRecord> total;
  std::vector<Contender> all;
  for (const std::string& path : options.datasets) {
    const datasets::Dataset dataset = open_comparable(path);
    if (!dataset.header.initial_pose)
      throw std::runtime_error(path + ": the dataset has no initial pose, from which the localizers start");
    all = about(path, [&] { return compete(dataset, options.seed); });
    std::vector<LocalizerRecord> records;
    for (const Contender& c : all) records.push_back(evaluation::record(c.rows, dataset.truth, c.seconds));
    about(path, [&] { tables.add(dataset.header.name, all, records); });
    total.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) total[k] += records[k];
    if (pictures)
      results::write_png(pictures->path() / ("errors_" + fs::path(path).filename().string() + ".png"),
                         picture(dataset, all));
  }
  if (options.datasets.size() > 1) tables.add("all together", all, total);
  if (options.out.wanted()) {
    std::string csv = evaluation::localizer_csv_header();
    for (std::size_t t = 0; t < tables.tables.size(); ++t)
      csv += evaluation::to_csv(tables.titles[t], tables.tables[t]);
    results::write_text(options.out.path, csv);
  }
  if (pictures) pictures->commit();
  print_tables(tables, options);
}

}  // namespace

void add_compare_localizers(CLI::App& compare) {
  CLI::App* command = compare.add_subcommand(
      "localizers", "Kalman and particle filters, ICP and Credo on the same readings, noise and start.");
  command->footer(
      "  credo compare localizers datasets/office\n"
      "  credo compare localizers datasets/office datasets/hall --out table.csv --pictures pictures\n"
      "  credo compare localizers datasets/office --format json | jq '.[0].localizers[-1]'");
  auto options = std::make_shared<LocalizersOptions>();
  command->add_option("DATASET", options->datasets, "folders with a floor plan, an initial pose and a ground truth")
      ->check(a_path())
      ->required();
  command->add_option("-o,--out", options->out.path, "file for the table as comma-separated values")->check(a_path());
  add_force_option(*command, options->out, "a table");
  command->add_option("--pictures", options->pictures, "a new folder for a picture of the errors of each dataset")
      ->check(a_path());
  command->add_option("--seed", options->seed, "of the particles and of the oracle's starts")
      ->check(any_seed())
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->callback([options] { execute(*options); });
}

}  // namespace credo::apps
