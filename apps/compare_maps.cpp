// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/compare.hpp"
#include "apps/idle_options.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_source.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/terminal.hpp"
#include "datasets/map_server.hpp"
#include "datasets/staged_folder.hpp"
#include "datasets/truth_states.hpp"
#include "evaluation/change_score.hpp"
#include "evaluation/map_score.hpp"
#include "mapping/map_rule.hpp"
#include "results/map_sheet.hpp"
#include "results/pictures.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct MapsOptions {
  MapSource from;
  OutputFile out;
  std::string pictures;
  std::vector<std::string> models, laser_models, rules;
  SonarChoice sonar;  ///< but for the model
  LaserChoice laser;  ///< the same
  mapping::TrajectoryMappingParams params;
  OutputFormat format;
};

constexpr const char* kPrintedLaser = "li2006_printed";

/// A model of one kind of sensor, and its readings.
struct SensorModel {
  std::string name;
  MapPart part;
  mapping::TrajectoryMappingParams params;
};

/// One line of the table.
struct MapLine {
  std::string model, rule;
  mapping::RuleMap map;
  evaluation::MapScore score;
  double milliseconds = 0.0;
  std::optional<evaluation::ChangeScore> changes;  ///< where the world changed
};

std::vector<std::string> all_models() {
  const auto names = mapping::sonar_model_names();
  return {names.begin(), names.end()};
}

std::vector<std::string> all_laser_models() {
  std::vector<std::string> names{kPrintedLaser};
  for (const std::string_view name : mapping::laser_model_names()) names.emplace_back(name);
  return names;
}

std::vector<std::string> all_rules() {
  std::vector<std::string> names;
  for (const mapping::NamedRule& rule : mapping::map_rules()) names.emplace_back(rule.name);
  return names;
}

/// Each name once, where it is first.
std::vector<std::string> once_each(std::vector<std::string> names) {
  for (auto name = names.begin(); name != names.end(); ++name)
    names.erase(std::remove(name + 1, names.end(), *name), names.end());
  return names;
}

/// Each model of the sonar with the sonar's readings alone, then those of the range finders with theirs.
std::vector<SensorModel> sensor_models(const MapPart& part, const MapsOptions& o) {
  std::vector<SensorModel> models;
  if (!part.sweeps.empty()) {
    MapPart of_sonar = part;
    of_sonar.scans.clear();
    for (const std::string& name : o.models) {
      models.push_back({name, of_sonar, o.params});
      SonarChoice sonar = o.sonar;
      sonar.model = name;
      models.back().params.mapper.sonar = sonar_params(sonar, o.params.mapper.georeference.resolution_m);
    }
  }
  if (part.scans.empty()) return models;
  MapPart of_laser = part;
  of_laser.sweeps.clear();
  for (const std::string& name : o.laser_models) {
    models.push_back({"laser " + name, of_laser, o.params});
    LaserChoice laser = o.laser;
    laser.printed = name == kPrintedLaser;
    laser.model = laser.printed ? "li2006" : name;
    models.back().params.mapper.laser = laser_params(laser);
  }
  return models;
}

MapLine map_with(const SensorModel& model, const std::string& rule, const datasets::OccupancyMap& truth,
                 std::span<const datasets::TruthState> states) {
  const MapPart& part = model.part;
  const mapping::TrajectoryMappingParams& params = model.params;
  const auto begin = std::chrono::steady_clock::now();
  mapping::RuleMap map = mapping::map_along(part.path, part.rig, part.scans, part.sweeps, params,
                                            mapping::map_rule(rule).rule, [](double) { Interruptible::check(); });
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  const evaluation::MapScore score = evaluation::map_score(map.map, truth);
  MapLine line{model.name, rule, std::move(map), score, took.count(), std::nullopt};
  if (!states.empty() && !part.scans.empty())
    line.changes = evaluation::change_score(part.path, part.rig, part.scans, states, params,
                                            mapping::map_rule(rule).rule, [](double) { Interruptible::check(); });
  return line;
}

datasets::OccupancyMap true_map(const std::string& source) {
  const fs::path file = fs::path(source) / "truth_map.yaml";
  if (!fs::exists(file))
    throw std::runtime_error(source +
                             ": has no truth_map.yaml, which maps are compared with: expected a dataset of "
                             "credo simulate, or another one with its true map");
  return datasets::read_map(file);
}

std::string text_of(const std::vector<MapLine>& lines) {
  std::string text = fmt::format("{:<20} {:<14} {:>8} {:>9} {:>9} {:>7} {:>9} {:>9} {:>10} {:>11} {:>10} {:>9}\n",
                                 "model", "rule", "decided", "of those", "accuracy", "Brier", "log loss", "conflict",
                                 "ignorance", "contour cm", "missed cm", "time ms");
  for (const MapLine& l : lines)
    text += fmt::format(
        "{:<20} {:<14} {:>7.2f}% {:>8.2f}% {:>8.2f}% {:>7.4f} {:>9.4f} {:>9.4f} {:>10.4f} {:>11.1f} "
        "{:>10.1f} {:>9.1f}\n",
        l.model, l.rule, 100.0 * l.score.decided_share(), 100.0 * l.score.accuracy_of_decided(),
        100.0 * l.score.accuracy(), l.score.brier, l.score.log_loss, l.score.conflict, l.score.ignorance,
        100.0 * l.score.contour_m, 100.0 * l.score.missed_m, l.milliseconds);
  return text;
}

/// How the maps follow a world that changed; empty where it did not.
std::string changes_text(const std::vector<MapLine>& lines) {
  std::string text;
  for (const MapLine& l : lines) {
    if (!l.changes) continue;
    if (text.empty())
      text = fmt::format("\n{:<20} {:<14} {:>14} {:>14} {:>16} {:>13}\n", "model", "rule", "after 3 sweeps",
                         "after 5 sweeps", "unchanged wrong", "said changed");
    const auto share = [](double value, int decimals) {
      return std::isnan(value) ? std::string("-") : fmt::format("{:.{}f}%", 100.0 * value, decimals);
    };
    text +=
        fmt::format("{:<20} {:<14} {:>14} {:>14} {:>16} {:>13}\n", l.model, l.rule, share(l.changes->followed_3(), 2),
                    share(l.changes->followed_5(), 2), share(l.changes->wrong_share(), 3),
                    l.rule == "changing" ? share(l.changes->said_changed_share(), 2) : "-");
  }
  if (text.empty()) return text;
  return text +
         "\nOf cells that changed between free and occupied, those that are right in the third and fifth scan that "
         "sees "
         "them since;\nof cells that never changed and were seen in five scans, those that are wrong at the end, and "
         "those that\n`changing` counts a change of (people who walk change cells, too, which no state of the world "
         "tells).\n";
}

constexpr const char* kMapTerms =
    "\nCells that were seen and whose truth is known count, but for those more than one cell inside of a solid. "
    "decided:\n"
    "m(occupied) and m(empty) differ; of those: right, a wall within one cell; accuracy: of all, undecided is wrong.\n"
    "Brier, log loss: of the pignistic probability of occupied. contour: from what is said to be occupied to the "
    "nearest\n"
    "true wall, at most 50 cm; missed: from true walls to what is said to be occupied.\n";

ordered_json json_of(const MapLine& l) {
  return {{"model", l.model},
          {"rule", l.rule},
          {"cells", l.score.cells},
          {"decided", l.score.decided_share()},
          {"accuracy_of_decided", l.score.accuracy_of_decided()},
          {"accuracy", l.score.accuracy()},
          {"brier", l.score.brier},
          {"log_loss", l.score.log_loss},
          {"conflict", l.score.conflict},
          {"ignorance", l.score.ignorance},
          {"contour_m", number_or_null(l.score.contour_m)},
          {"missed_m", number_or_null(l.score.missed_m)},
          {"abandoned", l.map.abandoned},
          {"ms", l.milliseconds},
          {"followed_after_3", number_or_null(l.changes ? std::optional(l.changes->followed_3()) : std::nullopt)},
          {"followed_after_5", number_or_null(l.changes ? std::optional(l.changes->followed_5()) : std::nullopt)},
          {"unchanged_wrong", number_or_null(l.changes ? std::optional(l.changes->wrong_share()) : std::nullopt)},
          {"unchanged_said_changed",
           number_or_null(l.changes && l.rule == "changing" ? std::optional(l.changes->said_changed_share())
                                                            : std::nullopt)}};
}

/// Empty fields where nothing changed.
std::string changes_csv(const MapLine& l) {
  const auto field = [](double value) { return std::isnan(value) ? std::string() : fmt::format("{:.6f}", value); };
  if (!l.changes) return ",,";
  return field(l.changes->followed_3()) + "," + field(l.changes->followed_5()) + "," + field(l.changes->wrong_share());
}

std::string csv_of(const std::vector<MapLine>& lines) {
  std::string csv =
      "#model,rule,cells,decided,accuracy_of_decided,accuracy,brier,log_loss,conflict,ignorance,contour [m],missed [m],"
      "abandoned,time [ms],followed after 3,followed after 5,unchanged wrong\n";
  for (const MapLine& l : lines)
    csv += fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{:.4f},{},{:.3f},{}\n",
                       l.model, l.rule, l.score.cells, l.score.decided_share(), l.score.accuracy_of_decided(),
                       l.score.accuracy(), l.score.brier, l.score.log_loss, l.score.conflict, l.score.ignorance,
                       l.score.contour_m, l.score.missed_m, l.map.abandoned, l.milliseconds, changes_csv(l));
  return csv;
}

void draw_maps(const fs::path& file, const std::vector<MapLine>& lines) {
  std::vector<results::SheetMap> maps;
  for (const MapLine& l : lines)
    maps.push_back({l.model + " " + l.rule, fmt::format("accuracy {:.2f} %", 100.0 * l.score.accuracy()), &l.map.map});
  results::write_png(file, results::map_sheet(maps));
}

void require_meaning(const MapsOptions& o, const CLI::App& command) {
  require_sensors(command, o.from,
                  {{"--models", "sonar"},
                   {"--printed", "sonar"},
                   {"--sonar-weights", "sonar"},
                   {"--laser-models", "range"},
                   {"--laser-weights", "range"}});
  if (o.sonar.printed) require_two_forms_of_sonar(o.models);
  require_learned(o.sonar.weights, "--sonar-weights", o.models, "--models");
  require_learned(o.laser.weights, "--laser-weights", o.laser_models, "--laser-models");
}

void execute(const MapsOptions& o) {
  require_writable(o.out);
  const Interruptible interruptible;
  const datasets::OccupancyMap truth = true_map(o.from.source);
  const std::vector<datasets::TruthState> states = datasets::read_truth_states(o.from.source);
  const MapParts read = read_map_parts(o.from);
  const MapPart& part = read.parts.front();
  if (part.scans.empty() && part.sweeps.empty()) fail_without_readings(o.from);
  std::optional<datasets::StagedFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, refuse_older_pictures);
  const std::vector<SensorModel> models = sensor_models(part, o);
  std::vector<MapLine> lines;
  Progress progress("mapping");
  for (const SensorModel& model : models)
    for (const std::string& rule : o.rules) {
      lines.push_back(about(o.from.source, [&] { return map_with(model, rule, truth, states); }));
      progress.update(static_cast<double>(lines.size()) / static_cast<double>(models.size() * o.rules.size()));
    }
  if (pictures) draw_maps(pictures->path() / "maps.png", lines);
  if (o.out.wanted()) results::write_text(o.out.path, csv_of(lines));
  if (pictures) pictures->commit();
  if (o.format.json()) {
    ordered_json all = ordered_json::array();
    for (const MapLine& line : lines) all.push_back(json_of(line));
    print({{"dataset", o.from.source}, {"poses", read.poses}, {"maps", all}});
    return;
  }
  std::printf("%s, mapped with %s\n%s%s%s", o.from.source.c_str(), read.poses.c_str(), text_of(lines).c_str(),
              kMapTerms, changes_text(lines).c_str());
}

}  // namespace

void add_compare_maps(CLI::App& compare) {
  CLI::App* command =
      compare.add_subcommand("maps", "Every sensor model and rule on the same readings, against the true map.");
  command->footer(
      "  credo compare maps datasets/room                                     all models and rules\n"
      "  credo compare maps datasets/office --sensors range --pictures sheet  of the laser\n"
      "  credo compare maps datasets/room --models li2007,zhu --rules dempster,pcr2 --out table.csv");
  auto o = std::make_shared<MapsOptions>();
  o->models = all_models();
  o->laser_models = all_laser_models();
  o->rules = all_rules();
  add_map_source_options(*command, o->from);
  command->add_option("--models", o->models, "of the sonar")
      ->delimiter(',')
      ->check(CLI::IsMember(all_models()))
      ->capture_default_str();
  command->add_option("--laser-models", o->laser_models, "of the range finders")
      ->delimiter(',')
      ->check(CLI::IsMember(all_laser_models()))
      ->capture_default_str();
  command->add_option("--rules", o->rules, "of the cells")
      ->delimiter(',')
      ->check(CLI::IsMember(all_rules()))
      ->capture_default_str();
  command->add_flag("--printed", o->sonar.printed, "the sonar models' formulas as printed instead of as resolved");
  add_sonar_weights_option(*command, o->sonar);
  add_laser_weights_option(*command, o->laser);
  command->add_option("--resolution", o->params.mapper.georeference.resolution_m, "side of a cell [m]")
      ->check(any_resolution())
      ->capture_default_str();
  command->add_option("-o,--out", o->out.path, "file for the table as comma-separated values")->check(a_path());
  add_force_option(*command, o->out, "a table");
  command->add_option("--pictures", o->pictures, "a new folder for maps.png, all maps side by side")->check(a_path());
  add_format_option(*command, o->format);
  command->callback([o, command] {
    require_meaning(*o, *command);
    for (std::vector<std::string>* names : {&o->models, &o->laser_models, &o->rules}) *names = once_each(*names);
    execute(*o);
  });
}

}  // namespace credo::apps
