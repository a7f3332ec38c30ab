// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/idle_options.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_extent.hpp"
#include "apps/map_making.hpp"
#include "apps/map_saturation.hpp"
#include "apps/option_checks.hpp"
#include "apps/picture_folder.hpp"
#include "apps/terminal.hpp"
#include "datasets/map_server.hpp"
#include "datasets/trajectory.hpp"
#include "mapping/map_rule.hpp"
#include "mapping/mapper.hpp"
#include "results/belief_tiff.hpp"
#include "results/cell_history.hpp"
#include "results/config.hpp"
#include "results/map_folder.hpp"
#include "results/map_sheet.hpp"
#include "results/mass_map_files.hpp"
#include "results/pictures.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

/// Time from the first to the last of some rows, for a message.
struct TimeSpan {
  sensors::Timestamp first = std::numeric_limits<sensors::Timestamp>::max();
  sensors::Timestamp last = std::numeric_limits<sensors::Timestamp>::min();

  template <typename Row>
  void cover(const std::vector<Row>& rows) {
    if (rows.empty()) return;
    first = std::min(first, rows.front().time);
    last = std::max(last, rows.back().time);
  }
  [[nodiscard]] std::string text() const {
    return datasets::to_seconds(first) + " to " + datasets::to_seconds(last) + " s";
  }
};

/// Readings that cannot be placed are left out, and that is said; poses that place none of them are a mistake.
/// \param without_pose  how many were left out
void check_overlap(const MapOptions& o, const std::vector<MapPart>& parts, const mapping::MappingCounts& counts,
                   std::int64_t without_pose, const std::string& poses) {
  const std::int64_t placed = counts.scans + counts.sweeps, all = placed + without_pose;
  if (all == 0) fail_without_readings(o.from);
  TimeSpan readings, path;
  for (const MapPart& part : parts) {
    readings.cover(part.scans);
    readings.cover(part.sweeps);
    path.cover(part.path.rows());
  }
  const std::string message = std::to_string(without_pose) + " of " + std::to_string(all) +
                              " readings have no pose near in time: the readings are from " + readings.text() + ", " +
                              poses + " from " + path.text();
  if (placed == 0) throw std::runtime_error(o.from.source + ": " + message + "; are they of the same drive?");
  if (10 * without_pose > all) say_warning(message);
}

/// A map that nothing was seen for is no success to be silent about.
void warn_of_empty(const mapping::MappingCounts& counts) {
  if (counts.echoes + counts.no_returns > 0) return;
  say_warning("no range could be mapped: " + std::to_string(counts.missing) + " are nan, " +
              std::to_string(counts.out_of_range) + " out of the sensor's range, " + std::to_string(counts.refused) +
              " readings have a pose that is not to be trusted; the map is empty");
}

/// Whether the map is small enough for pictures, and was drawn.
bool write_map_files(const MapOptions& o, const mapping::TrajectoryMap& made, std::span<const geometry::Pose2> way,
                     const fs::path& folder, const std::optional<PictureFolder>& pictures) {
  const bool drawn = results::write_map_folder(made.grid, folder, o.files.params());
  if (!drawn) warn_without_pictures(made.grid);
  if (pictures && drawn) results::write_map_pictures(pictures->path(), made.grid, way);
  return drawn;
}

/// Of the sensors that were mapped with: "li2007, laser li2006".
std::string models_text(const MapOptions& o, const mapping::MappingCounts& counts) {
  std::string text;
  if (counts.sweeps > 0) text = mapping::name_of(o.params.mapper.sonar);
  if (counts.scans > 0)
    text += (text.empty() ? "laser " : ", laser ") + std::string(mapping::name_of(o.params.mapper.laser));
  return text;
}

bool write_map_files(const MapOptions& o, const mapping::RuleMap& made, std::span<const geometry::Pose2>,
                     const fs::path& folder, const std::optional<PictureFolder>& pictures) {
  const bool trinary = o.files.mode() == datasets::MapMode::kTrinary;
  datasets::write_map(trinary ? results::to_occupancy(made.map) : results::to_probabilities(made.map),
                      folder / "map.yaml", o.files.mode());
  results::write_belief_tiff(results::belief_image(made.map), folder / "map_belief.tiff");
  if (!made.history.empty()) results::write_cell_history(made.history, made.map.georeference, folder / "history.csv");
  if (!pictures) return true;
  const std::string title = models_text(o, made.counts) + " " + o.rule;
  results::write_png(pictures->path() / "map.png",
                     results::map_sheet(std::array{results::SheetMap{title, "", &made.map}}));
  results::write_cell_history_pictures(made.history, made.map.box, pictures->path());
  return true;
}

void write(const MapOptions& o, const MadeMap& made, const std::vector<MapPart>& parts, const std::string& poses,
           const fs::path& folder, const std::optional<PictureFolder>& pictures) {
  std::vector<geometry::Pose2> way;
  for (const auto& row : parts.front().path.rows()) way.push_back(row.T_odom_base);
  const bool drawn =
      std::visit([&](const auto& map) { return write_map_files(o, map, way, folder, pictures); }, made.map);
  std::string config = results::to_yaml(o.params, CREDO_VERSION, o.from.source, poses);
  if (!o.rule.empty()) config += "rule: " + o.rule + "\n";
  results::write_text(folder / "config.yaml", config);
  if (pictures && drawn) pictures->publish();
}

nlohmann::ordered_json json_of(const std::vector<mapping::InstrumentVerdict>& verdicts) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const mapping::InstrumentVerdict& v : verdicts)
    all.push_back({{"instrument", v.instrument.name()},
                   {"readings", v.readings},
                   {"shared_cells", v.cells},
                   {"opposed", v.opposed},
                   {"judged_sweeps", v.judged},
                   {"reliability", v.reliability}});
  return all;
}

/// How many cells changed; empty where the rule does not know.
std::string changes_text(const MadeMap& made) {
  const auto* by_rule = std::get_if<mapping::RuleMap>(&made.map);
  if (by_rule == nullptr || by_rule->history.empty()) return {};
  const auto changed =
      std::ranges::count_if(by_rule->history, [](const mapping::CellHistory& row) { return row.changes > 0; });
  return "changed: " + std::to_string(changed) + " of " + std::to_string(by_rule->history.size()) +
         " settled cells; credo cell says since when";
}

/// What would have no effect is refused, so that nobody takes it for granted.
void require_meaning(const MapOptions& o, const CLI::App& command) {
  require_sensors(
      command, o.from,
      {{"--model", "sonar"}, {"--sonar-weights", "sonar"}, {"--laser-model", "range"}, {"--laser-weights", "range"}});
  const auto mapped = [&](const char* sensor) { return std::ranges::count(o.from.sensors, sensor) > 0; };
  if (o.printed && mapped("sonar")) require_two_forms_of_sonar({o.sonar.model});
  if (o.printed && mapped("range")) require_two_forms_of_laser({o.laser.model});
  require_learned(o.sonar.weights, "--sonar-weights", std::array{o.sonar.model}, "--model");
  require_learned(o.laser.weights, "--laser-weights", std::array{o.laser.model}, "--laser-model");
  if (o.rule.empty()) return;
  if (o.files.raw())
    throw std::runtime_error(
        "--readout raw is of the map without --rule; by a rule the masses are written as they are");
  if (o.large)
    throw std::runtime_error("--large is of the map without --rule; by a rule all cells are read out at once");
}

void execute(MapOptions o) {
  const auto [parts, poses] = read_map_parts(o.from);
  if (o.out.empty())
    o.out = (fs::path("results") / (fs::path(o.from.source).lexically_normal().stem().string() + "_map")).string();
  o.sonar.printed = o.laser.printed = o.printed;
  o.params.mapper.sonar = sonar_params(o.sonar, o.params.mapper.georeference.resolution_m);
  o.params.mapper.laser = laser_params(o.laser);
  const Interruptible interruptible;
  datasets::StagedFolder folder = results::stage_results(o.out, o.force);
  std::optional<PictureFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, o.out, folder.path(), o.force);
  const MadeMap made = about(o.from.source, [&] { return make_map(o, parts); });
  const mapping::MappingCounts& counts = made.counts();
  const std::int64_t without_pose = made.without_pose();
  check_overlap(o, parts, counts, without_pose, poses);
  warn_of_empty(counts);
  if (const auto* sum = std::get_if<mapping::TrajectoryMap>(&made.map)) warn_of_saturation(sum->grid);
  about(o.from.source, [&] { write(o, made, parts, poses, folder.path(), pictures); });
  Interruptible::check();
  folder.commit();
  const grids::CellBox box = made.box();
  if (o.format.json()) {
    print(nlohmann::ordered_json{{"map", o.out},
                                 {"poses", poses},
                                 {"scans", counts.scans},
                                 {"sonar_sweeps", counts.sweeps},
                                 {"echoes", counts.echoes},
                                 {"no_returns", counts.no_returns},
                                 {"without_pose", without_pose},
                                 {"width", box.width},
                                 {"height", box.height},
                                 {"resolution_m", o.params.mapper.georeference.resolution_m},
                                 {"instruments", json_of(made.verdicts)}});
    return;
  }
  std::printf("mapped %lld scans and %lld sonar sweeps with %s; %lld readings had no pose near in time\n",
              static_cast<long long>(counts.scans), static_cast<long long>(counts.sweeps), poses.c_str(),
              static_cast<long long>(without_pose));
  std::printf("map: %s (%d x %d cells of %g m)\n", o.out.c_str(), box.width, box.height,
              o.params.mapper.georeference.resolution_m);
  if (const std::string changed = changes_text(made); !changed.empty()) std::printf("%s\n", changed.c_str());
  if (!made.verdicts.empty()) std::printf("instruments: %s\n", mapping::summary(made.verdicts).c_str());
  if (!o.pictures.empty()) std::printf("pictures: %s\n", o.pictures.c_str());
}

/// The sensor models and the rule.
void add_method_options(CLI::App& command, MapOptions& o) {
  const auto names = [](std::span<const std::string_view> models) {
    return std::vector<std::string>(models.begin(), models.end());
  };
  command.add_option("--model", o.sonar.model, "of the sonar")
      ->check(CLI::IsMember(names(mapping::sonar_model_names())))
      ->capture_default_str();
  command.add_option("--laser-model", o.laser.model, "of the range finders")
      ->check(CLI::IsMember(names(mapping::laser_model_names())))
      ->capture_default_str();
  command.add_flag("--printed", o.printed, "the models' formulas as printed instead of as resolved");
  add_laser_weights_option(command, o.laser);
  add_sonar_weights_option(command, o.sonar);
  add_reliability_option(command, o.reliability);
  std::vector<std::string> rules;
  for (const mapping::NamedRule& rule : mapping::map_rules()) rules.emplace_back(rule.name);
  command
      .add_option("--rule", o.rule,
                  "how cells take readings in; default: a map that no order changes, Dempster's masses written")
      ->check(CLI::IsMember(rules));
}

}  // namespace

void add_map(CLI::App& app) {
  CLI::App* command = app.add_subcommand("map", "Maps a drive whose poses are known.");
  command->footer(
      "  credo map datasets/office --out results/office_map                        with the ground truth\n"
      "  credo map datasets/office --poses results/office/trajectory.tum --out results/office_map\n"
      "  credo map intel.log.gz --out results/intel --resolution 0.1 --pictures results/intel_pictures\n"
      "  credo map intel.log.gz --poses ego --out results/intel_ego                when all drifts\n"
      "  credo map intel.log.gz --poses ego --lines hough --out results/intel_hough\n"
      "  credo map datasets/room --sensors sonar --model calibrated                another sonar model\n"
      "  credo map datasets/office --sensors range --laser-model calibrated        another laser model\n"
      "  credo map datasets/office --reliability range=0.9,sonar=0.5,sonar/0/3=0   the fourth sonar is broken\n"
      "  credo map datasets/room --sensors sonar --model zhu --rule adaptive       and another rule");
  auto o = std::make_shared<MapOptions>();
  add_map_source_options(*command, o->from);
  add_method_options(*command, *o);
  command->add_option("-o,--out", o->out, "folder for the map; default results/NAME_map")->check(a_path());
  command->add_option("--resolution", o->params.mapper.georeference.resolution_m, "side of a cell [m]")
      ->check(any_resolution())
      ->capture_default_str();
  add_map_files_options(*command, o->files);
  command->add_flag("--large", o->large, "allow a map that is too large for pictures: map.cgrid alone is written then");
  command->add_option("--pictures", o->pictures, "folder for pictures: the map, its layers and its relief")
      ->check(a_path());
  command->add_flag("-f,--force", o->force, "replace a map that is already there");
  add_format_option(*command, o->format);
  command->callback([o, command] {
    require_meaning(*o, *command);
    execute(*o);
  });
}

}  // namespace credo::apps
