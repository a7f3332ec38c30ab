// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_source.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "apps/ego_poses.hpp"
#include "apps/option_checks.hpp"
#include "apps/terminal.hpp"
#include "datasets/carmen.hpp"
#include "datasets/dataset.hpp"
#include "datasets/sensor_weights_file.hpp"
#include "datasets/time_order.hpp"
#include "datasets/trajectory.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

sensors::MotionPath path_of(const std::vector<datasets::TimedPose>& poses) {
  std::vector<sensors::OdometryReading> rows;
  rows.reserve(poses.size());
  for (const datasets::TimedPose& p : poses) rows.push_back({p.time, p.pose});
  return sensors::MotionPath(std::move(rows));
}

bool wants(const MapSource& o, const char* sensor) {
  return std::find(o.sensors.begin(), o.sensors.end(), sensor) != o.sensors.end();
}

evaluation::LineFinder line_finder(const MapSource& o) {
  return o.lines == "hough" ? evaluation::LineFinder::kHough : evaluation::LineFinder::kSegments;
}

std::vector<datasets::TimedPose> given_poses(const std::string& file) {
  const datasets::Trajectory trajectory = datasets::read_trajectory(file);
  if (!trajectory.has_times)
    throw std::runtime_error(file + ": these poses have no times: readings cannot be placed with them");
  return trajectory.poses;
}

std::vector<MapPart> parts_of_dataset(const MapSource& o, std::string& poses) {
  datasets::Dataset dataset = datasets::Dataset::open(o.source);
  for (const std::string& remark : dataset.remarks) say_warning(remark);
  const bool ego = o.poses == "ego";
  const bool truth = o.poses.empty() || o.poses == "groundtruth";
  if (truth && dataset.truth.empty()) {
    throw std::runtime_error(o.source +
                             ": the dataset has no ground truth: give the poses with --poses FILE (for example the "
                             "trajectory.tum of credo run)");
  }
  poses = truth ? "ground truth" : ego ? "ego-motion" : o.poses;
  MapPart part{.path = path_of(truth ? dataset.truth
                               : ego ? ego_poses(dataset, line_finder(o))
                                     : given_poses(o.poses)),
               .rig = dataset.header.rig,
               .scans = {},
               .sweeps = {}};
  if (wants(o, "range")) part.scans = datasets::in_time_order(dataset.scans);
  if (wants(o, "sonar")) part.sweeps = datasets::in_time_order(dataset.sonar);
  std::vector<MapPart> parts;
  parts.push_back(std::move(part));
  return parts;
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
std::vector<MapPart> parts_of_carmen(const MapSource& o, std::string& poses) {
  datasets::CarmenLog log = datasets::read_carmen(o.source);
  for (const std::string& remark : log.remarks) say_warning(remark);
  std::vector<datasets::TimedPose> given;
  if (o.poses == "ego")
    given = ego_poses(datasets::to_dataset(log, o.source), line_finder(o));
  else if (!o.poses.empty())
    given = given_poses(o.poses);
  if (!wants(o, "range")) std::fill(log.scans.begin(), log.scans.end(), std::vector<sensors::RangeScan>{});
  if (!wants(o, "sonar")) std::fill(log.sonar.begin(), log.sonar.end(), std::vector<sensors::SonarSweep>{});
  std::vector<sensors::SonarSweep> sweeps = datasets::in_time_order(log.sonar);
  std::vector<MapPart> parts;
  if (!o.poses.empty()) {
    poses = o.poses == "ego" ? "ego-motion" : o.poses;
    parts.push_back({.path = path_of(given),
                     .rig = log.rig,
                     .scans = datasets::in_time_order(log.scans),
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
    MapPart part{.path = path_of(log.laser_poses[i]), .rig = log.rig, .scans = std::move(log.scans[i]), .sweeps = {}};
    part.rig.range_finders[i].T_base_sensor = {};
    parts.push_back(std::move(part));
  }
  if (!any) fail_without_readings(o);
  if (parts.empty())
    throw std::runtime_error(o.source + ": no reading of this log carries a pose: give them with --poses FILE");
  return parts;
}

}  // namespace

void fail_without_readings(const MapSource& o) {
  throw std::runtime_error(o.source + ": holds no reading of the sensors that --sensors asks for");
}

MapParts read_map_parts(const MapSource& o) {
  if (o.lines != "segments" && o.poses != "ego")
    throw std::runtime_error("--lines says how ego-motion finds walls: it goes with --poses ego");
  MapParts read;
  if (datasets::Dataset::is_dataset(o.source))
    read.parts = parts_of_dataset(o, read.poses);
  else if (fs::is_regular_file(o.source) && datasets::is_carmen(o.source))
    read.parts = parts_of_carmen(o, read.poses);
  else
    throw std::runtime_error(o.source + (fs::exists(o.source) ? "" : ": is not there") +
                             ": expected a dataset folder (with a dataset.yaml) or a CARMEN log");
  return read;
}

void add_sonar_weights_option(CLI::App& command, SonarChoice& choice) {
  command.add_option("--sonar-weights", choice.weights, "of the model 'calibrated': a file of credo calibrate sonar")
      ->check(a_path());
}

void add_laser_weights_option(CLI::App& command, LaserChoice& choice) {
  command
      .add_option("--laser-weights", choice.weights, "of the laser model 'calibrated': a file of credo calibrate laser")
      ->check(a_path());
}

mapping::SonarParams sonar_params(const SonarChoice& choice, double resolution_m) {
  mapping::SonarParams params = mapping::sonar_params(choice.model, resolution_m);
  std::visit(
      [&](auto& p) {
        const auto variant = choice.printed ? mapping::Variant::kPrinted : mapping::Variant::kResolved;
        if constexpr (requires { p.variant; }) p.variant = variant;
        if constexpr (requires { p.matched.variant; }) p.matched.variant = variant;
        if constexpr (requires { p.weights; })
          if (!choice.weights.empty())
            p.weights = datasets::read_sonar_weights(choice.weights, mapping::SonarKnots::kCount);
      },
      params);
  return params;
}

mapping::LaserParams laser_params(const LaserChoice& choice) {
  mapping::LaserParams params = mapping::laser_params(choice.model);
  const auto variant = choice.printed ? mapping::Variant::kPrinted : mapping::Variant::kResolved;
  if (auto* li2006 = std::get_if<mapping::Li2006LaserParams>(&params)) li2006->variant = variant;
  if (auto* bayes = std::get_if<mapping::BayesLaserParams>(&params)) bayes->matched.variant = variant;
  if (auto* learned = std::get_if<mapping::CalibratedLaserParams>(&params); learned && !choice.weights.empty()) {
    datasets::LaserModelFile read = datasets::read_laser_weights(choice.weights, mapping::LaserKnots::kCount);
    *learned = {.free_margin = {.least_m = read.free_margin_m, .sigmas = read.free_margin_sigmas},
                .half_width = {.least_m = read.half_width_m, .sigmas = read.half_width_sigmas},
                .summed = {read.summed.free_weight, std::move(read.summed.hit_weights)},
                .alone = {read.alone.free_weight, std::move(read.alone.hit_weights)}};
  }
  return params;
}

void add_map_source_options(CLI::App& command, MapSource& source) {
  command.add_option("SOURCE", source.source, "a dataset folder, or a CARMEN log (plain or gzipped)")
      ->check(a_path())
      ->required();
  command
      .add_option("--poses", source.poses,
                  "a trajectory file, groundtruth, or ego: what the laser's lines and odometry tell (default: ground "
                  "truth; of a "
                  "log, its own poses)")
      ->check(a_path());
  command
      .add_option("--lines", source.lines,
                  "how ego-motion finds walls in a scan: segments of neighbouring points, or lines by Hough transform")
      ->check(CLI::IsMember({"segments", "hough"}))
      ->capture_default_str();
  command.add_option("--sensors", source.sensors, "what to map with: range, sonar or both")
      ->delimiter(',')
      ->check(CLI::IsMember({"range", "sonar"}))
      ->capture_default_str();
}

}  // namespace credo::apps
