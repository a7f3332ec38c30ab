// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_extent.hpp"
#include "apps/map_saturation.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "apps/terminal.hpp"
#include "datasets/carmen.hpp"
#include "datasets/map_server.hpp"
#include "datasets/trajectory.hpp"
#include "mapping/mapper.hpp"
#include "results/config.hpp"
#include "results/map_folder.hpp"
#include "results/pictures.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct MapOptions {
  std::string source, out, poses, pictures;
  std::vector<std::string> sensors{"range", "sonar"};
  std::string readout = "normalized";
  datasets::MapMode map_mode = datasets::MapMode::kTrinary;
  bool large = false;
  bool force = false;
  mapping::TrajectoryMappingParams params;
  OutputFormat format;
};

/// Readings with the poses to map them from.
struct Part {
  sensors::MotionPath path;
  sensors::Rig rig;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
};

sensors::MotionPath path_of(const std::vector<datasets::TimedPose>& poses) {
  std::vector<sensors::OdometryReading> rows;
  rows.reserve(poses.size());
  for (const datasets::TimedPose& p : poses) rows.push_back({p.time, p.pose});
  return sensors::MotionPath(std::move(rows));
}

template <typename Reading>
std::vector<Reading> joined(const std::vector<std::vector<Reading>>& by_sensor) {
  std::vector<Reading> all;
  for (const auto& readings : by_sensor) all.insert(all.end(), readings.begin(), readings.end());
  std::stable_sort(all.begin(), all.end(), [](const Reading& a, const Reading& b) { return a.time < b.time; });
  return all;
}

bool wants(const MapOptions& o, const char* sensor) {
  return std::find(o.sensors.begin(), o.sensors.end(), sensor) != o.sensors.end();
}

std::vector<datasets::TimedPose> given_poses(const std::string& file) {
  const datasets::Trajectory trajectory = datasets::read_trajectory(file);
  if (!trajectory.has_times)
    throw std::runtime_error(file + ": these poses have no times: readings cannot be placed with them");
  return trajectory.poses;
}

std::vector<Part> parts_of_dataset(const MapOptions& o, std::string& poses) {
  datasets::Dataset dataset = datasets::Dataset::open(o.source);
  for (const std::string& remark : dataset.remarks) say_warning(remark);
  const bool truth = o.poses.empty() || o.poses == "groundtruth";
  if (truth && dataset.truth.empty()) {
    throw std::runtime_error(o.source +
                             ": the dataset has no ground truth: give the poses with --poses FILE (for example the "
                             "trajectory.tum of credo run)");
  }
  poses = truth ? "ground truth" : o.poses;
  Part part{.path = path_of(truth ? dataset.truth : given_poses(o.poses)),
            .rig = dataset.header.rig,
            .scans = {},
            .sweeps = {}};
  if (wants(o, "range")) part.scans = joined(dataset.scans);
  if (wants(o, "sonar")) part.sweeps = joined(dataset.sonar);
  std::vector<Part> parts;
  parts.push_back(std::move(part));
  return parts;
}

[[noreturn]] void fail_without_readings(const MapOptions& o) {
  throw std::runtime_error(o.source + ": holds no reading of the sensors that --sensors asks for");
}

/// The way of the robot itself, for readings that bring no pose of their own: by the first laser, else by odometry.
sensors::MotionPath base_path(const datasets::CarmenLog& log) {
  if (log.laser_poses.empty() || log.laser_poses.front().empty()) return sensors::MotionPath(log.odometry);
  const geometry::Pose2 T_laser_base = log.rig.range_finders.front().T_base_sensor.inverse();
  std::vector<datasets::TimedPose> poses = log.laser_poses.front();
  for (datasets::TimedPose& row : poses) row.pose = row.pose * T_laser_base;
  return path_of(poses);
}

/// Each laser of the log from its own poses, so that nothing need be known of how it is mounted; the sonar along the
/// way of the robot.
std::vector<Part> parts_of_carmen(const MapOptions& o, std::string& poses) {
  datasets::CarmenLog log = datasets::read_carmen(o.source);
  for (const std::string& remark : log.remarks) say_warning(remark);
  if (!wants(o, "range")) std::fill(log.scans.begin(), log.scans.end(), std::vector<sensors::RangeScan>{});
  if (!wants(o, "sonar")) std::fill(log.sonar.begin(), log.sonar.end(), std::vector<sensors::SonarSweep>{});
  std::vector<sensors::SonarSweep> sweeps = joined(log.sonar);
  std::vector<Part> parts;
  if (!o.poses.empty()) {
    poses = o.poses;
    parts.push_back({.path = path_of(given_poses(o.poses)),
                     .rig = log.rig,
                     .scans = joined(log.scans),
                     .sweeps = std::move(sweeps)});
    return parts;
  }
  poses = "the poses of the log";
  bool any = !sweeps.empty();
  if (sensors::MotionPath path = base_path(log); !sweeps.empty() && !path.empty())
    parts.push_back({.path = std::move(path), .rig = log.rig, .scans = {}, .sweeps = std::move(sweeps)});
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    any = any || !log.scans[i].empty();
    if (log.scans[i].empty() || log.laser_poses[i].empty()) continue;
    Part part{.path = path_of(log.laser_poses[i]), .rig = log.rig, .scans = std::move(log.scans[i]), .sweeps = {}};
    part.rig.range_finders[i].T_base_sensor = {};
    parts.push_back(std::move(part));
  }
  if (!any) fail_without_readings(o);
  if (parts.empty())
    throw std::runtime_error(o.source + ": no reading of this log carries a pose: give them with --poses FILE");
  return parts;
}

mapping::TrajectoryMap build(const MapOptions& o, const std::vector<Part>& parts) {
  mapping::TrajectoryMap map{.grid = grids::EvidentialGrid(o.params.mapper.georeference), .counts = {}};
  Eigen::AlignedBox2d ground;
  for (const Part& part : parts) ground.extend(seen_ground(part.path, part.rig, part.scans, part.sweeps, o.params));
  if (!o.large) require_map_fits(ground, o.params.mapper.georeference.resolution_m);
  Progress progress("mapping");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto report = [&](double share) {
      Interruptible::check();
      progress.update((static_cast<double>(i) + share) / static_cast<double>(parts.size()));
    };
    const Part& part = parts[i];
    const mapping::TrajectoryMap one =
        mapping::map_along(part.path, part.rig, part.scans, part.sweeps, o.params, report);
    map.grid.merge(one.grid);
    map.counts += one.counts;
    map.without_pose += one.without_pose;
  }
  return map;
}

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
void check_overlap(const MapOptions& o, const std::vector<Part>& parts, const mapping::TrajectoryMap& map,
                   const std::string& poses) {
  const std::int64_t placed = map.counts.scans + map.counts.sweeps, all = placed + map.without_pose;
  if (all == 0) fail_without_readings(o);
  TimeSpan readings, path;
  for (const Part& part : parts) {
    readings.cover(part.scans);
    readings.cover(part.sweeps);
    path.cover(part.path.rows());
  }
  const std::string message = std::to_string(map.without_pose) + " of " + std::to_string(all) +
                              " readings have no pose near in time: the readings are from " + readings.text() + ", " +
                              poses + " from " + path.text();
  if (placed == 0) throw std::runtime_error(o.source + ": " + message + "; are they of the same drive?");
  if (10 * map.without_pose > all) say_warning(message);
}

void write(const MapOptions& o, const mapping::TrajectoryMap& map, const std::vector<Part>& parts,
           const std::string& poses, const fs::path& folder, const std::optional<PictureFolder>& pictures) {
  const bool drawn = results::write_map_folder(
      map.grid, folder,
      {.mode = o.map_mode,
       .channels = o.readout == "raw" ? results::BeliefChannels::kRaw : results::BeliefChannels::kNormalized});
  if (!drawn) warn_without_pictures(map.grid);
  results::write_text(folder / "config.yaml", results::to_yaml(o.params, CREDO_VERSION, o.source, poses));
  if (!pictures || !drawn) return;
  std::vector<geometry::Pose2> way;
  for (const auto& row : parts.front().path.rows()) way.push_back(row.T_odom_base);
  results::write_map_pictures(pictures->path(), map.grid, way);
  pictures->publish();
}

std::vector<Part> parts_of(const MapOptions& o, std::string& poses) {
  if (datasets::Dataset::is_dataset(o.source)) return parts_of_dataset(o, poses);
  if (fs::is_regular_file(o.source) && datasets::is_carmen(o.source)) return parts_of_carmen(o, poses);
  throw std::runtime_error(o.source + (fs::exists(o.source) ? "" : ": is not there") +
                           ": expected a dataset folder (with a dataset.yaml) or a CARMEN log");
}

void execute(MapOptions o) {
  std::string poses;
  const std::vector<Part> parts = parts_of(o, poses);
  if (o.out.empty())
    o.out = (fs::path("results") / (fs::path(o.source).lexically_normal().stem().string() + "_map")).string();
  const Interruptible interruptible;
  datasets::StagedFolder folder = results::stage_results(o.out, o.force);
  std::optional<PictureFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, o.out, folder.path(), o.force);
  const mapping::TrajectoryMap map = about(o.source, [&] { return build(o, parts); });
  check_overlap(o, parts, map, poses);
  warn_of_saturation(map.grid);
  about(o.source, [&] { write(o, map, parts, poses, folder.path(), pictures); });
  Interruptible::check();
  folder.commit();
  const grids::CellBox box = map.grid.bounding_box();
  if (o.format.json()) {
    print(nlohmann::ordered_json{{"map", o.out},
                                 {"poses", poses},
                                 {"scans", map.counts.scans},
                                 {"sonar_sweeps", map.counts.sweeps},
                                 {"echoes", map.counts.echoes},
                                 {"no_returns", map.counts.no_returns},
                                 {"without_pose", map.without_pose},
                                 {"width", box.width},
                                 {"height", box.height},
                                 {"resolution_m", o.params.mapper.georeference.resolution_m}});
    return;
  }
  std::printf("mapped %lld scans and %lld sonar sweeps with %s; %lld readings had no pose near in time\n",
              static_cast<long long>(map.counts.scans), static_cast<long long>(map.counts.sweeps), poses.c_str(),
              static_cast<long long>(map.without_pose));
  std::printf("map: %s (%d x %d cells of %g m)\n", o.out.c_str(), box.width, box.height,
              o.params.mapper.georeference.resolution_m);
  if (!o.pictures.empty()) std::printf("pictures: %s\n", o.pictures.c_str());
}

}  // namespace

void add_map(CLI::App& app) {
  CLI::App* command = app.add_subcommand("map", "Maps a drive whose poses are known.");
  command->footer(
      "  credo map datasets/office --out results/office_map                        with the ground truth\n"
      "  credo map datasets/office --poses results/office/trajectory.tum --out results/office_map\n"
      "  credo map intel.log.gz --out results/intel --resolution 0.1 --pictures results/intel_pictures");
  auto o = std::make_shared<MapOptions>();
  command->add_option("SOURCE", o->source, "a dataset folder, or a CARMEN log (plain or gzipped)")
      ->check(a_path())
      ->required();
  command->add_option("-o,--out", o->out, "folder for the map; default results/NAME_map")->check(a_path());
  command
      ->add_option("--poses", o->poses,
                   "a trajectory file, or groundtruth (default: ground truth; of a log, its own poses)")
      ->check(a_path());
  command->add_option("--sensors", o->sensors, "what to map with: range, sonar or both")
      ->delimiter(',')
      ->check(CLI::IsMember({"range", "sonar"}))
      ->capture_default_str();
  command->add_option("--resolution", o->params.mapper.georeference.resolution_m, "side of a cell [m]")
      ->check(any_resolution())
      ->capture_default_str();
  command
      ->add_option("--readout", o->readout,
                   "channels of map_belief.tiff: after Dempster's normalisation, or raw masses")
      ->check(CLI::IsMember({"normalized", "raw"}))
      ->capture_default_str();
  command->add_option("--map-mode", o->map_mode, "what the grey of map.yaml says: trinary, scale (percent) or raw")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, datasets::MapMode>{{"trinary", datasets::MapMode::kTrinary},
                                                                           {"scale", datasets::MapMode::kScale},
                                                                           {"raw", datasets::MapMode::kRaw}}))
      ->default_str("trinary");
  command->add_flag("--large", o->large, "allow a map that is too large for pictures: map.cgrid alone is written then");
  command->add_option("--pictures", o->pictures, "folder for pictures: the map, its layers and its relief")
      ->check(a_path());
  command->add_flag("-f,--force", o->force, "replace a map that is already there");
  add_format_option(*command, o->format);
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
