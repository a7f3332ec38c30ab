// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/commands.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/terminal.hpp"
#include "datasets/acquisitions.hpp"
#include "datasets/carmen.hpp"
#include "datasets/grid_file.hpp"
#include "datasets/map_server.hpp"
#include "datasets/truth_states.hpp"
#include "evaluation/trajectory.hpp"
#include "results/localization_table.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

template <typename Row>
ordered_json rows(const std::string& name, const std::vector<Row>& readings) {
  const double duration =
      readings.empty() ? 0.0 : sensors::seconds_between(readings.front().time, readings.back().time);
  const double n = static_cast<double>(readings.size());
  return {{"name", name},
          {"rows", readings.size()},
          {"duration_s", duration},
          {"rate_hz", duration > 0.0 ? (n - 1.0) / duration : 0.0}};
}

ordered_json dataset_info(const fs::path& folder) {
  const datasets::Dataset d = datasets::Dataset::open(folder);
  ordered_json all = ordered_json::array();
  if (!d.images.empty()) all.push_back(rows("camera0", d.images));
  for (std::size_t i = 0; i < d.scans.size(); ++i) {
    all.push_back(rows(d.range_finder_names[i], d.scans[i]));
    all.back()["beams"] = d.header.rig.range_finders[i].count;
  }
  for (std::size_t i = 0; i < d.sonar.size(); ++i) {
    all.push_back(rows(d.sonar_ring_names[i], d.sonar[i]));
    all.back()["transducers"] = d.header.rig.sonar_rings[i].T_base_transducer.size();
  }
  if (!d.odometry.empty()) all.push_back(rows("odometry0", d.odometry));
  if (!d.truth.empty()) all.push_back(rows("groundtruth0", d.truth));
  if (d.truth_map) (void)datasets::read_map(*d.truth_map);  // throws where it cannot be used
  (void)datasets::read_truth_states(d.folder);
  ordered_json faults = ordered_json::array();
  for (const datasets::SensorLog& log : d.log) {
    if (log.below_range_min + log.above_range_max + log.negative + log.rows_without_value == 0) continue;
    faults.push_back({{"name", log.sensor},
                      {"below_range_min", log.below_range_min},
                      {"above_range_max", log.above_range_max},
                      {"negative", log.negative},
                      {"rows_without_value", log.rows_without_value}});
  }
  return {{"kind", "dataset"},
          {"name", d.header.name},
          {"description", d.header.description},
          {"license", d.header.license},
          {"acquisitions", datasets::Acquisitions(d).size()},
          {"acquisition_sensor", d.header.acquisition_sensor},
          {"sensors", all},
          {"walls", d.header.floor_plan ? d.header.floor_plan->walls.size() : 0},
          {"initial_pose", d.header.initial_pose.has_value()},
          {"truth_map", d.truth_map.has_value()},
          {"events", d.events.size()},
          {"taken_as_missing", faults},
          {"remarks", d.remarks}};
}

ordered_json carmen_info(const fs::path& file) {
  const datasets::CarmenLog log = datasets::read_carmen(file);
  ordered_json all = ordered_json::array();
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    all.push_back(rows(log.laser_names[i], log.scans[i]));
    all.back()["beams"] = log.rig.range_finders[i].count;
    all.back()["poses"] = log.laser_poses[i].size();
  }
  for (std::size_t i = 0; i < log.sonar.size(); ++i) all.push_back(rows("SONAR", log.sonar[i]));
  all.push_back(rows("odometry", log.odometry));
  return {{"kind", "CARMEN log"},
          {"name", file.filename().string()},
          {"times_usable", log.times_usable},
          {"sensors", all},
          {"remarks", log.remarks}};
}

ordered_json results_info(const fs::path& folder) {
  const auto table = results::read_localization(folder / "localization.csv");
  ordered_json statuses = ordered_json::object();
  for (const results::LocalizationRow& row : table) {
    const char* status = localization::to_string(row.localization.status);
    statuses[status] = statuses.value(status, 0) + 1;
  }
  return {{"kind", "results"},
          {"name", folder.lexically_normal().filename().string()},
          {"acquisitions", table.size()},
          {"status", statuses},
          {"map", fs::exists(folder / "map.yaml")}};
}

ordered_json map_info(const fs::path& yaml) {
  const datasets::OccupancyMap map = datasets::read_map(yaml);
  double occupied = 0.0, unknown = 0.0;
  for (const std::int8_t cell : map.cells) {
    occupied += cell > 65 ? 1.0 : 0.0;
    unknown += cell < 0 ? 1.0 : 0.0;
  }
  const double n = static_cast<double>(map.cells.size());
  return {{"kind", "map"},
          {"name", yaml.filename().string()},
          {"width", map.width},
          {"height", map.height},
          {"resolution_m", map.resolution_m},
          {"occupied_share", occupied / n},
          {"unknown_share", unknown / n}};
}

/// Reads all of it, so that every checksum is checked.
ordered_json grid_info(const fs::path& file) {
  const datasets::GridFile whole(file);
  const grids::EvidentialGrid grid = whole.read();
  std::int64_t seen = 0;
  for (const auto& [index, tile] : grid.tiles())
    for (std::size_t i = 0; i < tile.unknown.size(); ++i)
      seen += (tile.empty[i] | tile.occupied[i] | tile.unknown[i]) != 0 ? 1 : 0;
  const grids::CellBox box = whole.box();
  const auto on_disk = static_cast<double>(fs::file_size(file));
  const double in_memory = static_cast<double>(grid.tiles().size() * sizeof(grids::Tile));
  ordered_json out{{"kind", "evidential map"},
                   {"name", file.filename().string()},
                   {"resolution_m", whole.georeference().resolution_m},
                   {"width", box.width},
                   {"height", box.height},
                   {"tiles", whole.tile_count()},
                   {"seen_cells", seen},
                   {"saturated_tiles", grid.saturated_tiles().size()}};
  if (seen > 0) {
    out["bytes_per_seen_cell"] = {{"file", on_disk / static_cast<double>(seen)},
                                  {"memory", in_memory / static_cast<double>(seen)}};
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * whole.georeference().resolution_m);
    const Eigen::Vector2d low = whole.georeference().centre(box.min) - half;
    out["from_m"] = {{"x", low.x()}, {"y", low.y()}};
  }
  return out;
}

ordered_json trajectory_info(const fs::path& file) {
  const evaluation::Trajectory trajectory = evaluation::read_trajectory(file);
  const evaluation::TrajectoryFacts f = evaluation::facts(trajectory);
  return {{"kind", "trajectory"},   {"name", file.filename().string()}, {"poses", f.poses},
          {"length_m", f.length_m}, {"duration_s", f.duration_s},       {"timed", trajectory.timed}};
}

ordered_json info(const fs::path& path) {
  if (!fs::exists(path)) throw std::runtime_error(path.string() + ": there is no such file or folder");
  if (fs::is_directory(path)) {
    if (datasets::Dataset::is_dataset(path)) return dataset_info(path);
    if (fs::exists(path / "localization.csv")) return results_info(path);
    if (fs::exists(path / "map.cgrid")) return grid_info(path / "map.cgrid");
    if (fs::exists(path / "map.yaml")) return map_info(path / "map.yaml");
    throw std::runtime_error(path.string() +
                             ": neither a dataset (dataset.yaml) nor results (localization.csv, map.cgrid, map.yaml)");
  }
  if (path.extension() == ".yaml") return map_info(path);
  if (path.extension() == ".cgrid") return grid_info(path);
  if (datasets::is_carmen(path)) return carmen_info(path);
  return trajectory_info(path);
}

std::string one_line(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_object()) return value.dump();
  std::string text;
  for (const auto& [key, part] : value.items()) {
    if (key == "name")
      text.insert(0, one_line(part));
    else
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, one_line(part));
  }
  return text;
}

void print_text(const ordered_json& all) {
  for (const auto& [key, value] : all.items()) {
    if (!value.is_array()) {
      std::printf("%s: %s\n", key.c_str(), one_line(value).c_str());
      continue;
    }
    if (value.empty()) continue;
    std::printf("%s:\n", key.c_str());
    for (const ordered_json& entry : value) std::printf("  %s\n", one_line(entry).c_str());
  }
}

}  // namespace

void add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "What is in a dataset, a log, a result, a map or a trajectory.");
  command->footer(
      "  credo info datasets/office\n"
      "  credo info intel.log.gz --format json\n"
      "  credo info results/office_map/map.cgrid      tiles, seen cells, bytes for each; checks it all");
  struct Options {
    std::string path;
    OutputFormat format;
  };
  auto o = std::make_shared<Options>();
  command->add_option("PATH", o->path, "a folder or a file")->check(a_path())->required();
  add_format_option(*command, o->format);
  command->callback([o] {
    const ordered_json all = info(o->path);
    if (o->format.json())
      print(all);
    else
      print_text(all);
  });
}

}  // namespace credo::apps
